#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "app/results_folder.h"
#include "app/step_record.h"
#include "app/steps.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "diagnostics/diagnosis.h"
#include "report/rounding.h"
#include "target/detection.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

struct Line {
  std::string what, value, limit, judgement;
};

void SayTable(const std::vector<Line>& lines, Console& console) {
  std::array<std::size_t, 3> width{};
  for (const Line& line : lines)
    for (std::size_t i = 0; const std::string* text : {&line.what, &line.value, &line.limit})
      width[i] = std::max(width[i], text->size()), ++i;
  const auto padded = [](const std::string& text, std::size_t to) {
    return text + std::string(to - text.size(), ' ');
  };
  for (const Line& line : lines)
    console.Say("  " + padded(line.what, width[0]) + "  " + padded(line.value, width[1]) + "  " +
                padded(line.limit, width[2]) + "  " + line.judgement);
}

std::string Pixels(double value_px) { return PrintSignificant(value_px, 2) + " px"; }

std::vector<Line> OptimumLines(const IndependentOptimum& optimum) {
  const auto line = [](const char* what, double value_px) {
    return Line{what, Pixels(value_px), "at most " + Pixels(kMaxResidualDifference_px),
                value_px <= kMaxResidualDifference_px ? "agrees" : "DISAGREES"};
  };
  return {line("mrcal's optimum, undistorted model", optimum.max_residual_difference_px),
          {"  magnifications, relative", PrintSignificant(optimum.max_magnification_difference, 2),
           "", ""},
          {"  rotations between views",
           PrintSignificant(optimum.max_rotation_difference_rad, 2) + " rad", "", ""},
          line("mrcal's projection, our solution", optimum.evaluated_max_residual_difference_px)};
}

std::vector<Line> ResidualLines(const Diagnosis& diagnosis) {
  const ResidualSummary summary = Summarise(diagnosis.residuals);
  const NoiseReport& noise = diagnosis.verdict.noise;
  const auto p = [](double value) {
    return value < 1e-12 ? std::string("p < 1e-12") : "p " + PrintSignificant(value, 2);
  };
  std::size_t marked = 0;
  for (const OutlierPass& pass : diagnosis.outlier_replay) marked += pass.marked.size();
  return {
      {"residuals, RMS of a coordinate", Pixels(summary.rms_per_scalar_px),
       "expected " + Pixels(diagnosis.expected_rms_px), ""},
      {"  over the corners' stated noise", FormatFixed(noise.chi_square.sigma0, 3), "expected 1",
       p(noise.chi_square.p_value) + " (chi-square)"},
      {"  normally distributed", "", "", p(noise.normality.p_value) + " (Anderson-Darling)"},
      {"  independent of their neighbours", "", "", p(noise.SmallestSpatialP()) + " (Moran's I)"},
      {"  steady over the images", "", "", p(noise.SmallestTrendP()) + " (trend)"},
      {"  outliers by mrcal's rule", std::to_string(marked), "", ""}};
}

std::vector<Line> UncertaintyLines(const std::vector<UncertaintyMap>& maps) {
  std::vector<Line> lines;
  for (const UncertaintyMap& map : maps)
    lines.push_back(
        {"projection of " + map.view + " known to",
         PrintSignificant(map.of_noise.mean_um, 2) + " um",
         "at most " + PrintSignificant(map.of_noise.largest_um, 2) + " um",
         "with the certificate " + PrintSignificant(map.of_everything.largest_um, 2) + " um"});
  return lines;
}

std::vector<Line> PinholeLines(const PinholeComparison& pinhole) {
  std::vector<Line> lines{
      {"telecentric, as calibrated", Pixels(pinhole.telecentric.rms_px), "", ""}};
  for (const PinholeArm& arm : pinhole.arms)
    lines.push_back({"  pinhole at " + PrintSignificant(arm.working_distance_mm / 1000, 2) + " m" +
                         (arm.five_coefficients ? ", 5 coefficients" : ""),
                     Pixels(arm.reprojection.rms_px),
                     arm.ruler_error_um.empty()
                         ? ""
                         : "ruler RMSE " + PrintSignificant(arm.ruler_rmse_um, 2) + " um",
                     arm.converged ? "" : "not converged"});
  return lines;
}

