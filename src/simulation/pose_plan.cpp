#include "simulation/pose_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/rotation.h"
#include "simulation/random_stream.h"

namespace telestrain {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

// Half ranges of a pose about the middle of its box: mm along x, y, z, degrees about x, y, z.
Vector6d HalfRange(double tilt_deg) { return Vector6d{{0.8, 1.0, 0.7, tilt_deg, 2.5, 4.0}}; }
constexpr double kMargin_mm = 0.12;  // bright plate that stays visible around a whole board
// By how much a cut-off board leaves the region: its outer squares and a row of corners.
constexpr double kSmallestCut_mm = 0.4, kLargestCut_mm = 1.0;
constexpr int kMaxCandidates = 4'000'000;

// A candidate as coordinates in its box, each in [-1, 1].
Vector6d HaltonPoint(int index, const Vector6d& shift) {
  constexpr std::array kBases{2, 3, 5, 7, 11, 13};
  Vector6d point;
  for (int axis = 0; axis < 6; ++axis) {
    double value = shift[axis], weight = 1.0;
    for (int rest = index + 1; rest > 0; rest /= kBases[axis]) {
      weight /= kBases[axis];
      value += weight * (rest % kBases[axis]);
    }
    point[axis] = 2 * (value - std::floor(value)) - 1;
  }
  return point;
}

class Planner {
 public:
  Planner(const VirtualInstrument& instrument, const TargetSpec& plate, double tilt_deg)
      : instrument_(instrument), plate_(plate), half_range_(HalfRange(tilt_deg)) {}

  PlatePose PoseAt(const Vector6d& point, const Eigen::Vector3d& travel_mm) const {
    const Vector6d value = point.cwiseProduct(half_range_);
    PlatePose pose;
    pose.array_from_plate = ExpRotation(value.tail<3>() * std::numbers::pi / 180);
    // Half of the travel on either side of the middle of the depth of field.
    pose.origin_in_array_mm = value.head<3>() - 0.5 * travel_mm;
    return pose;
  }

  bool IsWhole(const PlatePose& pose) const {
    return std::all_of(instrument_.views.begin(), instrument_.views.end(), [&](const auto& view) {
      return Overhang_mm(view, pose) < -kMargin_mm && IsInFocus(view, pose);
    });
  }

  // Exactly one view misses a part of its board, clearly; the others see theirs whole.
  bool IsCutOffOnce(const PlatePose& pose) const {
    int cut = 0;
    for (const InstrumentView& view : instrument_.views) {
      const double overhang_mm = Overhang_mm(view, pose);
      if (overhang_mm > kSmallestCut_mm && overhang_mm < kLargestCut_mm)
        ++cut;
      else if (overhang_mm > -kMargin_mm)
        return false;
    }
    return cut == 1;
  }

 private:
  std::array<Eigen::Vector3d, 4> Outline(const InstrumentView& view, const PlatePose& pose) const {
    const SubBoard& board = *plate_.FindBoard(view.view.group);
    const double half_x = 0.5 * (plate_.columns + 1) * plate_.square_mm;
    const double half_y = 0.5 * (plate_.rows + 1) * plate_.square_mm;
    std::array<Eigen::Vector3d, 4> corners;
    for (int i = 0; i < 4; ++i) {
      const double x_mm = i % 2 == 0 ? -half_x : half_x, y_mm = i / 2 == 0 ? -half_y : half_y;
      corners[i] = pose.InArray(board.center_in_target_mm + Eigen::Vector3d(x_mm, y_mm, 0));
    }
    return corners;
  }

  // How far the board reaches over the region's border; negative: it stays inside.
  double Overhang_mm(const InstrumentView& view, const PlatePose& pose) const {
    const Eigen::Vector2d middle_mm = instrument_.Ideal(view, view.center_in_array_mm);
    const Eigen::Vector2d half_mm = Eigen::Vector2d(view.region.width, view.region.height) / 2 /
                                    instrument_.lens.magnification_px_per_mm;
    double overhang_mm = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& corner : Outline(view, pose)) {
      const Eigen::Vector2d off_mm =
          (instrument_.Ideal(view, corner) - middle_mm).cwiseAbs() - half_mm;
      overhang_mm = std::max(overhang_mm, off_mm.maxCoeff());
    }
    return overhang_mm;
  }

  bool IsInFocus(const InstrumentView& view, const PlatePose& pose) const {
    const double limit_mm = 0.5 * instrument_.depth_of_field_mm;
    for (const Eigen::Vector3d& corner : Outline(view, pose)) {
      if (std::abs(view.BeyondFocus_mm(corner)) > limit_mm) return false;
    }
    return true;
  }

