#include "diagnostics/pinhole_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/parallel.h"
#include "diagnostics/pinhole_mrcal.h"
#include "diagnostics/pinhole_ruler.h"
#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr double kRadPerDeg = 0.017453292519943295;

// Uniform in a cube; the same numbers on every machine.
class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  Eigen::Vector3d Vector(double reach) {
    const double x = Number(reach), y = Number(reach);
    return {x, y, Number(reach)};
  }

 private:
  double Number(double reach) {
    constexpr double kRange = std::mt19937::max();
    return reach * (2 * (static_cast<double>(engine_()) / kRange) - 1);
  }
  std::mt19937 engine_;
};

ArrayState Disturbed(ArrayState state, const PinholeComparisonOptions& options, unsigned seed) {
  Draw draw(seed);
  const double turn_rad = options.seed_turn_deg * kRadPerDeg;
  for (TelecentricView& view : state.array.views)
    view.axes_in_array = (ExpRotation(draw.Vector(turn_rad)) * view.Rotation()).topRows<2>();
  for (TargetPose& pose : state.poses) {
    pose.array_from_target = ExpRotation(draw.Vector(turn_rad)) * pose.array_from_target;
    pose.origin_in_array_mm += draw.Vector(options.seed_shift_mm);
  }
  return state;
}

std::vector<int> Histogram(const std::vector<Eigen::Matrix2Xd>& errors_px) {
  std::vector<int> counts;
  for (const Eigen::Matrix2Xd& of_board : errors_px) {
    for (const double norm_px : of_board.colwise().norm()) {
      const auto bin = static_cast<std::size_t>(norm_px / kErrorBin_px);
      if (bin >= counts.size()) counts.resize(bin + 1, 0);
      ++counts[bin];
    }
  }
  return counts;
}

// What a comparison works on.
struct Case {
  const Session& session;
  const CalibrationData& data;
  const ArrayState& state;
  const std::vector<CrossObservation>& crosses;
  const PinholeComparisonOptions& options;
};

PinholeArm ArmOf(const Case& given, const PinholeOptions& options,
                 const PinholeCalibration& found) {
  PinholeArm arm;
  arm.five_coefficients = options.free_distortion;
  arm.solver = options.free_distortion ? "telestrain" : "mrcal";
  arm.working_distance_mm = options.working_distance_mm;
  arm.reprojection = found.all;
  arm.histogram = Histogram(found.errors_px);
  arm.iterations = found.iterations;
  arm.converged = !found.hit_iteration_limit;
  double squares = 0;
  for (const PinholeRulerLength& length :
       MeasureRulerWithPinhole(given.session, found.views, given.crosses)) {
    if (!length.rejected_because.empty()) continue;
    arm.ruler_error_um.push_back(length.error_um);
    squares += length.error_um * length.error_um;
    arm.ruler_max_um = std::max(arm.ruler_max_um, std::abs(length.error_um));
  }
  if (!arm.ruler_error_um.empty())
    arm.ruler_rmse_um = std::sqrt(squares / static_cast<double>(arm.ruler_error_um.size()));
  return arm;
}

// A seed that our adjustment cannot follow to an end has not found the minimum either.
void CountWrongMinima(const Case& given, PinholeOptions options, double best_px, PinholeArm& arm) {
  std::vector<double> rms_px;
  options.max_iterations = 30;
  for (int seed = 1; seed <= given.options.seeds; ++seed) {
    const auto found = CalibratePinhole(
        given.session, given.data,
        Disturbed(given.state, given.options, static_cast<unsigned>(seed)), options);
    rms_px.push_back(found.ok() ? found->all.rms_px : std::numeric_limits<double>::infinity());
    best_px = std::min(best_px, rms_px.back());
  }
  arm.starts = given.options.seeds;
  for (const double rms : rms_px) arm.wrong_minima += rms > kWrongMinimum * best_px ? 1 : 0;
}

void DescribeTelecentric(const Case& given, PinholeComparison& comparison) {
  PinholeCalibration counted;  // counts any model's errors
  for (const BoardData& board : given.data.boards)
    counted.errors_px.push_back(ReprojectionErrors_px(given.state, board));
  CountErrors(given.data, counted);
  comparison.telecentric = counted.all;
  comparison.telecentric_histogram = Histogram(counted.errors_px);
}

Result<PinholeArm> SolveArm(const Case& given, double distance_mm, bool free_distortion) {
  PinholeOptions options;
  options.working_distance_mm = distance_mm;
  options.free_distortion = free_distortion;
  TELESTRAIN_ASSIGN_OR_RETURN(
      const PinholeCalibration found,
      free_distortion ? CalibratePinhole(given.session, given.data, given.state, options)
                      : CalibratePinholeWithMrcal(given.session, given.data, given.state, options));
  PinholeArm arm = ArmOf(given, options, found);
  if (!free_distortion && distance_mm == given.options.seeded_distance_mm)
    CountWrongMinima(given, options, found.all.rms_px, arm);
  return arm;
}

}  // namespace

Result<PinholeComparison> ComparePinhole(const Session& session, const CalibrationData& data,
                                         const ArrayState& state,
                                         const std::vector<CrossObservation>& crosses,
                                         const PinholeComparisonOptions& options) {
  const Case given{session, data, state, crosses, options};
  PinholeComparison comparison;
  DescribeTelecentric(given, comparison);
  const auto locked = static_cast<int>(options.distances_mm.size());
  const auto distorted = static_cast<int>(options.distorted_distances_mm.size());
  std::vector<std::optional<Result<PinholeArm>>> arms(static_cast<std::size_t>(locked + distorted));
  ParallelFor(locked + distorted, options.threads, [&](int i) {
    const bool free_distortion = i >= locked;
    const double distance_mm =
        free_distortion ? options.distorted_distances_mm[static_cast<std::size_t>(i - locked)]
                        : options.distances_mm[static_cast<std::size_t>(i)];
    arms[static_cast<std::size_t>(i)] = SolveArm(given, distance_mm, free_distortion);
  });
  for (auto& arm : arms) {
    TELESTRAIN_RETURN_IF_ERROR(arm->ok() ? Status() : Status(arm->error()));
    comparison.arms.push_back(std::move(*arm).value());
  }
  return comparison;
}

std::optional<double> PinholeComparison::AsGoodFrom_mm() const {
  constexpr double kAsGood = 1.01;
  std::optional<double> nearest;
  for (const PinholeArm& arm : arms)
    if (!arm.five_coefficients && arm.converged &&
        arm.reprojection.rms_px <= kAsGood * telecentric.rms_px)
      nearest = std::min(nearest.value_or(arm.working_distance_mm), arm.working_distance_mm);
  return nearest;
}

}  // namespace telestrain
