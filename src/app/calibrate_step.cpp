#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/list_arguments.h"
#include "app/results_folder.h"
#include "app/step_options.h"
#include "app/step_record.h"
#include "app/steps.h"
#include "base/files.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "calibration/calibration_comparison.h"
#include "calibration/calibration_file.h"
#include "target/detection.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

void WarnOfStage(const AmbiguityDecision& decision, Console& console) {
  if (decision.stage_pairs == 0)
    console.Warn(
        "no stage move among the images: the two-fold ambiguity was decided by the nominal "
        "views alone");
  else if (decision.stage_agreeing < decision.stage_pairs)
    console.Warn("only " + std::to_string(decision.stage_agreeing) + " of " +
                 std::to_string(decision.stage_pairs) +
                 " stage moves agree with the nominal views; check calibration.csv");
}

void SayRejected(const Calibration& calibration, Console& console) {
  const auto& rejected = calibration.data.rejected;
  const auto boards = std::count_if(rejected.begin(), rejected.end(), [](const auto& r) {
    return r.whole_board && r.corners > 0 && r.reason != kCulledReason;
  });
  if (boards > 0)
    console.Warn(
        CountText(static_cast<std::size_t>(boards), "board") +
        " with corners left out whole; 'rejected' in calibration.json says why, 'telestrain "
        "diagnose' what they look like");
  if (calibration.corners_rejected > 0)
    console.Note("  " +
                 CountText(static_cast<std::size_t>(calibration.corners_rejected), "corner") +
                 " rejected; calibration.json lists where and why");
}

void SayCalibration(const Calibration& calibration, Console& console) {
  const ArrayCalibration& array = calibration.bundle.state.array;
  console.Say("calibrate  magnification " + FormatFixed(array.Magnification_px_per_mm(), 4) +
              " px/mm, lens model " + ToText(array.model) + ", reprojection RMS " +
              FormatFixed(calibration.all.rms_px, 4) + " px over " +
              CountText(static_cast<std::size_t>(calibration.all.corners), "corner"));
  const CrossValidation& validation = calibration.cross_validation;
  if (validation.folds > validation.folds_skipped)
    console.Note("  images left out of the fit: RMS " + FormatFixed(validation.rms_px, 4) +
                 " px, " + FormatFixed(validation.expected_rms_px, 4) +
                 " px expected from the corners' own noise");
  if (validation.folds == 0)
    console.Warn(
        "fewer than 6 poses: nothing is left to check the calibration with images that it has not "
        "seen; take at least 6 poses");
  if (validation.folds_skipped > 0)
    console.Warn("of " + std::to_string(validation.folds) + " groups of poses " +
                 std::to_string(validation.folds_skipped) +
                 " could not be left out as a check: the rest does not determine the array; take "
                 "more poses that every view sees");
  if (calibration.sigma0 > 1.2 && !calibration.options.noise_is_assumed)
    console.Note("  residuals are " + FormatFixed(calibration.sigma0, 2) +
                 " times the corners' own noise; all uncertainties are enlarged by that");
  if (calibration.corners_below_half_weight > 0)
    console.Note(
        "  " +
        CountText(static_cast<std::size_t>(calibration.corners_below_half_weight), "corner") +
        " beyond three standard deviations: weighed down, but counted in the RMS");
  SayRejected(calibration, console);
}

void SayComparison(const fs::path& old_path, const std::vector<Change>& changes, Console& console) {
  console.Say("compare    against " + old_path.string() +
              " (new minus old, +- standard uncertainty)");
  std::size_t width = 0;
  for (const Change& change : changes) width = std::max(width, change.quantity.size());
  int moved = 0;
  for (const Change& change : changes) {
    const std::string value = FormatFixed(change.value, 3);
    console.Say("  " + change.quantity + std::string(width - change.quantity.size(), ' ') +
                std::string(value.size() < 10 ? 10 - value.size() : 0, ' ') + value + " +- " +
                FormatFixed(change.standard_uncertainty, 3) + " " + change.unit +
                (change.IsSignificant() ? "  moved" : ""));
    moved += change.IsSignificant();
  }
  console.Say(moved == 0 ? "  nothing moved beyond chance (3 standard uncertainties)"
                         : "  " + std::to_string(moved) +
                               " of these moved by more than 3 standard uncertainties");
}

