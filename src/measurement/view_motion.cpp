#include "measurement/view_motion.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

namespace telestrain {
namespace {

constexpr int kSeedsAlong = 4;        // seeds in each direction
constexpr std::size_t kMinSeeds = 6;  // twice what an affine motion needs
constexpr double kAgreement_px = 2;   // of a point with the motion of its view
constexpr double kNearShare = 0.08;   // of the region's width, searched first
constexpr double kFarShare = 0.5;     // and then
constexpr int kRoomForSpline_px = 4;  // beyond the subset

Eigen::Vector2d FromMiddle(const PixelRegion& region, const Eigen::Vector2i& center_px) {
  return center_px.cast<double>() - region.Middle();
}

bool StaysInside(const CorrelationReference& reference, const Eigen::Vector2i& center_px,
                 const ViewMotion& motion) {
  const PixelRegion& region = reference.region();
  const double margin = reference.options().subset_px / 2 + kRoomForSpline_px;
  const Eigen::Vector2d from_middle = FromMiddle(region, center_px);
  const Eigen::Vector2d moved = from_middle + motion.At(from_middle);
  return std::abs(moved.x()) <= 0.5 * (region.width - 1) - margin &&
         std::abs(moved.y()) <= 0.5 * (region.height - 1) - margin;
}

// Of the points that stay inside the region: those nearest to the nodes of a coarse grid over them.
std::vector<Eigen::Vector2i> SpreadSeeds(const CorrelationReference& reference,
                                         const std::vector<Eigen::Vector2i>& centers_px,
                                         const ViewMotion& motion) {
  std::vector<Eigen::Vector2i> inside, seeds;
  for (const Eigen::Vector2i& center : centers_px)
    if (StaysInside(reference, center, motion)) inside.push_back(center);
  if (inside.empty()) return seeds;
  Eigen::Vector2i low = inside.front(), high = inside.front();
  for (const Eigen::Vector2i& center : inside) {
    low = low.cwiseMin(center);
    high = high.cwiseMax(center);
  }
  for (int k = 0; k < kSeedsAlong * kSeedsAlong; ++k) {
    const Eigen::Vector2i node =
        low + Eigen::Vector2i((high.x() - low.x()) * (k % kSeedsAlong) / (kSeedsAlong - 1),
                              (high.y() - low.y()) * (k / kSeedsAlong) / (kSeedsAlong - 1));
    const auto nearest = std::min_element(
        inside.begin(), inside.end(), [&](const Eigen::Vector2i& a, const Eigen::Vector2i& b) {
          return (a - node).squaredNorm() < (b - node).squaredNorm();
        });
    if (std::find(seeds.begin(), seeds.end(), *nearest) == seeds.end()) seeds.push_back(*nearest);
  }
  return seeds;
}

struct MovedPoint {
  Eigen::Vector2d from_middle_px;
  Eigen::Vector2d displacement_px;
};

double Distance_px(const ViewMotion& motion, const MovedPoint& point) {
  return (point.displacement_px - motion.At(point.from_middle_px)).norm();
}

// Least squares; the points must not lie on a line.
std::optional<ViewMotion> Fit(const std::vector<MovedPoint>& points) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (const MovedPoint& point : points) {
    const Eigen::Vector3d row(1, point.from_middle_px.x(), point.from_middle_px.y());
    normal += row * row.transpose();
    right += row * point.displacement_px.transpose();
  }
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
  if (points.size() < 3 || !(solver.vectorD().minCoeff() > 1)) return {};
  const Eigen::Matrix<double, 3, 2> solution = solver.solve(right);
  return ViewMotion{solution.row(0).transpose(), solution.bottomRows<2>().transpose()};
}

// The shift that most points agree on: the displacement of the one with the most others near it.
ViewMotion CommonShift(const std::vector<MovedPoint>& points) {
  ViewMotion best;
  std::ptrdiff_t most = -1;
  for (const MovedPoint& point : points) {
    const ViewMotion trial{point.displacement_px, Eigen::Matrix2d::Zero()};
    const auto near = std::count_if(points.begin(), points.end(), [&](const MovedPoint& other) {
      return Distance_px(trial, other) < 2 * kAgreement_px;
    });
    if (near <= most) continue;
    most = near;
    best = trial;
  }
  return best;
}

std::vector<MovedPoint> Near(const std::vector<MovedPoint>& points, const ViewMotion& motion,
                             double limit_px) {
  std::vector<MovedPoint> near;
  for (const MovedPoint& point : points)
    if (Distance_px(motion, point) < limit_px) near.push_back(point);
  return near;
}

// The motion that at least half of the seeds agree on.
std::optional<ViewMotion> FollowSeeds(const ViewPair& views,
                                      const std::vector<Eigen::Vector2i>& centers_px,
                                      const ViewMotion& start) {
  const auto seeds = SpreadSeeds(views.reference, centers_px, start);
  if (seeds.size() < kMinSeeds) return {};
  const PixelRegion& region = views.reference.region();
  const auto starts = StartsOf(region, seeds, start);
  std::vector<MovedPoint> moved;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const SubsetMatch match = views.reference.Match(seeds[i], views.image, starts[i]);
    if (match.ok()) moved.push_back({FromMiddle(region, seeds[i]), match.shape.displacement_px});
  }
  const std::size_t enough = std::max(kMinSeeds, seeds.size() / 2);
  auto motion = Fit(Near(moved, CommonShift(moved), 2 * kAgreement_px));
  if (!motion) return {};
  const auto agreeing = Near(moved, *motion, kAgreement_px);
  if (agreeing.size() < enough) return {};
  return Fit(agreeing);
}

}  // namespace

FoundMotion FindMotion(const ViewPair& views, const std::vector<Eigen::Vector2i>& centers_px,
                       const ViewMotion& predicted) {
  if (const auto motion = FollowSeeds(views, centers_px, predicted)) return {*motion, false, true};
  const PixelRegion& region = views.reference.region();
  for (const double share : {kNearShare, kFarShare}) {
    const ShiftSearch search = SearchShift(views.reference_image, views.state_image, region,
                                           static_cast<int>(share * region.width));
    const ViewMotion start{search.shift_px, Eigen::Matrix2d::Zero()};
    if (const auto motion = FollowSeeds(views, centers_px, start)) return {*motion, true, true};
  }
  return {predicted, true, false};
}

ViewMotion FitMotion(const PixelRegion& region, const std::vector<Eigen::Vector2i>& centers_px,
                     const std::vector<SubsetMatch>& matches, const ViewMotion& near) {
  std::vector<MovedPoint> moved;
  for (std::size_t i = 0; i < centers_px.size(); ++i)
    if (matches[i].ok())
      moved.push_back({FromMiddle(region, centers_px[i]), matches[i].shape.displacement_px});
  moved = Near(moved, near, kAgreement_px);
  if (moved.size() < kMinSeeds) return near;
  return Fit(moved).value_or(near);
}

std::vector<ShapeFunction> StartsOf(const PixelRegion& region,
                                    const std::vector<Eigen::Vector2i>& centers_px,
                                    const ViewMotion& motion) {
  std::vector<ShapeFunction> starts(centers_px.size());
  for (std::size_t i = 0; i < centers_px.size(); ++i) {
    starts[i].displacement_px = motion.At(FromMiddle(region, centers_px[i]));
    starts[i].gradient = motion.gradient;
  }
  return starts;
}

}  // namespace telestrain