void SayFindings(const std::vector<PatternFinding>& findings, Console& console) {
  for (const PatternFinding& finding : findings) {
    console.Say("  " + finding.text);
    console.Say("    " + finding.remedy);
  }
}

std::string OptimumText(const IndependentOptimum& optimum) {
  const double largest_px =
      std::max(optimum.max_residual_difference_px, optimum.evaluated_max_residual_difference_px);
  return optimum.agrees() ? "mrcal agrees to " + Pixels(largest_px) + "."
                          : "mrcal DISAGREES by " + Pixels(largest_px) + ".";
}

void SayTables(const Diagnosis& diagnosis, Console& console) {
  std::vector<Line> lines = ResidualLines(diagnosis);
  const auto append = [&](const std::vector<Line>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
  };
  if (diagnosis.optimum) append(OptimumLines(*diagnosis.optimum));
  append(UncertaintyLines(diagnosis.maps));
  if (diagnosis.pinhole) append(PinholeLines(*diagnosis.pinhole));
  SayTable(lines, console);
  if (diagnosis.length)
    for (const std::string& sentence : diagnosis.length->sentences) console.Say("  " + sentence);
}

void SayDiagnosis(const Diagnosis& diagnosis, bool with_table, Console& console) {
  console.Say("diagnose   " + diagnosis.verdict.text +
              (diagnosis.left_out.empty()
                   ? ""
                   : " But " + CountText(diagnosis.left_out.size(), "board") +
                         " did not fit and had to be left out.") +
              (diagnosis.optimum ? " " + OptimumText(*diagnosis.optimum) : ""));
  SayFindings(diagnosis.verdict.findings, console);
  SayFindings(diagnosis.left_out, console);
  if (with_table) SayTables(diagnosis, console);
  if (!diagnosis.optimum)
    console.Warn("not checked against mrcal: " + diagnosis.optimum_missing_because);
  if (!diagnosis.pinhole)
    console.Warn("not compared with pinhole cameras: " + diagnosis.pinhole_missing_because);
  if (diagnosis.optimum && !diagnosis.optimum->agrees())
    console.Warn(
        "mrcal and this program disagree: do not use this calibration before the reason is known");
}

StepRecord DiagnoseRecord() {
  return {"diagnose",
          nlohmann::ordered_json::object(),
          {},
          {"inputs.json", "calibration.json", "residuals.csv", "detection.json", "corners.vnl",
           "corner_covariances.csv"},
          {},
          {"mrcal.json"}};
}

}  // namespace

Result<int> DiagnoseStep(const fs::path& results, bool with_table, Console& console) {
  TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results, Step::kDiagnose));
  TELESTRAIN_ASSIGN_OR_RETURN(const Session session, RecordedSession(results));
  TELESTRAIN_ASSIGN_OR_RETURN(const CalibrationRecord record,
                              ReadCalibrationRecord(session, results));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<BoardObservation> boards,
                              ReadDetectedBoards(session, results));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<CrossObservation> crosses,
                              ReadDetectedCrosses(results));
  TELESTRAIN_RETURN_IF_ERROR(RemoveOutputsFrom(results, Step::kDiagnose));
  TELESTRAIN_ASSIGN_OR_RETURN(const Diagnosis diagnosis,
                              Diagnose(session, record, boards, crosses));
  TELESTRAIN_ASSIGN_OR_RETURN(
      const auto made_from,
      HashesOf(results, {"calibration.json", "residuals.csv", "detection.json", "corners.vnl",
                         "corner_covariances.csv"}));
  TELESTRAIN_RETURN_IF_ERROR(
      WriteJson(results / "mrcal.json", DiagnosisJson(session, record, diagnosis, made_from)));
  SayDiagnosis(diagnosis, with_table, console);
  TELESTRAIN_RETURN_IF_ERROR(RecordStep(results, DiagnoseRecord()));
  return diagnosis.optimum && !diagnosis.optimum->agrees() ? 1 : 0;
}

Status DiagnoseStep(const fs::path& results, Console& console, Earlier earlier) {
  TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results, Step::kDiagnose));
  if (earlier == Earlier::kKept) {
    TELESTRAIN_ASSIGN_OR_RETURN(const bool kept, IsKept(results, DiagnoseRecord(), console));
    if (kept) return {};
  }
  const auto checked = DiagnoseStep(results, false, console);
  return checked ? Status() : Status(checked.error());
}

}  // namespace telestrain