  const VirtualInstrument& instrument_;
  const TargetSpec& plate_;
  Vector6d half_range_;
};

// The `wanted` members of `pool` that lie farthest from each other, the most central one first.
std::vector<Vector6d> Spread(const std::vector<Vector6d>& pool, int wanted) {
  std::vector<double> distance(pool.size(), std::numeric_limits<double>::infinity());
  const auto closer = [](const Vector6d& a, const Vector6d& b) { return a.norm() < b.norm(); };
  std::size_t next = std::min_element(pool.begin(), pool.end(), closer) - pool.begin();
  std::vector<Vector6d> chosen;
  for (int i = 0; i < wanted; ++i) {
    chosen.push_back(pool[next]);
    for (std::size_t j = 0; j < pool.size(); ++j)
      distance[j] = std::min(distance[j], (pool[j] - pool[next]).squaredNorm());
    next = std::max_element(distance.begin(), distance.end()) - distance.begin();
  }
  return chosen;
}

template <typename Accept>
Result<std::vector<Vector6d>> Choose(int wanted, const Vector6d& shift, const Accept& accept) {
  const auto pool_size = static_cast<std::size_t>(std::min(40 * wanted, wanted + 2000));
  std::vector<Vector6d> pool;
  for (int i = 0; i < kMaxCandidates && pool.size() < pool_size; ++i) {
    const Vector6d point = HaltonPoint(i, shift);
    if (accept(point)) pool.push_back(point);
    if (i == kMaxCandidates / 20 && pool.empty()) break;
  }
  if (pool.size() < static_cast<std::size_t>(wanted))
    return BadInput("virtual experiment: wanted " + std::to_string(wanted) +
                    " poses that the views see as planned, found " + std::to_string(pool.size()) +
                    "; reduce view_error_deg or view_error_mm, or choose another seed");
  return Spread(pool, wanted);
}

Vector6d RandomShift(std::uint64_t key) {
  RandomStream random(key);
  Vector6d shift;
  for (int axis = 0; axis < 6; ++axis) shift[axis] = random.Uniform();
  return shift;
}

// Whole poses in order, the cut-off ones evenly between them.
std::vector<PosePair> Arrange(const Planner& planner, const std::vector<Vector6d>& whole,
                              const std::vector<Vector6d>& cut,
                              const std::vector<Eigen::Vector3d>& travels_mm) {
  std::vector<std::pair<Vector6d, bool>> order;
  for (const Vector6d& point : whole) order.emplace_back(point, false);
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const auto place = static_cast<std::ptrdiff_t>((i + 1) * whole.size() / (cut.size() + 1) + i);
    order.insert(order.begin() + place, {cut[i], true});
  }
  std::vector<PosePair> pairs;
  for (const auto& [point, is_cut_off] : order) {
    const bool moves = !travels_mm.empty();
    const Eigen::Vector3d middle_mm = moves ? travels_mm.front() : Eigen::Vector3d::Zero();
    PosePair pair{planner.PoseAt(point, middle_mm), {}, is_cut_off};
    pair.after_travel = pair.at_start;
    if (moves) pair.after_travel.origin_in_array_mm += travels_mm.at(pairs.size());
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace

Result<std::vector<PosePair>> PlanPoses(const VirtualInstrument& instrument,
                                        const TargetSpec& plate, const PosePlanRequest& request) {
  const Planner planner(instrument, plate, request.tilt_deg);
  const auto& travels = request.travels_in_array_mm;
  const Eigen::Vector3d typical_mm = travels.empty() ? Eigen::Vector3d::Zero() : travels.front();
  const Vector6d shift = RandomShift(request.key);
  const auto is_whole = [&](const Vector6d& point) {
    const PlatePose start = planner.PoseAt(point, typical_mm);
    PlatePose end = start;
    end.origin_in_array_mm += typical_mm;
    return planner.IsWhole(start) && (travels.empty() || planner.IsWhole(end));
  };
  const auto is_cut = [&](const Vector6d& point) {
    return planner.IsCutOffOnce(planner.PoseAt(point, typical_mm));
  };
  TELESTRAIN_ASSIGN_OR_RETURN(auto whole, Choose(request.whole_poses, shift, is_whole));
  TELESTRAIN_ASSIGN_OR_RETURN(auto cut, Choose(request.cut_off_poses, shift, is_cut));
  return Arrange(planner, whole, cut, travels);
}

}  // namespace telestrain
