#include "simulation/experiment_truth.h"

#include <cmath>
#include <numbers>

#include "base/numbers.h"
#include "geometry/rotation.h"
#include "simulation/load_plan.h"
#include "simulation/nominal_session.h"
#include "simulation/random_keys.h"

namespace telestrain {
namespace {

constexpr double kTravel_mm = 1.0;

std::string Numbered(const std::string& stem, int number) {
  std::string digits = std::to_string(number);
  if (digits.size() < 3) digits.insert(0, 3 - digits.size(), '0');
  return stem + digits;
}

// The nominal axis turned by exactly `error_deg` in a random direction.
Eigen::Vector3d TrueStageAxis(const Eigen::Vector3d& nominal, double error_deg,
                              RandomStream& random) {
  const double direction = random.Uniform(0, 2 * std::numbers::pi);
  const Eigen::Vector3d turn(std::cos(direction), std::sin(direction), 0);
  return ExpRotation(error_deg * std::numbers::pi / 180 * turn) * nominal;
}

TargetSpec TrueTarget(TargetSpec target, double separation_error_um) {
  for (SubBoard& board : target.boards) {
    const double side = board.center_in_target_mm.x() < 0 ? -1 : 1;
    board.center_in_target_mm.x() += 0.5e-3 * side * separation_error_um;
  }
  return target;
}

Status InventCalibration(const VirtualExperimentOptions& options, ExperimentTruth& truth) {
  RandomStream random(RandomKey(options.seed, RandomPurpose::kStage));
  random.Uniform();  // the stage's axis took the first number
  PosePlanRequest request;
  request.cut_off_poses = options.cut_off_poses;
  request.whole_poses = options.poses - options.cut_off_poses;
  request.tilt_deg = options.pose_tilt_deg;
  request.key = RandomKey(options.seed, RandomPurpose::kBoardPoses);
  for (int i = 0; i < options.poses; ++i)
    request.travels_in_array_mm.push_back((kTravel_mm + options.stage_sigma_mm * random.Normal()) *
                                          truth.stage_axis_in_array);
  TELESTRAIN_ASSIGN_OR_RETURN(const auto pairs, PlanPoses(truth.instrument, truth.target, request));
  for (int i = 0; i < options.poses; ++i) {
    const std::string pose = Numbered("P", i + 1);
    const std::string stem = Numbered("calibration/pose_", i + 1);
    truth.calibration.push_back(
        {stem + "_stage_0.png", pose, 0, pairs[i].at_start, pairs[i].is_cut_off});
    truth.calibration.push_back(
        {stem + "_stage_1.png", pose, kTravel_mm, pairs[i].after_travel, pairs[i].is_cut_off});
  }
  return {};
}

Status InventRulers(const VirtualExperimentOptions& options, ExperimentTruth& truth) {
  PosePlanRequest request;
  request.whole_poses = options.ruler_images;
  request.key = RandomKey(options.seed, RandomPurpose::kRulerPoses);
  TELESTRAIN_ASSIGN_OR_RETURN(const auto pairs, PlanPoses(truth.instrument, truth.ruler, request));
  for (int i = 0; i < options.ruler_images; ++i)
    truth.rulers.push_back(
        {Numbered("ruler/ruler_", i + 1) + ".png", "", 0, pairs[i].at_start, false});
  return {};
}

}  // namespace

ExperimentTruth InventApparatus(const VirtualExperimentOptions& options, const Session& nominal) {
  ExperimentTruth truth;
  truth.instrument = MakeInstrument(options, nominal);
  RandomStream random(RandomKey(options.seed, RandomPurpose::kStage));
  truth.stage_axis_in_array =
      TrueStageAxis(nominal.stage_axis_in_array, options.stage_error_deg, random);
  truth.target = TrueTarget(nominal.target, options.separation_error_um);
  truth.ruler_length_mm = nominal.ruler.length_mm + 1e-3 * options.ruler_error_um;
  truth.ruler = RulerAsTarget(nominal.target, truth.ruler_length_mm);
  return truth;
}

Result<ExperimentTruth> InventTruth(const VirtualExperimentOptions& options,
                                    const Session& nominal) {
  ExperimentTruth truth = InventApparatus(options, nominal);
  TELESTRAIN_RETURN_IF_ERROR(InventCalibration(options, truth));
  TELESTRAIN_RETURN_IF_ERROR(InventRulers(options, truth));
  truth.pipe = PlanLoads(options, nominal.pipe);
  return truth;
}

}  // namespace telestrain
