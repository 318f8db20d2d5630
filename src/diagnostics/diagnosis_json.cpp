#include <array>
#include <nlohmann/json.hpp>
#include <numbers>

#include "diagnostics/diagnosis.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;
constexpr std::size_t kWorstBoards = 20;

std::string ImageName(const CalibrationRecord& record, int image) {
  return image < 0 ? "" : record.data.images[static_cast<std::size_t>(image)].image;
}

std::string ViewName(const CalibrationRecord& record, int view) {
  return view < 0 ? "" : record.state.array.views[static_cast<std::size_t>(view)].name;
}

Json OptimumJson(const Diagnosis& diagnosis) {
  if (!diagnosis.optimum)
    return {{"agrees", nullptr}, {"missing_because", diagnosis.optimum_missing_because}};
  const IndependentOptimum& optimum = *diagnosis.optimum;
  return {{"max_residual_difference_px", optimum.max_residual_difference_px},
          {"max_magnification_difference", optimum.max_magnification_difference},
          {"max_rotation_difference_rad", optimum.max_rotation_difference_rad},
          {"evaluated_max_residual_difference_px", optimum.evaluated_max_residual_difference_px},
          {"agrees", optimum.agrees()},
          {"limits", {{"residual_difference_px", kMaxResidualDifference_px}}},
          {"model", "undistorted, a magnification per view, from the closed-form start"},
          {"evaluated", "the calibration's own solution"},
          {"mrcal_converged", optimum.mrcal_converged},
          {"rms_px", optimum.rms_px},
          {"mrcal_rms_px", optimum.mrcal_rms_px},
          {"images", optimum.images},
          {"images_left_out", optimum.images_left_out},
          {"telecentricity_left_out_per_mm", optimum.telecentricity_left_out_per_mm}};
}

Json SummaryJson(const ResidualSummary& summary) {
  return {{"corners", summary.corners},
          {"rms_px", summary.rms_per_scalar_px},
          {"rms_per_corner_px", summary.rms_of_inliers_per_corner_px},
          {"mean_px", summary.mean_px},
          {"sigma_px", summary.sigma_px},
          {"worst_corner_px", summary.worst_corner_px},
          {"rms_whitened", summary.rms_whitened}};
}

Json HistogramJson(const ResidualList& residuals, double bin_px) {
  const ResidualHistogram histogram = HistogramOfResiduals(residuals, bin_px);
  std::vector<double> gaussian;
  for (std::size_t i = 0; i < histogram.counts.size(); ++i)
    gaussian.push_back(histogram.Gaussian(histogram.Center_px(i)));
  return {{"bin_px", histogram.bin_px},
          {"first_center_px", histogram.counts.empty() ? 0 : histogram.Center_px(0)},
          {"counts", histogram.counts},
          {"gaussian", gaussian}};
}

Json DirectionsJson(const ResidualList& residuals) {
  const DirectionHistogram directions = DirectionsOf(residuals);
  return {{"from_deg", -180},
          {"counts", directions.counts},
          {"mean_direction_deg", kDegreesPerRadian * directions.mean_direction_rad},
          {"mean_resultant", directions.mean_resultant}};
}

Json RegionalJson(const RegionalMap& map) {
  return {
      {"columns", map.columns},       {"rows", map.rows},           {"first_x_px", map.first_x_px},
      {"first_y_px", map.first_y_px}, {"step_x_px", map.step_x_px}, {"step_y_px", map.step_y_px},
      {"mean_px", map.mean_px},       {"sd_px", map.sd_px},         {"scalars", map.scalars}};
}

Json ViewsJson(const Session& session, const CalibrationRecord& record,
               const ResidualList& residuals) {
  Json views = Json::array();
  for (std::size_t i = 0; i < session.views.size(); ++i) {
    const ResidualList own = OfView(residuals, static_cast<int>(i));
    Json json{{"view", ViewName(record, static_cast<int>(i))}};
    json.update(SummaryJson(Summarise(own)));
    json["regional"] = RegionalJson(RegionalStatistics(own, session.views[i].region));
    views.push_back(std::move(json));
  }
  return views;
}