Status Compare(const Session& session, const fs::path& results, const EarlierCalibration& earlier,
               const ArrayCalibration& array, Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<Change> changes,
                              CompareCalibrations(session, earlier.array, array));
  TELESTRAIN_RETURN_IF_ERROR(WriteJson(
      results / "comparison.json", ComparisonJson(changes, earlier.path.string(), earlier.sha256)));
  SayComparison(earlier.path, changes, console);
  return {};
}

// Known before anything is written.
Status RequireSameViews(const EarlierCalibration& earlier, const Session& session) {
  bool same = earlier.array.views.size() == session.views.size();
  for (std::size_t v = 0; same && v < session.views.size(); ++v)
    same = earlier.array.views[v].name == session.views[v].name;
  if (same) return {};
  return BadInput(earlier.path.string() +
                  ": has other views than the session; compare calibrations of one instrument");
}

StepRecord CalibrateRecord(const CalibrateChoices& choices) {
  StepRecord record{"calibrate",
                    OptionsJson(choices.arguments),
                    {"session.toml", "calibration.csv"},
                    {"inputs.json", "corners.vnl", "corner_covariances.csv", "detection.json"},
                    {},
                    {"calibration.json", "residuals.csv", "comparison.json"}};
  if (choices.earlier) record.inputs_elsewhere = {choices.earlier->path};
  return record;
}

}  // namespace

Result<CalibrateChoices> ReadChoices(const CalibrateArguments& arguments) {
  CalibrateChoices choices;
  choices.arguments = arguments;
  choices.options.robust = arguments.outliers == "weigh";
  if (arguments.outliers == "mrcal") choices.options.outliers.scale = OutlierScale::kMrcal;
  choices.options.board_warp = arguments.board_warp;
  for (const std::string& text : arguments.culled) {
    TELESTRAIN_ASSIGN_OR_RETURN(choices.options.culled.emplace_back(), CulledRegion(text));
  }
  if (arguments.compare.empty()) return choices;
  EarlierCalibration earlier{arguments.compare, {}, {}};
  TELESTRAIN_ASSIGN_OR_RETURN(earlier.array, ReadArrayCalibration(earlier.path));
  TELESTRAIN_ASSIGN_OR_RETURN(earlier.sha256, Sha256HexOfFile(earlier.path));
  choices.earlier = std::move(earlier);
  return choices;
}

Status CalibrateStep(const Session& session, const fs::path& results,
                     const CalibrateChoices& choices, Console& console, Earlier earlier) {
  TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results, Step::kCalibrate));
  if (earlier == Earlier::kKept) {
    TELESTRAIN_ASSIGN_OR_RETURN(const bool kept,
                                IsKept(results, CalibrateRecord(choices), console));
    if (kept) return {};
  }
  if (choices.earlier) TELESTRAIN_RETURN_IF_ERROR(RequireSameViews(*choices.earlier, session));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<BoardObservation> boards,
                              ReadDetectedBoards(session, results));
  CalibrationOptions options = choices.options;
  options.noise_is_assumed = session.corners_are_given;
  TELESTRAIN_RETURN_IF_ERROR(RemoveOutputsFrom(results, Step::kCalibrate));
  TELESTRAIN_ASSIGN_OR_RETURN(const Calibration calibration, Calibrate(session, boards, options));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto made_from,
                              HashesOf(results, {"inputs.json", "corners.vnl",
                                                 "corner_covariances.csv", "detection.json"}));
  TELESTRAIN_RETURN_IF_ERROR(
      WriteFileAtomically(results / "residuals.csv", ResidualsCsv(session, calibration)));
  TELESTRAIN_RETURN_IF_ERROR(
      WriteJson(results / "calibration.json", CalibrationJson(session, calibration, made_from)));
  WarnOfStage(calibration.seed.decision, console);
  SayCalibration(calibration, console);
  if (choices.earlier)
    TELESTRAIN_RETURN_IF_ERROR(
        Compare(session, results, *choices.earlier, calibration.bundle.state.array, console));
  return RecordStep(results, CalibrateRecord(choices));
}

}  // namespace telestrain
