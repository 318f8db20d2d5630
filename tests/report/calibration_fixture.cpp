#include <cmath>

#include "base/numbers.h"
#include "fixture_parts.h"

namespace telestrain {
namespace {

Json MakeViews() {
  Json views = Json::array();
  const double tilt = 0.5;
  for (int i = 0; i < 4; ++i) {
    const double side = i % 2 == 0 ? -1 : 1;
    views.push_back({{"name", kViews[i]},
                     {"group", std::string(1, kViews[i][0])},
                     {"region_px", {1296 * (i % 2), 972 * (i / 2), 1296, 972}},
                     {"image_x_in_array", {-1.0, 0.0, 0.0}},
                     {"image_y_in_array", {0.0, std::cos(tilt), -side * std::sin(tilt)}},
                     {"axis_in_array", {0.0013 * i, side * std::sin(tilt), std::cos(tilt)}},
                     {"offset_px", {647.3 + 1296 * (i % 2), 485.9 + 972 * (i / 2)}},
                     {"center_in_array_mm", {i < 2 ? -13.85 : 13.85, 0.01 * i, -0.02}},
                     {"depth_of_field_mm", 3.1},
                     {"seed_magnification_px_per_mm", 227.1},
                     {"rms_px", 0.041 + 0.002 * i},
                     {"mean_px", 0.051 + 0.002 * i},
                     {"corners", kTargetImages * kColumns * kRows - (i == 3 ? 117 : 0)},
                     {"magnification_eq6_px_per_mm", {227.28 + 0.01 * i, 227.31 - 0.01 * i}}});
  }
  return views;
}

Json MakePoses(Noise& noise) {
  Json poses = Json::array();
  for (int image = 0; image < kTargetImages; ++image) {
    Json boards = Json::array();
    for (const char* view : kViews)
      if (image != 7 || std::string(view) != "B2")
        boards.push_back({{"view", view},
                          {"rms_px", 0.043 + 0.004 * noise.Gauss()},
                          {"max_px", 0.15 + 0.02 * noise.Uniform()},
                          {"corners", 117}});
    poses.push_back(
        {{"image", Numbered("calibration/target_", image)},
         {"pose", Numbered("p", image / 2).substr(0, 3)},
         {"stage_mm", image % 2 == 0 ? 0.0 : 0.5},
         {"rotation_array_from_target", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
         {"origin_in_array_mm", {0.1 * noise.Gauss(), 0.1 * noise.Gauss(), 0.5 * noise.Gauss()}},
         {"boards", boards}});
  }
  return poses;
}

// Fills residuals.csv and the histogram with the same residuals.
Json MakeReprojection(Noise& noise, std::string& csv) {
  const double bin_px = 0.01, from_px = -0.2;
  std::vector<int> counts(40, 0);
  const auto count = [&](double residual_px) {
    const auto bin = static_cast<int>((residual_px - from_px) / bin_px);
    if (bin >= 0 && bin < 40) ++counts[static_cast<std::size_t>(bin)];
  };
  csv = "image,view,column,row,u_px,v_px,du_px,dv_px\n";
  for (int image = 0; image < kTargetImages; ++image)
    for (int view = 0; view < 4; ++view)
      for (int corner = 0; corner < kColumns * kRows; ++corner) {
        const int column = corner % kColumns, row = corner / kColumns;
        const double u = 1296 * (view % 2) + 238 + 68 * column + 30 * (image % 3),
                     v = 972 * (view / 2) + 180 + 68 * row + 20 * (image % 5);
        const double du = 0.044 * noise.Gauss(), dv = 0.044 * noise.Gauss();
        count(du);
        count(dv);
        csv += Numbered("calibration/target_", image) + "," + kViews[view] + "," +
               std::to_string(column) + "," + std::to_string(row) + "," + FormatFixed(u, 3) + "," +
               FormatFixed(v, 3) + "," + FormatFixed(du, 5) + "," + FormatFixed(dv, 5) + "\n";
      }
  return {{"rms_px", 0.0437},
          {"mean_px", 0.0541},
          {"max_px", 0.1712},
          {"expected_rms_px", 0.0411},
          {"corners_used", 11115},
          {"corners_rejected", 12},
          {"boards_used", 95},
          {"boards_rejected", 1},
          {"histogram", {{"bin_px", bin_px}, {"from_px", from_px}, {"counts", counts}}}};
}

void AddModels(Json& json) {
  json["rejected"].push_back({{"image", "calibration/target_11.png"},
                              {"view", "A1"},
                              {"reason", "12 corners farther than 4 sigma from the model"},
                              {"corners", 12},
                              {"whole_board", false}});
  // The calibration repeats what the detector did not find.
  json["rejected"].push_back({{"image", "calibration/target_07.png"},
                              {"view", "B2"},
                              {"reason", "the board is cut off by the edge of the region"},
                              {"corners", 0},
                              {"whole_board", true}});
  json["model_tests"] = Json::array();
  json["model_tests"].push_back({{"added", "start"},
                                 {"model", "none"},
                                 {"parameters", 0},
                                 {"chi2", 31877.2},
                                 {"f_statistic", nullptr},
                                 {"p_value", nullptr},
                                 {"accepted", nullptr}});
  json["model_tests"].push_back({{"added", "k1"},
                                 {"model", "k1"},
                                 {"parameters", 1},
                                 {"chi2", 22114.9},
                                 {"f_statistic", 9812.4},
                                 {"p_value", 1.2e-300},
                                 {"accepted", true}});
  json["model_tests"].push_back({{"added", "k2"},
                                 {"model", "k1 k2"},
                                 {"parameters", 2},
                                 {"chi2", 22113.6},
                                 {"f_statistic", 1.31},
                                 {"p_value", 0.252},
                                 {"accepted", false}});
  json["gauge"] = {"the array frame is fixed by the mean of the nominal view axes",
                   "the origin is the mean of the views' centres"};
}

}  // namespace

Json MakeCalibration(std::string& residuals_csv) {
  Noise noise;
  Json json = {{"schema", "telestrain.calibration/1"},
               {"made_from", Json::object()},
               {"sensor", {{"width_px", 2592}, {"height_px", 1944}}},
               {"lens",
                {{"magnification_px_per_mm", 227.2871436},
                 {"sigma_magnification_px_per_mm", 0.00612},
                 {"center_px", {1301.4, 968.2}},
                 {"distortion",
                  {{"k1_per_mm2", -3.1274e-5},
                   {"k2_per_mm4", 0.0},
                   {"p1_per_mm", 0.0},
                   {"p2_per_mm", 0.0},
                   {"k3_per_mm6", 0.0}}},
                 {"model", "k1"},
                 {"object_side_um_per_px", 4.39971}}},
               {"views", MakeViews()},
               {"poses", MakePoses(noise)},
               {"rejected", Json::array()},
               {"reprojection", MakeReprojection(noise, residuals_csv)},
               {"stage_decision",
                {{"pairs", 12},
                 {"agreeing", 12},
                 {"margin_px", 3.218},
                 {"twin_cost_ratio", 41.7},
                 {"nominal_agrees", true}}}};
  AddModels(json);
  return json;
}

}  // namespace telestrain