Json WorstBoardsJson(const Session& session, const CalibrationRecord& record,
                     const ResidualList& residuals) {
  Json worst = Json::array();
  for (const BoardFigures& board : BoardsFromWorst(residuals)) {
    if (worst.size() == kWorstBoards) break;
    worst.push_back({{"image", ImageName(record, board.image)},
                     {"view", ViewName(record, board.view)},
                     {"corners", board.inliers},
                     {"rms_per_corner_px", board.rms_per_corner_px},
                     {"worst_corner_px", board.worst_corner_px},
                     {"worst_column", board.worst_corner % session.target.columns},
                     {"worst_row", board.worst_corner / session.target.columns}});
  }
  return worst;
}

Json ReplayJson(const std::vector<OutlierPass>& passes) {
  Json list = Json::array();
  std::size_t marked = 0;
  for (const OutlierPass& pass : passes) {
    list.push_back({{"sigma_px", pass.sigma_px}, {"marked", pass.marked.size()}});
    marked += pass.marked.size();
  }
  return {{"rule", "any coordinate above 5 sigma: every corner above 4 sigma"},
          {"passes", list},
          {"corners_marked", marked}};
}

Json SpatialJson(const CalibrationRecord& record, const std::vector<SpatialTest>& tests) {
  constexpr std::array kOver{"neighbouring corners", "field", "board"};
  Json list = Json::array();
  for (const SpatialTest& test : tests)
    list.push_back({{"view", ViewName(record, test.view)},
                    {"component", test.component == 0 ? "u" : "v"},
                    {"over", kOver[static_cast<std::size_t>(test.over)]},
                    {"places", test.places},
                    {"morans_i", test.morans_i},
                    {"expected_i", test.expected_i},
                    {"p_value", test.p_value},
                    {"adjusted_p_value", test.adjusted_p_value}});
  return list;
}

Json TrendsJson(const CalibrationRecord& record, const std::vector<TrendTest>& tests) {
  Json list = Json::array();
  for (const TrendTest& test : tests)
    list.push_back({{"view", ViewName(record, test.view)},
                    {"component", test.component == 0 ? "u" : "v"},
                    {"images", test.images},
                    {"change_px", test.change_px},
                    {"sigma_change_px", test.sigma_change_px},
                    {"p_value", test.p_value},
                    {"adjusted_p_value", test.adjusted_p_value}});
  return list;
}

Json TestsJson(const CalibrationRecord& record, const NoiseReport& noise) {
  const ChiSquareTest& chi = noise.chi_square;
  const NormalityTest& normality = noise.normality;
  return {{"chi_square",
           {{"chi2", chi.chi2},
            {"degrees", chi.degrees},
            {"sigma0", chi.sigma0},
            {"p_value", chi.p_value},
            {"p_too_large", chi.p_too_large}}},
          {"normality",
           {{"test", "Anderson-Darling"},
            {"statistic", normality.statistic},
            {"p_value", normality.p_value},
            {"skewness", normality.skewness},
            {"excess_kurtosis", normality.excess_kurtosis}}},
          {"smallest_spatial_p", noise.SmallestSpatialP()},
          {"smallest_trend_p", noise.SmallestTrendP()},
          {"spatial", SpatialJson(record, noise.spatial)},
          {"trends", TrendsJson(record, noise.trends)}};
}

Json FindingsJson(const CalibrationRecord& record, const std::vector<PatternFinding>& findings) {
  Json list = Json::array();
  for (const PatternFinding& finding : findings) {
    Json values = Json::array();
    for (const PatternParameter& value : finding.values)
      values.push_back({{"name", value.name}, {"value", value.value}, {"sigma", value.sigma}});
    list.push_back({{"name", finding.name},
                    {"view", ViewName(record, finding.view)},
                    {"image", ImageName(record, finding.image)},
                    {"text", finding.text},
                    {"remedy", finding.remedy},
                    {"rms_px", finding.rms_px},
                    {"adjusted_p_value", finding.adjusted_p_value},
                    {"values", values},
                    {"alternatives", finding.alternatives}});
  }
  return list;
}

