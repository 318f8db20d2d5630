// The paper's section 4.1 and 4.2: 1200 images of the target, 850 of the ruler, Fig. 12 to 14.
#include <cmath>

#include "base/numbers.h"
#include "study/calibration_arms.h"

namespace telestrain {
namespace {

constexpr double kPaperMean_px = 0.78, kPaperMean_um = 0.612, kPaperSd_um = 1.74,
                 kPaperMax_um = 10.02;
// All arms share their random numbers, so chance is common to them: a switch makes a U when the
// ratio of the error at the ends to that in the middle is this much larger than without it.
constexpr double kMakesU = 1.1;

StudyTable TableOf(const std::vector<CalibrationArmOutcome>& arms) {
  StudyTable table{"arms",
                   "Every arm: one calibration and its rulers",
                   {{"arm", ""},
                    {"corners", ""},
                    {"corner mean", "px"},
                    {"corner RMS", "px"},
                    {"ruler mean", "µm"},
                    {"ruler sd", "µm"},
                    {"ruler max", "µm"},
                    {"edge / middle", ""},
                    {"without noise: middle", "µm"},
                    {"edge", "µm"}},
                   {}};
  for (const CalibrationArmOutcome& arm : arms)
    table.rows.push_back(
        {arm.arm.name, StudyNumber{static_cast<double>(arm.corner_px.count), 0},
         StudyNumber{arm.corner_px.mean, 4}, StudyNumber{arm.outcome.calibration.all.rms_px, 4},
         StudyNumber{arm.ruler_um.mean, 3}, StudyNumber{arm.ruler_um.sd, 3},
         StudyNumber{arm.ruler_um.max_abs, 2}, StudyNumber{arm.edge_over_middle, 2},
         StudyNumber{arm.systematic_middle_um, 3}, StudyNumber{arm.systematic_edge_um, 3}});
  return table;
}

std::string Um(double value, int decimals = 3) { return FormatFixed(value, decimals); }

// Without a systematic error the ruler's sd is sigma_q = noise / m; the scatter of an sd of N
// values is sd / sqrt(2 N), of their mean sd / sqrt N. Limits are at four of these.
void CompareNoiseArm(const CalibrationArmOutcome& arm, StudyResult& result) {
  const double magnification = arm.outcome.calibration.bundle.state.array.Magnification_px_per_mm();
  const double noise_um = 1000 * arm.arm.experiment.noise_px / magnification;
  const double count = arm.ruler_um.count;
  const double part_um = FiguresOf(arm.outcome.ruler_calibration_part_um).rms;
  const double sd_limit_um = 1.05 * noise_um + 4 * noise_um / std::sqrt(2 * count);
  const double mean_limit_um = 4 * std::hypot(noise_um / std::sqrt(count), part_um);
  const std::string where = "ruler at " + FormatShortest(arm.arm.experiment.noise_px) + " px: ";
  result.comparison.push_back(
      {where + "standard deviation", "µm", Um(kPaperSd_um, 2), Um(arm.ruler_um.sd),
       "≤ " + Um(sd_limit_um), arm.ruler_um.sd <= sd_limit_um,
       "ours: white noise only; the limit is noise / magnification, 5 % for "
       "the calibration and 4 sigma of chance"});
  result.comparison.push_back({where + "mean error", "µm", Um(kPaperMean_um), Um(arm.ruler_um.mean),
                               "|mean| ≤ " + Um(mean_limit_um),
                               std::abs(arm.ruler_um.mean) <= mean_limit_um,
                               "ours: certificates are exact; the limit is 4 sigma of the mean"});
  result.comparison.push_back(
      {where + "largest error", "µm", Um(kPaperMax_um, 2), Um(arm.ruler_um.max_abs, 2), "-",
       std::nullopt, "the largest of 850 normal errors is about 3.4 sd; the paper's is 5.8 sd"});
}

// RMS of a coordinate = sigma sqrt(1 - parameters / residuals).
void CompareFit(const CalibrationArmOutcome& arm, StudyResult& result) {
  const BundleResult& bundle = arm.outcome.calibration.bundle;
  const double expected_px =
      arm.arm.experiment.noise_px *
      std::sqrt(1 - static_cast<double>(bundle.parameter_count) / bundle.residual_count);
  const double rms_px = arm.outcome.calibration.all.rms_px;
  result.comparison.push_back(
      {"reprojection at " + FormatShortest(arm.arm.experiment.noise_px) + " px noise: RMS", "px",
       "-", Um(rms_px, 4), Um(expected_px, 4) + " ± 1 %",
       std::abs(rms_px / expected_px - 1) <= 0.01,
       "the limit is sigma sqrt(1 - parameters / residuals)"});
  result.comparison.push_back(
      {"same: mean of the corner error", "px", Um(kPaperMean_px, 2), Um(arm.corner_px.mean, 3), "-",
       std::nullopt, "the paper does not say whether its 0.78 px is a mean norm or an RMS"});
}

StudyPlot CornerPlot(const std::vector<CalibrationArmOutcome>& arms) {
  StudyPlot plot{"fig12",
                 "Reprojection error (paper Fig. 12)",
                 "Share of the corners by the norm of their reprojection error. White noise gives "
                 "Rayleigh's distribution.",
                 {"reprojection error / px", false},
                 {"corners / %", false},
                 {},
                 {}};
  for (const CalibrationArmOutcome* arm :
       {&ArmOf(arms, ArmRole::kNoiseOfFit), &ArmOf(arms, ArmRole::kNoiseOfRuler),
        &ArmOf(arms, ArmRole::kAll)}) {
    const Histogram histogram = HistogramOf(arm->outcome.corner_error_px, 0, 3, 60);
    plot.series.push_back(
        {arm->arm.name, SeriesKind::kStep, histogram.centers, histogram.percent, {}});
  }
  return plot;
}

StudyPlot RulerPlot(const std::vector<CalibrationArmOutcome>& arms) {
  StudyPlot plot{"fig13",
                 "Ruler error (paper Fig. 13)",
                 "Share of the ruler lengths by their error against the certificate.",
                 {"error of the ruler's length / µm", false},
                 {"lengths / %", false},
                 {},
                 {}};
  for (const CalibrationArmOutcome* arm :
       {&ArmOf(arms, ArmRole::kNoiseOfFit), &ArmOf(arms, ArmRole::kNoiseOfRuler),
        &ArmOf(arms, ArmRole::kAll)}) {
    const Histogram histogram = HistogramOf(arm->outcome.ruler_error_um, -12, 12, 48);
    plot.series.push_back(
        {arm->arm.name, SeriesKind::kStep, histogram.centers, histogram.percent, {}});
  }
  return plot;
}

StudyPlot ProfilePlot(const std::vector<CalibrationArmOutcome>& arms, bool with_noise) {
  StudyPlot plot{with_noise ? "fig14" : "fig14_systematic",
                 with_noise ? "Ruler error over the measurement volume (paper Fig. 14)"
                            : "The same without the noise of the crosses",
                 with_noise ? "RMS error of the ruler by its place on lines through the middle of "
                              "the volume; at -1 and 1 a cross leaves a view or the depth of field."
                            : "What calibration, optics and certificates alone are wrong by: the "
                              "shape of the U.",
                 {"place of the ruler, share of the volume", false},
                 {"RMS error / µm", !with_noise},
                 {},
                 {}};
  if (with_noise) plot.limits = {{kPaperSd_um, "paper sd 1.74 µm"}};
  for (const CalibrationArmOutcome& one : arms) {
    if (one.arm.role == ArmRole::kNoiseOfFit) continue;  // the others have the ruler's noise
    const Profile& profile = with_noise ? one.profile : one.systematic;
    plot.series.push_back({one.arm.name, SeriesKind::kLine, profile.position, profile.rms, {}});
  }
  return plot;
}

// What the switches say about the paper's explanations, from the figures.
std::string AnswerOf(const std::vector<CalibrationArmOutcome>& arms) {
  const double plain = ArmOf(arms, ArmRole::kNoiseOfRuler).edge_over_middle;
  std::string causes, others;
  for (const CalibrationArmOutcome& one : arms) {
    if (one.arm.role != ArmRole::kExplanation) continue;
    std::string& list = one.edge_over_middle > kMakesU * plain ? causes : others;
    list += (list.empty() ? "" : ", ") + one.arm.differs + " (" +
            FormatFixed(one.edge_over_middle, 2) + ")";
  }
  const CalibrationArmOutcome& all = ArmOf(arms, ArmRole::kAll);
  return "With noise alone the ruler's RMS error at the ends of the volume is " +
         FormatFixed(plain, 2) + " times that in the middle. " +
         (causes.empty() ? "No explanation alone makes a U." : "A U is made by: " + causes + ".") +
         (others.empty() ? "" : " Not by: " + others + ".") + " With all of them the ratio is " +
         FormatFixed(all.edge_over_middle, 2) + ", the ruler's mean error " +
         FormatFixed(all.ruler_um.mean, 2) + " µm, sd " + FormatFixed(all.ruler_um.sd, 2) +
         " µm, largest " + FormatFixed(all.ruler_um.max_abs, 1) + " µm.";
}

void CompareAll(const CalibrationArmOutcome& arm, StudyResult& result) {
  result.comparison.push_back({"ruler, all switches: mean error", "µm", Um(kPaperMean_um),
                               Um(arm.ruler_um.mean), "-", std::nullopt,
                               "certificates at the end of their ±0.25 µm"});
  result.comparison.push_back(
      {"ruler, all switches: standard deviation", "µm", Um(kPaperSd_um, 2), Um(arm.ruler_um.sd),
       "-", std::nullopt, "defocus, boards and sampling as the paper suspects, in our amounts"});
  result.comparison.push_back({"ruler, all switches: largest error", "µm", Um(kPaperMax_um, 2),
                               Um(arm.ruler_um.max_abs, 2), "-", std::nullopt, "the same"});
}

}  // namespace

Result<StudyResult> StudyPaperCalibration(const StudyOptions& options, const std::filesystem::path&,
                                          Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<CalibrationArmOutcome> arms,
                              RunCalibrationArms(options, console));
  StudyResult result;
  result.study = "paper-calibration";
  result.title = "Calibration and ruler, as in section 4 of the paper";
  result.question =
      "What do the target and ruler images of the paper give at its noise, and what makes "
      "the ruler's error grow towards the ends of the volume?";
  result.answer = AnswerOf(arms);
  for (const CalibrationArmOutcome* arm :
       {&ArmOf(arms, ArmRole::kNoiseOfFit), &ArmOf(arms, ArmRole::kNoiseOfRuler)}) {
    CompareFit(*arm, result);
    CompareNoiseArm(*arm, result);
  }
  CompareAll(ArmOf(arms, ArmRole::kAll), result);
  result.plots = {CornerPlot(arms), RulerPlot(arms), ProfilePlot(arms, true),
                  ProfilePlot(arms, false)};
  result.tables = {TableOf(arms)};
  result.notes = {
      "Corners are simulated without images in between: true pixel plus Gaussian noise that grows "
      "with the square root of the blur.",
      "The paper's explanations are switches on the arm with 0.395 px noise, one at a time and "
      "then together. Their amounts are ours, the paper gives none."};
  result.settings = {{"target images", std::to_string(2 * arms.front().arm.experiment.poses), ""},
                     {"ruler images", std::to_string(arms.front().arm.experiment.rulers), ""}};
  return result;
}

}  // namespace telestrain
