#include "study/corner_experiment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/rotation.h"
#include "simulation/nominal_session.h"
#include "simulation/random_keys.h"

namespace telestrain {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr double kTravel_mm = 1.0;
// Half ranges of the target: where its boards are still seen by a third at least.
const Eigen::Vector3d kTargetRange_mm(1.7, 1.3, 1.0);
constexpr double kRockRange_deg = 2.5, kYawRange_deg = 4.0;  // about y and z: the plate is long
constexpr int kLeastCorners = 39;                            // a third of a board
constexpr double kCrossMargin_mm = 0.35;  // half a square of the ruler's cross and its blur
constexpr double kRulerTilt_deg = 1.0;
constexpr int kMaxTries = 200000;

// Keys beside those of the virtual experiment; the numbers are far from RandomPurpose's.
enum class StudyPurpose : std::uint64_t { kTarget = 1001, kRuler, kBoardNoise, kCrossNoise };
std::uint64_t KeyOf(const CornerExperiment& experiment, StudyPurpose purpose) {
  return CombineKeys(experiment.instrument.seed, static_cast<std::uint64_t>(purpose));
}

Eigen::Matrix3d RandomRotation(RandomStream& random, const Eigen::Vector3d& half_range_deg) {
  Eigen::Vector3d turn_rad;
  for (int axis = 0; axis < 3; ++axis)
    turn_rad[axis] = kRadPerDeg * random.Uniform(-half_range_deg[axis], half_range_deg[axis]);
  return ExpRotation(turn_rad);
}

// The smallest distance (px) of a point's image from its view's border over both views of the group
// on this side; negative outside.
double Margin_px(const VirtualInstrument& instrument, const std::string& group,
                 const Eigen::Vector3d& point_mm) {
  double margin_px = 1e9;
  for (const InstrumentView& view : instrument.views) {
    if (view.view.group != group) continue;
    const Eigen::Vector2d off =
        (instrument.Project(view, point_mm) - view.region.Middle()).cwiseAbs();
    margin_px = std::min(
        {margin_px, 0.5 * view.region.width - off.x(), 0.5 * view.region.height - off.y()});
  }
  return margin_px;
}

// Whether both boards are seen well enough by the views of their groups.
bool IsAcceptable(const CornerExperiment& experiment, const ExperimentTruth& truth,
                  const PlatePose& pose) {
  for (const SubBoard& board : truth.target.boards) {
    const Eigen::Matrix3Xd corners_mm = truth.target.CornersInTarget(board);
    int inside = 0;
    for (Eigen::Index i = 0; i < corners_mm.cols(); ++i)
      inside += Margin_px(truth.instrument, board.group, pose.InArray(corners_mm.col(i))) > 10;
    const int wanted = experiment.use_cut_off_boards ? kLeastCorners : truth.target.CornerCount();
    if (inside < wanted) return false;
  }
  return true;
}

Status InventTargets(const CornerExperiment& experiment, ExperimentTruth& truth) {
  RandomStream random(KeyOf(experiment, StudyPurpose::kTarget));
  const Eigen::Vector3d range_mm = experiment.range_share * kTargetRange_mm;
  const Eigen::Vector3d turn_deg(experiment.tilt_deg, kRockRange_deg, kYawRange_deg);
  const Eigen::Vector3d travel_mm = kTravel_mm * truth.stage_axis_in_array;
  int tries = 0;
  while (static_cast<int>(truth.calibration.size()) < 2 * experiment.poses) {
    if (++tries > kMaxTries)
      return EstimationFailed(
          "study: too few poses of the target are seen by all views; reduce "
          "the tilt");
    PlatePose start;
    start.array_from_plate = RandomRotation(random, turn_deg);
    for (int axis = 0; axis < 3; ++axis)
      start.origin_in_array_mm[axis] = random.Uniform(-range_mm[axis], range_mm[axis]);
    start.origin_in_array_mm -= 0.5 * travel_mm;
    PlatePose end = start;
    end.origin_in_array_mm +=
        travel_mm + Eigen::Vector3d(0, 0, experiment.instrument.stage_sigma_mm * random.Normal());
    if (!IsAcceptable(experiment, truth, start) || !IsAcceptable(experiment, truth, end)) continue;
    const std::string pose = "P" + std::to_string(truth.calibration.size() / 2 + 1);
    truth.calibration.push_back({pose + "_0", pose, 0, start, false});
    truth.calibration.push_back({pose + "_1", pose, kTravel_mm, end, false});
  }
  return {};
}

// How far the ruler may go from the middle of the volume along `direction`: until a cross leaves a
// view or the depth of field; bisection to a micrometre.
double Reach_mm(const ExperimentTruth& truth, const Eigen::Matrix3d& rotation,
                const Eigen::Vector3d& direction) {
  const double margin_px = kCrossMargin_mm * truth.instrument.lens.magnification_px_per_mm;
  const double half_depth_mm = 0.5 * truth.instrument.depth_of_field_mm;
  const auto fits = [&](double distance_mm) {
    for (const SubBoard& board : truth.ruler.boards) {
      const Eigen::Vector3d point_mm =
          rotation * board.center_in_target_mm + distance_mm * direction;
      if (std::abs(point_mm.z()) > half_depth_mm) return false;
      if (Margin_px(truth.instrument, board.group, point_mm) < margin_px) return false;
    }
    return true;
  };
  double low_mm = 0, high_mm = 4;
  while (high_mm - low_mm > 1e-3) {
    const double middle_mm = 0.5 * (low_mm + high_mm);
    (fits(middle_mm) ? low_mm : high_mm) = middle_mm;
  }
  return low_mm;
}

std::vector<double> InventRulers(const CornerExperiment& experiment, ExperimentTruth& truth) {
  RandomStream random(KeyOf(experiment, StudyPurpose::kRuler));
  std::vector<double> positions;
  truth.rulers.clear();
  for (int i = 0; i < experiment.rulers; ++i) {
    const double position = experiment.rulers > 1 ? 2.0 * i / (experiment.rulers - 1) - 1 : 0;
    const Eigen::Matrix3d rotation =
        RandomRotation(random, Eigen::Vector3d::Constant(kRulerTilt_deg));
    Eigen::Vector3d direction(random.Normal(), random.Normal(), std::abs(random.Normal()));
    direction = (position < 0 ? -1 : 1) * direction.normalized();
    const double distance_mm = std::abs(position) * Reach_mm(truth, rotation, direction);
    const PlatePose pose{rotation, distance_mm * direction};
    truth.rulers.push_back({"ruler_" + std::to_string(i + 1), "", 0, pose, false});
    positions.push_back(position);
  }
  return positions;
}

Session SessionOf(const CornerExperiment& experiment, const ExperimentTruth& truth) {
  Session session = NominalSession(experiment.instrument);
  for (const PlateTruth& plate : truth.calibration)
    session.calibration_images.push_back({plate.image, plate.pose, plate.stage_mm});
  for (const PlateTruth& plate : truth.rulers) session.ruler_images.push_back(plate.image);
  return session;
}

double CalibrationPartOf(const RulerLength& length) {
  for (const BudgetLine& line : length.budget)
    if (line.source == "calibration") return line.standard_uncertainty;
  return 0;
}

}  // namespace