Json VerdictJson(const CalibrationRecord& record, const Diagnosis& diagnosis) {
  const ResidualVerdict& verdict = diagnosis.verdict;
  constexpr std::array kKinds{"noise", "not normal", "pattern"};
  return {{"kind", kKinds[static_cast<std::size_t>(verdict.kind)]},
          {"text", verdict.text},
          {"size", verdict.size_text},
          {"patterns_asked", verdict.patterns_asked},
          {"findings", FindingsJson(record, verdict.findings)},
          {"boards_left_out", FindingsJson(record, diagnosis.left_out)}};
}

Json ResidualsJson(const Session& session, const CalibrationRecord& record,
                   const Diagnosis& diagnosis) {
  const ResidualList& residuals = diagnosis.residuals;
  const ResidualSummary summary = Summarise(residuals);
  Json json = SummaryJson(summary);
  json["expected_rms_px"] = diagnosis.expected_rms_px;
  json["verdict"] = VerdictJson(record, diagnosis);
  json["tests"] = TestsJson(record, diagnosis.verdict.noise);
  json["histogram"] = HistogramJson(residuals, BinFor_px(summary.sigma_px));
  json["histogram_of_mrcal"] = HistogramJson(residuals, kMrcalBin_px);
  json["directions"] = DirectionsJson(residuals);
  json["views"] = ViewsJson(session, record, residuals);
  json["worst_boards"] = WorstBoardsJson(session, record, residuals);
  json["outlier_replay"] = ReplayJson(diagnosis.outlier_replay);
  return json;
}

Json ReprojectionJson(const ReprojectionStatistics& statistics, const std::vector<int>& histogram) {
  return {{"rms_px", statistics.rms_px},
          {"mean_px", statistics.mean_px},
          {"max_px", statistics.max_px},
          {"corners", statistics.corners},
          {"histogram_of_norms", {{"bin_px", kErrorBin_px}, {"counts", histogram}}}};
}

Json ArmJson(const PinholeArm& arm) {
  Json json{{"working_distance_mm", arm.working_distance_mm},
            {"distortion_coefficients", arm.five_coefficients ? 5 : 0},
            {"solver", arm.solver}};
  json.update(ReprojectionJson(arm.reprojection, arm.histogram));
  const bool has_ruler = !arm.ruler_error_um.empty();
  json["ruler_images"] = arm.ruler_error_um.size();
  json["ruler_rmse_um"] = has_ruler ? Json(arm.ruler_rmse_um) : Json(nullptr);
  json["ruler_max_um"] = has_ruler ? Json(arm.ruler_max_um) : Json(nullptr);
  json["converged"] = arm.converged;
  json["starts"] = arm.starts;
  json["wrong_minima"] = arm.wrong_minima;
  return json;
}

Json PinholeJson(const Diagnosis& diagnosis) {
  if (!diagnosis.pinhole) return {{"missing_because", diagnosis.pinhole_missing_because}};
  const PinholeComparison& pinhole = *diagnosis.pinhole;
  Json arms = Json::array();
  for (const PinholeArm& arm : pinhole.arms) arms.push_back(ArmJson(arm));
  const auto good = pinhole.AsGoodFrom_mm();
  return {{"telecentric", ReprojectionJson(pinhole.telecentric, pinhole.telecentric_histogram)},
          {"arms", arms},
          {"as_good_from_mm", good ? Json(*good) : Json(nullptr)}};
}

}  // namespace

nlohmann::ordered_json DiagnosisJson(const Session& session, const CalibrationRecord& record,
                                     const Diagnosis& diagnosis,
                                     const std::map<std::string, std::string>& made_from) {
  return {{"schema", kDiagnosisSchema},
          {"made_from", made_from},
          {"independent_optimum", OptimumJson(diagnosis)},
          {"residuals", ResidualsJson(session, record, diagnosis)},
          {"uncertainty", UncertaintyJson(diagnosis)},
          {"pinhole", PinholeJson(diagnosis)}};
}

}  // namespace telestrain
