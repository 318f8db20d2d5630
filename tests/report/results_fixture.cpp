#include "results_fixture.h"

#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "base/files.h"
#include "fixture_parts.h"

namespace telestrain {
namespace {

Json MakeDocument() {
  return {
      {"number", "AR-2026-0042"},
      {"revision", "1"},
      {"date", "2026-01-31"},
      {"laboratory", "Metrology laboratory, Prüfzentrum Süd"},
      {"customer", "Müller Rohrwerke GmbH, Köln"},
      {"item", "Pipe Ø 8 mm, X6CrNiTi18-10, S/N P-7731, condition as received"},
      {"instrument", "Four-view array TA-4, camera S/N 40211, lens S/N 0998"},
      {"procedure", "TC-CAL-007 revision 3"},
      {"operator", "张伟 (Zhang Wei), Søren Łukasz, Ελένη Παππά"},
      {"environment",
       "(23.1 ± 0.2) °C, 44 % RH; temperature constant within 0.1 K over all "
       "images of one cycle"},
      {"traceability", "Target certificate T-1182, ruler certificate R-0417 (national standard)"}};
}

void AddFiles(Json& inputs) {
  const auto add = [&](const std::string& path, int bytes) {
    inputs["files"].push_back({{"path", path}, {"bytes", bytes}, {"sha256", Sha256Hex(path)}});
  };
  for (const char* name : {"session.toml", "calibration.csv", "ruler.csv", "pipe.csv"})
    add(name, 2210);
  for (int i = 0; i < kTargetImages; ++i) add(Numbered("calibration/target_", i), 3410022 + i);
  for (int i = 0; i < kRulerImages; ++i) add(Numbered("ruler/position_", i), 3310407 + i);
  for (int i = 0; i < kStates; ++i) add(Numbered("pipe/state_", i), 4120553 + i);
}

Json MakeInputs() {
  Json inputs = {
      {"schema", "telestrain.inputs/1"},
      {"program",
       {{"name", "telestrain"},
        {"version", "0.1.0"},
        {"libraries",
         {{"Ceres Solver", "2.1.0"},
          {"Eigen", "3.4.0"},
          {"OpenCV", "4.6.0"},
          {"VTK", "9.1.0"},
          {"libharu", "2.3.0"},
          {"OpenSSL", "3.0"}}}}},
      {"title", "Axial strain of a pipe specimen — four-view telecentric array"},
      {"document", MakeDocument()},
      {"sensor", {{"width_px", 2592}, {"height_px", 1944}, {"pixel_pitch_um", 2.2}}},
      {"lens", {{"magnification", 0.5}, {"depth_of_field_mm", 3.1}}},
      {"target",
       {{"columns", kColumns},
        {"rows", kRows},
        {"square_mm", 0.3},
        {"sigma_square_um", 0.25},
        {"sigma_separation_um", 0.5},
        {"coplanarity_um", 2.0},
        {"boards", Json::array()}}},
      {"ruler", {{"length_mm", 27.6}, {"sigma_length_um", 0.25}}},
      {"pipe", {{"outer_diameter_mm", 8.0}, {"poisson_ratio", 0.31}, {"material", "1.4541"}}},
      {"acceptance",
       {{"reprojection_rms_px", 1.0},
        {"ruler_mpe_um", 10.0},
        {"strain_error_microstrain", 20.0},
        {"coverage_factor", 2.0},
        {"decision_rule", "guarded"}}},
      {"counts",
       {{"calibration_images", kTargetImages},
        {"ruler_images", kRulerImages},
        {"pipe_images", kStates}}},
      {"files", Json::array()}};
  AddFiles(inputs);
  return inputs;
}

Json MakeDetection() {
  Json detection = {{"schema", "telestrain.detection/1"},
                    {"made_from", Json::object()},
                    {"boards", Json::array()},
                    {"crosses", Json::array()}};
  for (int image = 0; image < kTargetImages; ++image)
    for (const char* view : kViews) {
      const bool lost = image == 7 && std::string(view) == "B2";
      detection["boards"].push_back(
          {{"image", Numbered("calibration/target_", image)},
           {"view", view},
           {"found", !lost},
           {"corners", lost ? 0 : kColumns * kRows},
           {"rejected_because", lost ? Json("the board is cut off by the edge of the region: 61 of "
                                            "117 corners found, at least 80 are needed")
                                     : Json(nullptr)}});
    }
  return detection;
}

Json Known(double value, double standard_uncertainty) {
  return {{"value", value},
          {"standard_uncertainty", standard_uncertainty},
          {"degrees_of_freedom", nullptr},
          {"expanded_uncertainty", 2 * standard_uncertainty}};
}

Json MakeAcceptance(const Json& images) {
  Json acceptance = {{"coverage_factor", 2.0},
                     {"images", Json::array()},
                     {"trends", Json::array()},
                     {"bias_um", Known(0.41, 0.38)},
                     {"spread_um", Known(1.72, 0.21)},
                     {"stated_spread_um", 1.66},
                     {"repeatability",
                      {{"sd_um", 1.58},
                       {"degrees_of_freedom", 9},
                       {"method", "no pose was repeated: scatter about the mean"}}},
                     {"printed_count", "11 values of one length; 24 more are wanted."},
                     {"not_in_budget", {"The target's pitch is not in the budget."}}};
  double place = -1.3;
  for (const Json& image : images)
    if (image.contains("error_um"))
      acceptance["images"].push_back({{"image", image["image"]},
                                      {"middle_in_array_mm", {place += 0.2, 0.31, -0.12}},
                                      {"depth_mm", 0.4 * place},
                                      {"yaw_deg", 0.21},
                                      {"pitch_deg", -0.35}});
  for (const char* on : {"x", "depth", "x²"})
    acceptance["trends"].push_back({{"on", on},
                                    {"unit", "µm/mm"},
                                    {"slope", Known(0.21, 0.34)},
                                    {"range", 2.2},
                                    {"effect_um", Known(0.46, 0.75)},
                                    {"significant", false}});
  return acceptance;
}

Json MakeRuler() {
  Noise noise;
  Json json = {{"schema", "telestrain.ruler/1"},
               {"made_from", Json::object()},
               {"nominal_length_mm", 27.6},
               {"images", Json::array()}};
  double sum = 0, square_sum = 0, largest = 0;
  for (int i = 0; i + 1 < kRulerImages; ++i) {
    const double error_um = 0.4 + 1.7 * noise.Gauss();
    sum += error_um;
    square_sum += error_um * error_um;
    largest = std::max(largest, std::abs(error_um));
    json["images"].push_back({{"image", Numbered("ruler/position_", i)},
                              {"length_mm", 27.6 + error_um / 1000},
                              {"error_um", error_um},
                              {"standard_uncertainty_um", 0.81 + 0.02 * i}});
  }
  json["images"].push_back({{"image", Numbered("ruler/position_", kRulerImages - 1)},
                            {"rejected_because", "view B2: no cross found"}});
  const double count = kRulerImages - 1, mean = sum / count;
  json["summary"] = {{"count", kRulerImages - 1},
                     {"mean_error_um", mean},
                     {"sd_error_um", std::sqrt((square_sum - count * mean * mean) / (count - 1))},
                     {"max_abs_error_um", largest}};
  json["budget"] = Json::array();
  json["budget"].push_back({{"source", "magnification"}, {"standard_uncertainty_um", 0.743}});
  json["budget"].push_back({{"source", "cross detection"}, {"standard_uncertainty_um", 0.214}});
  json["budget"].push_back({{"source", "ruler certificate"}, {"standard_uncertainty_um", 0.25}});
  json["acceptance"] = MakeAcceptance(json["images"]);
  return json;
}

Json MakeClass(const char* standard, const char* name, const char* unit) {
  return {{"standard", standard},
          {"class", name},
          {"class_with_uncertainty", nullptr},
          {"unit", unit},
          {"count", kStates - 1},
          {"range", 24.9},
          {"worst_image", "pipe/state_03.png"},
          {"worst_error", 0.21},
          {"worst_limit", 0.6},
          {"resolution", 0.08},
          {"resolution_limit", 0.2},
          {"not_covered", {"The reference is the strain gauges on the pipe."}}};
}

Json MakeSequence() {
  const Json regression = {{"count", kStates - 1},
                           {"slope", Known(1.00217, 0.0031)},
                           {"intercept_microstrain", Known(-1.12, 2.4)},
                           {"bias_microstrain", Known(-0.87, 1.9)},
                           {"residual_rms_microstrain", 4.1}};
  const Json floor = {{"count", 3},
                      {"mean_microstrain", Known(0.12, 0.31)},
                      {"sd_microstrain", 0.27},
                      {"max_abs_microstrain", 0.4},
                      {"stated_sd_microstrain", 0.25}};
  Json cycles = Json::array();
  cycles.push_back({{"cycle", "1"},
                    {"regression", regression},
                    {"hysteresis", {{"largest_microstrain", Known(2.1, 3.7)}}},
                    {"zero_microstrain", nullptr}});
  return {{"regression", regression},
          {"cycles", cycles},
          {"drift_microstrain_per_hour", Known(0.44, 0.61)},
          {"largest_change_between_cycles_microstrain", Known(0.7, 0.9)},
          {"repeatability", {{"sd_microstrain", 3.3}}},
          {"noise_floor_still", nullptr},
          {"noise_floor_moved", floor},
          {"warm_up", {{"printed", "No drift is resolved."}, {"time_constant_s", nullptr}}},
          {"iso9513", MakeClass("ISO 9513:2012, Table 2", "0.2", "µm")},
          {"astm_e83", MakeClass("ASTM E83, Table 1", "A", "µε")}};
}

void AddComparison(Json& json) {
  json["comparison"] = {{"count", kStates - 1},
                        {"rms_error_microstrain", 4.31},
                        {"standard_uncertainty_microstrain", 4.52},
                        {"mean_error_microstrain", -0.87},
                        {"max_abs_error_microstrain", 7.6},
                        {"slope", 1.00213},
                        {"intercept_microstrain", -1.14}};
  json["budget"] = Json::array();
  json["budget"].push_back(
      {{"source", "correlation noise"}, {"standard_uncertainty_microstrain", 3.91}});
  json["budget"].push_back(
      {{"source", "magnification"}, {"standard_uncertainty_microstrain", 0.031}});
}

Json MakeStrain() {
  Noise noise;
  Json json = {{"schema", "telestrain.strain/1"},
               {"made_from", Json::object()},
               {"pipe",
                {{"axis_point_in_array_mm", {0.0, 0.02, 4.01}},
                 {"axis_in_array", {1.0, 0.0, 0.0}},
                 {"radius_mm", 4.00133},
                 {"diameter_mm", 8.00266},
                 {"sigma_diameter_mm", 0.00113},
                 {"points", 1864},
                 {"rejected", {{"no partner in the second view", 17}}}}},
               {"options",
                {{"subset_px", 31},
                 {"step_px", 12},
                 {"shape_function", "affine"},
                 {"interpolant", "quintic B-spline"},
                 {"criterion", "ZNSSD"},
                 {"prefilter_sigma_px", 0.6},
                 {"virtual_strain_gauge_mm", 1.32}}},
               {"base_length_mm", 27.7014},
               {"states", Json::array()}};
  for (int i = 0; i < kStates; ++i) {
    const double load = i == 0 ? 0 : 300.0 * (i < 4 ? i : 7 - i);
    const double axial = i == 0 ? 0 : load + 4 * noise.Gauss();
    json["states"].push_back({{"image", Numbered("pipe/state_", i)},
                              {"cycle", "1"},
                              {"step", std::to_string(i)},
                              {"axial_microstrain", axial},
                              {"standard_uncertainty_microstrain", i == 0 ? 0.0 : 4.2 + 0.1 * i},
                              {"local_a_microstrain", axial + 20 * noise.Gauss()},
                              {"local_b_microstrain", axial + 20 * noise.Gauss()},
                              {"local_sigma_microstrain", 35.0},
                              {"gauge_mean_microstrain", load + kGaugesAtReference_microstrain},
                              {"gauge_change_microstrain", load},
                              {"points_used", 1851 - i},
                              {"points_rejected", {{"ZNCC below 0.8", 9 + i}, {"epipolar", 4}}},
                              {"file", Numbered("pipe_0", i)}});
  }
  AddComparison(json);
  json["sequence"] = MakeSequence();
  json["gauge_outliers"] = Json::array();
  json["gauge_outliers"].push_back({{"column", "gauge_3_microstrain"},
                                    {"image", "pipe/state_02.png"},
                                    {"deviation_microstrain", 14.8},
                                    {"standard_uncertainty_microstrain", 1.7}});
  return json;
}

void WriteText(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace

ResultsFixture PlausibleResults() {
  ResultsFixture fixture;
  fixture.inputs = MakeInputs();
  fixture.detection = MakeDetection();
  fixture.calibration = MakeCalibration(fixture.residuals_csv);
  fixture.diagnosis = MakeDiagnosis();
  fixture.ruler = MakeRuler();
  fixture.strain = MakeStrain();
  return fixture;
}

void WriteResults(const ResultsFixture& fixture, const std::filesystem::path& folder) {
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, const Json& json) {
    if (!json.is_null()) WriteText(folder / name, json.dump(2) + "\n");
  };
  write("inputs.json", fixture.inputs);
  write("detection.json", fixture.detection);
  write("calibration.json", fixture.calibration);
  write("mrcal.json", fixture.diagnosis);
  write("ruler.json", fixture.ruler);
  write("strain.json", fixture.strain);
  if (!fixture.calibration.is_null()) WriteText(folder / "residuals.csv", fixture.residuals_csv);
  if (!fixture.pictures) return;
  WritePicture(folder / "pictures" / "array.png", 2008, 400);
  WritePicture(folder / "pictures" / "targets.png", 502, 200);
  WritePicture(folder / "pictures" / "pipe_strain.png", 502, 200);
}

void WritePicture(const std::filesystem::path& path, int width_px, int height_px) {
  std::filesystem::create_directories(path.parent_path());
  std::vector<unsigned char> pixels(static_cast<std::size_t>(width_px) * height_px * 3, 255);
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < width_px; ++u) {
      const double height = (v - height_px / 2.0) / (0.3 * height_px);
      if (std::abs(height) > 1) continue;
      const double shade = 0.35 + 0.65 * std::sqrt(1 - height * height);
      const double strain = 0.5 + 0.5 * std::sin(6.0 * u / width_px);
      unsigned char* rgb = &pixels[(static_cast<std::size_t>(v) * width_px + u) * 3];
      rgb[0] = static_cast<unsigned char>(shade * (40 + 200 * strain));
      rgb[1] = static_cast<unsigned char>(shade * (60 + 120 * strain));
      rgb[2] = static_cast<unsigned char>(shade * (160 - 100 * strain));
    }
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(width_px);
  png.height = static_cast<png_uint_32>(height_px);
  png.format = PNG_FORMAT_RGB;
  if (!png_image_write_to_file(&png, path.c_str(), 0, pixels.data(), 0, nullptr))
    throw std::runtime_error(path.string() + ": " + png.message);
}

std::filesystem::path TestFolder(const std::string& name) {
  // Removed when the test program ends.
  struct Root {
    std::filesystem::path path = std::filesystem::temp_directory_path();
    Root() {
      std::string folder = "telestrain_report_";
      folder += std::to_string(::getpid());
      path /= folder;
    }
    ~Root() {
      std::error_code code;
      std::filesystem::remove_all(path, code);
    }
  };
  static const Root root;
  return root.path / name;
}

}  // namespace telestrain