Result<CornerOutcome> RunCornerExperiment(const CornerExperiment& experiment) {
  const Session nominal = NominalSession(experiment.instrument);
  ExperimentTruth truth = InventApparatus(experiment.instrument, nominal);
  TELESTRAIN_RETURN_IF_ERROR(InventTargets(experiment, truth));
  CornerOutcome outcome;
  const std::vector<double> positions = InventRulers(experiment, truth);
  const Session session = SessionOf(experiment, truth);
  const auto boards = ObserveBoards(
      truth, {experiment.noise_px, KeyOf(experiment, StudyPurpose::kBoardNoise)}, kLeastCorners);
  CalibrationOptions options;
  options.model_choice.distortion_only = experiment.distortion_only;
  TELESTRAIN_ASSIGN_OR_RETURN(outcome.calibration, Calibrate(session, boards, options));
  const std::uint64_t cross_key = KeyOf(experiment, StudyPurpose::kCrossNoise);
  const ArrayState& state = outcome.calibration.bundle.state;
  const auto lengths =
      MeasureRuler(session, state.array, ObserveCrosses(truth, {experiment.noise_px, cross_key}));
  const auto exact = MeasureRuler(session, state.array, ObserveCrosses(truth, {0, cross_key}));
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (!lengths[i].rejected_because.empty() || !exact[i].rejected_because.empty()) continue;
    outcome.ruler_error_um.push_back(lengths[i].error_um);
    outcome.ruler_systematic_um.push_back(exact[i].error_um);
    outcome.ruler_position.push_back(positions[i]);
    outcome.ruler_calibration_part_um.push_back(CalibrationPartOf(lengths[i]));
  }
  if (outcome.ruler_error_um.empty())
    return EstimationFailed("no ruler could be measured: " + lengths.front().rejected_because);
  for (const BoardData& board : outcome.calibration.data.boards) {
    const Eigen::Matrix2Xd errors = ReprojectionErrors_px(state, board);
    for (Eigen::Index i = 0; i < errors.cols(); ++i)
      outcome.corner_error_px.push_back(errors.col(i).norm());
  }
  return outcome;
}

}  // namespace telestrain
