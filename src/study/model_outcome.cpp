#include "study/model_outcome.h"

#include "base/numbers.h"
#include "diagnostics/pinhole_calibration.h"
#include "diagnostics/pinhole_ruler.h"
#include "study/statistics.h"

namespace telestrain {
namespace {

void AddErrors(const Eigen::Matrix2Xd& errors_px, ModelOutcome& outcome) {
  for (Eigen::Index i = 0; i < errors_px.cols(); ++i)
    outcome.corner_error_px.push_back(errors_px.col(i).norm());
}

ModelOutcome TelecentricOutcome(const ImageOutcome& images) {
  const Calibration& calibration = images.calibration;
  ModelOutcome outcome;
  outcome.name = "telecentric";
  outcome.rms_px = calibration.all.rms_px;
  outcome.ruler_error_um = images.RulerErrors_um();
  for (const BoardData& board : calibration.data.boards)
    AddErrors(ReprojectionErrors_px(calibration.bundle.state, board), outcome);
  outcome.remark = "distortion " + ToText(calibration.bundle.state.array.model);
  return outcome;
}

std::string RemarkOf(const PinholeCalibration& fit) {
  constexpr double kRunsAway = 100;  // times the start
  std::string remark = std::to_string(fit.iterations) + " iterations";
  if (fit.hit_iteration_limit) remark += ", stopped by the limit";
  if (fit.focal_length_growth > kRunsAway)
    remark += ", no finite optimum: focal length x " + FormatFixed(fit.focal_length_growth, 0);
  return remark;
}

struct Arm {
  ModelKind kind;
  std::string name;
  PinholeOptions options;
};

std::vector<Arm> PinholeArms() {
  PinholeOptions options;
  options.free_distortion = true;
  std::vector<Arm> arms;
  for (const double distance_mm :
       {kNearDistance_mm, 300.0, kMiddleDistance_mm, 3000.0, 10000.0, kFarDistance_mm}) {
    options.working_distance_mm = distance_mm;
    arms.push_back({ModelKind::kLockedPinhole, "pinhole, D " + DistanceText(distance_mm), options});
  }
  options.principal_at_sensor_middle = true;
  const Arm centered{ModelKind::kCenteredPinhole,
                     "pinhole, D " + DistanceText(kFarDistance_mm) + ", lens centre known",
                     options};
  options.principal_at_sensor_middle = false;
  options.lock_core = false;
  for (const double distance_mm : {kNearDistance_mm, kMiddleDistance_mm}) {
    options.working_distance_mm = distance_mm;
    arms.push_back(
        {ModelKind::kFreePinhole, "pinhole, f free, from D " + DistanceText(distance_mm), options});
  }
  arms.push_back(centered);
  return arms;
}

Result<ModelOutcome> PinholeOutcome(const ImageOutcome& images, const Arm& arm) {
  const Calibration& calibration = images.calibration;
  TELESTRAIN_ASSIGN_OR_RETURN(
      const PinholeCalibration fit,
      CalibratePinhole(images.session, calibration.data, calibration.bundle.state, arm.options));
  ModelOutcome outcome{arm.kind, arm.name,     arm.options.working_distance_mm, fit.all.rms_px, {},
                       {},       RemarkOf(fit)};
  for (const Eigen::Matrix2Xd& errors_px : fit.errors_px) AddErrors(errors_px, outcome);
  for (const PinholeRulerLength& length :
       MeasureRulerWithPinhole(images.session, fit.views, images.detection.crosses))
    if (length.rejected_because.empty()) outcome.ruler_error_um.push_back(length.error_um);
  return outcome;
}

}  // namespace

double ModelOutcome::RulerRms_um() const { return FiguresOf(ruler_error_um).rms; }

Result<std::vector<ModelOutcome>> FitModels(const ImageOutcome& images, Console& console) {
  const std::vector<Arm> arms = PinholeArms();
  std::vector<ModelOutcome> models{TelecentricOutcome(images)};
  for (const Arm& arm : arms) {
    TELESTRAIN_ASSIGN_OR_RETURN(ModelOutcome model, PinholeOutcome(images, arm));
    models.push_back(std::move(model));
    console.Progress("fitting", static_cast<int>(models.size()) - 1, static_cast<int>(arms.size()));
  }
  return models;
}

std::string DistanceText(double distance_mm) {
  return distance_mm < 1000 ? FormatShortest(distance_mm) + " mm"
                            : FormatShortest(distance_mm / 1000) + " m";
}

}  // namespace telestrain
