#include "study/calibration_arms.h"

#include <algorithm>
#include <cmath>

namespace telestrain {
namespace {

constexpr int kPaperImages = 1200, kPaperRulers = 850;
constexpr double kNoiseOfFit_px = 0.78;     // the paper's reprojection error, taken as noise
constexpr double kNoiseOfRuler_px = 0.395;  // what the paper's ruler sd of 1.74 um stands for
constexpr double kCertificate_um = 0.25;    // accuracy of the paper's target and ruler
constexpr int kProfileBins = 11;
constexpr double kEdge = 0.8, kMiddle = 0.4;  // shares of the way from the middle to the end
// Aperture and residual telecentricity of a good lens of this class (0.16 deg lean of a chief ray
// at the corner of the field), for the arm that tests the paper's defocus explanation.
constexpr double kAperture = 0.02, kTelecentricity_percent_per_mm = 0.05;
constexpr int kSparsePoses = 9;
constexpr double kSparseRange = 0.5;  // poses from the middle of the volume only

CornerExperiment Dense(const StudyOptions& options, double noise_px) {
  CornerExperiment experiment;
  experiment.instrument.seed = options.seed;
  experiment.instrument.threads = options.threads;
  experiment.noise_px = noise_px;
  experiment.distortion_only = true;  // what the paper could fit
  experiment.poses = options.Scaled(kPaperImages / 2, 9);
  experiment.rulers = options.Scaled(kPaperRulers, 50);
  return experiment;
}

void AddDefocus(CornerExperiment& experiment) {
  experiment.instrument.numerical_aperture = kAperture;
  experiment.instrument.telecentricity_percent_per_mm = kTelecentricity_percent_per_mm;
}
void AddWholeBoardsOnly(CornerExperiment& experiment) { experiment.use_cut_off_boards = false; }
void AddSparseSampling(CornerExperiment& experiment) {
  experiment.poses = kSparsePoses;
  experiment.range_share = kSparseRange;
}
void AddCertificates(CornerExperiment& experiment) {
  experiment.instrument.separation_error_um = -kCertificate_um;
  experiment.instrument.ruler_error_um = kCertificate_um;
}

std::vector<CalibrationArm> ArmsOf(const StudyOptions& options) {
  const CornerExperiment low = Dense(options, kNoiseOfRuler_px);
  std::vector<CalibrationArm> arms{
      {ArmRole::kNoiseOfFit, "noise 0.78 px", "white corner noise alone",
       Dense(options, kNoiseOfFit_px)},
      {ArmRole::kNoiseOfRuler, "noise 0.395 px", "white corner noise alone", low}};
  CalibrationArm all{ArmRole::kAll, "all of them", "the four together", low};
  const auto explain = [&](const char* name, const char* differs, void (*add)(CornerExperiment&)) {
    arms.push_back({ArmRole::kExplanation, name, differs, low});
    add(arms.back().experiment);
    add(all.experiment);
  };
  explain("+ defocus", "aperture 0.02 and chief rays that lean by 0.05 %/mm", AddDefocus);
  explain("+ no cut-off boards", "only poses whose boards are whole in every view",
          AddWholeBoardsOnly);
  explain("+ sparse sampling", "9 poses from the middle of the volume", AddSparseSampling);
  explain("+ certificates", "separation -0.25 µm, ruler +0.25 µm off", AddCertificates);
  arms.push_back(all);
  return arms;
}

// RMS of the errors whose place is further from the middle than `from` and not than `to`.
double RmsBetween(const CornerOutcome& outcome, const std::vector<double>& errors_um, double from,
                  double to) {
  std::vector<double> chosen;
  for (std::size_t i = 0; i < errors_um.size(); ++i) {
    const double from_middle = std::abs(outcome.ruler_position[i]);
    if (from_middle >= from && from_middle <= to) chosen.push_back(errors_um[i]);
  }
  return FiguresOf(chosen).rms;
}

void DescribeProfile(CalibrationArmOutcome& arm) {
  const CornerOutcome& outcome = arm.outcome;
  arm.ruler_um = FiguresOf(outcome.ruler_error_um);
  arm.corner_px = FiguresOf(outcome.corner_error_px);
  arm.profile = ProfileOf(outcome.ruler_position, outcome.ruler_error_um, kProfileBins);
  arm.systematic = ProfileOf(outcome.ruler_position, outcome.ruler_systematic_um, kProfileBins);
  arm.edge_over_middle = RmsBetween(outcome, outcome.ruler_error_um, kEdge, 1) /
                         RmsBetween(outcome, outcome.ruler_error_um, 0, kMiddle);
  arm.systematic_edge_um = RmsBetween(outcome, outcome.ruler_systematic_um, kEdge, 1);
  arm.systematic_middle_um = RmsBetween(outcome, outcome.ruler_systematic_um, 0, kMiddle);
}

}  // namespace

Result<std::vector<CalibrationArmOutcome>> RunCalibrationArms(const StudyOptions& options,
                                                              Console& console) {
  const std::vector<CalibrationArm> arms = ArmsOf(options);
  std::vector<CalibrationArmOutcome> outcomes;
  for (const CalibrationArm& arm : arms) {
    auto outcome = RunCornerExperiment(arm.experiment);
    if (!outcome) return Error{outcome.error().kind, arm.name + ": " + outcome.error().message};
    CalibrationArmOutcome& done = outcomes.emplace_back();
    done.arm = arm;
    done.outcome = std::move(outcome).value();
    DescribeProfile(done);
    console.Progress("study", static_cast<int>(outcomes.size()), static_cast<int>(arms.size()));
  }
  return outcomes;
}

const CalibrationArmOutcome& ArmOf(const std::vector<CalibrationArmOutcome>& arms, ArmRole role) {
  const auto at = std::find_if(arms.begin(), arms.end(), [role](const CalibrationArmOutcome& one) {
    return one.arm.role == role;
  });
  TELESTRAIN_CHECK(at != arms.end(), "no arm of this role");
  return *at;
}

}  // namespace telestrain
