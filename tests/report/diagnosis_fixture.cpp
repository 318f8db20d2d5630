#include <cmath>
#include <vector>

#include "fixture_parts.h"

namespace telestrain {
namespace {

constexpr double kSigma_px = 0.044;

Json MakeOptimum() {
  return {{"max_residual_difference_px", 2.04e-10},
          {"max_magnification_difference", 1.05e-13},
          {"max_rotation_difference_rad", 6.56e-12},
          {"evaluated_max_residual_difference_px", 4.96e-10},
          {"agrees", true},
          {"limits",
           {{"residual_difference_px", 1e-6},
            {"magnification_difference", 1e-8},
            {"rotation_difference_rad", 1e-8}}},
          {"model", "undistorted, a magnification per view, from the closed-form start"},
          {"evaluated", "the calibration's own solution"},
          {"mrcal_converged", true},
          {"rms_px", 0.04427717},
          {"mrcal_rms_px", 0.04427718},
          {"images", kTargetImages},
          {"images_left_out", 0},
          {"telecentricity_left_out_per_mm", 1.3e-6}};
}

Json MakeHistogram() {
  const double bin_px = 0.01, first_px = -0.19;
  std::vector<int> counts;
  std::vector<double> gaussian;
  for (int i = 0; i < 39; ++i) {
    const double t = (first_px + bin_px * i) / kSigma_px;
    gaussian.push_back(22230 * bin_px / (kSigma_px * 2.5066) * std::exp(-0.5 * t * t));
    counts.push_back(static_cast<int>(gaussian.back() + 0.5));
  }
  return {{"bin_px", bin_px},
          {"first_center_px", first_px},
          {"counts", counts},
          {"gaussian", gaussian}};
}

// Zeros with few scalars in the outer ring, as where no board reached.
Json MakeRegional(Noise& noise, int view) {
  constexpr int kMapColumns = 20, kMapRows = 15;
  std::vector<double> mean_px, sd_px;
  std::vector<int> scalars;
  for (int i = 0; i < kMapColumns * kMapRows; ++i) {
    const int column = i % kMapColumns, row = i / kMapColumns;
    const bool inside = column > 1 && column < kMapColumns - 2 && row > 0 && row < kMapRows - 1;
    scalars.push_back(inside ? 24 : 4);
    mean_px.push_back(inside ? kSigma_px / 5 * noise.Gauss() : 0);
    sd_px.push_back(inside ? kSigma_px * (1 + 0.1 * noise.Gauss()) : 0);
  }
  return {{"columns", kMapColumns},
          {"rows", kMapRows},
          {"first_x_px", 1296 * (view % 2)},
          {"first_y_px", 972 * (view / 2)},
          {"step_x_px", 1295.0 / (kMapColumns - 1)},
          {"step_y_px", 971.0 / (kMapRows - 1)},
          {"mean_px", mean_px},
          {"sd_px", sd_px},
          {"scalars", scalars}};
}

Json MakeTests() {
  Json spatial = Json::array(), trends = Json::array();
  for (int i = 0; i < 4; ++i) {
    spatial.push_back({{"view", kViews[i]},
                       {"component", "u"},
                       {"over", "field"},
                       {"places", 224},
                       {"morans_i", 0.031 + 0.01 * i},
                       {"expected_i", -0.0045},
                       {"p_value", 0.08 / (1 + i)},
                       {"adjusted_p_value", 0.32 / (1 + i)}});
    trends.push_back({{"view", kViews[i]},
                      {"component", "v"},
                      {"images", kTargetImages},
                      {"change_px", 0.0011 - 0.0009 * i},
                      {"sigma_change_px", 0.0012},
                      {"p_value", 0.4 + 0.1 * i},
                      {"adjusted_p_value", 1.0}});
  }
  return {{"chi_square",
           {{"chi2", 22103.0},
            {"degrees", 21894},
            {"sigma0", 1.0047},
            {"p_value", 0.317},
            {"p_too_large", 0.158}}},
          {"normality",
           {{"test", "Anderson-Darling"},
            {"statistic", 0.412},
            {"p_value", 0.34},
            {"skewness", 0.012},
            {"excess_kurtosis", 0.021}}},
          {"smallest_spatial_p", 0.08},
          {"smallest_trend_p", 1.0},
          {"spatial", spatial},
          {"trends", trends}};
}

Json MakeSummary(double corners) {
  return {
      {"corners", corners},   {"rms_px", kSigma_px},   {"rms_per_corner_px", 1.4142 * kSigma_px},
      {"mean_px", -1.3e-5},   {"sigma_px", kSigma_px}, {"worst_corner_px", 0.187},
      {"rms_whitened", 1.003}};
}

Json MakeBoards(Noise& noise) {
  Json boards = Json::array();
  for (int i = 0; i < 20; ++i)
    boards.push_back({{"image", Numbered("calibration/target_", i)},
                      {"view", kViews[i % 4]},
                      {"corners", 117},
                      {"rms_per_corner_px", 0.0742 - 0.0007 * i},
                      {"worst_corner_px", 0.15 + 0.02 * noise.Uniform()},
                      {"worst_column", i % kColumns},
                      {"worst_row", i % kRows}});
  return boards;
}

Json MakeResiduals() {
  Noise noise;
  Json json = MakeSummary(11115);
  json["expected_rms_px"] = 0.0438;
  json["verdict"] = {{"kind", "noise"},
                     {"text", "The residuals are noise."},
                     {"size", "They are as large as the corners' stated noise."},
                     {"patterns_asked", 93},
                     {"findings", Json::array()},
                     {"boards_left_out", Json::array()}};
  json["tests"] = MakeTests();
  json["histogram"] = MakeHistogram();
  std::vector<int> directions;
  for (int i = 0; i < 36; ++i) directions.push_back(309 + static_cast<int>(17 * noise.Gauss()));
  json["directions"] = {{"from_deg", -180},
                        {"counts", directions},
                        {"mean_direction_deg", 136.4},
                        {"mean_resultant", 0.00654}};
  json["views"] = Json::array();
  for (int i = 0; i < 4; ++i) {
    Json view{{"view", kViews[i]}};
    view.update(MakeSummary(2808 - (i == 3 ? 117 : 0)));
    view["regional"] = MakeRegional(noise, i);
    json["views"].push_back(view);
  }
  json["worst_boards"] = MakeBoards(noise);
  json["outlier_replay"] = {
      {"passes", {{{"sigma_px", 0.0441}, {"marked", 2}}, {{"sigma_px", 0.044}, {"marked", 0}}}},
      {"corners_marked", 2}};
  return json;
}

Json MakeArm(double distance_mm, int coefficients, double rms_px, double rmse_um) {
  return {{"working_distance_mm", distance_mm},
          {"distortion_coefficients", coefficients},
          {"solver", coefficients > 0 ? "telestrain" : "mrcal"},
          {"rms_px", rms_px},
          {"mean_px", 1.25 * rms_px},
          {"max_px", 4.1 * rms_px},
          {"corners", 11115},
          {"ruler_images", kRulerImages},
          {"ruler_rmse_um", rmse_um},
          {"ruler_max_um", 1.8 * rmse_um},
          {"converged", true},
          {"starts", distance_mm == 1000 ? 3 : 0},
          {"wrong_minima", distance_mm == 1000 ? 1 : 0}};
}

// Grows from the middle of the field outwards, as a map does.
Json MakeUncertainty() {
  constexpr int kColumns = 6, kRows = 5;
  Json maps = Json::array();
  for (const char* view : {"U1", "U2"}) {
    std::vector<double> sigma_um;
    for (int i = 0; i < kColumns * kRows; ++i)
      sigma_um.push_back(0.01 + 0.002 * std::hypot(i % kColumns - 2.5, i / kColumns - 2.0));
    maps.push_back({{"view", view},
                    {"columns", kColumns},
                    {"rows", kRows},
                    {"step_x_px", 259.0},
                    {"step_y_px", 242.75},
                    {"sigma_um", sigma_um},
                    {"sigma_of_noise_um", sigma_um}});
  }
  const auto share = [](double noise, double everything) {
    return Json{{"of_noise", noise}, {"of_everything", everything}};
  };
  return {{"maps", maps},
          {"means_for",
           {{"length_um", share(0.00312, 0.251)},
            {"shift_microstrain", share(0.0161, 0.133)},
            {"turn_microstrain", share(0.00523, 0.114)},
            {"true_strain_microstrain", share(0.00124, 0.0172)}}}};
}

}  // namespace

Json MakeDiagnosis() {
  return {
      {"schema", "telestrain.mrcal/1"},
      {"independent_optimum", MakeOptimum()},
      {"residuals", MakeResiduals()},
      {"uncertainty", MakeUncertainty()},
      {"pinhole",
       {{"telecentric", {{"rms_px", 0.0437}, {"mean_px", 0.0546}, {"max_px", 0.187}}},
        {"arms",
         {MakeArm(100, 0, 1.33, 21.7), MakeArm(1000, 0, 0.142, 5.91), MakeArm(1e4, 0, 0.0491, 3.17),
          MakeArm(1e5, 0, 0.0476, 3.02), MakeArm(100, 5, 1.29, 19.3), MakeArm(1000, 5, 0.139, 4.83),
          MakeArm(1e5, 5, 0.0471, 2.89)}},
        {"as_good_from_mm", nullptr}}}};
}

}  // namespace telestrain
