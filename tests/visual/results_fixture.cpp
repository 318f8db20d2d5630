#include "visual/results_fixture.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "base/files.h"
#include "base/json_file.h"
#include "base/numbers.h"

namespace telestrain::visual_test {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kPxPerMm = 227.2727;
constexpr double kGroupX_mm = 13.851;
constexpr int kStates = 3;

void Require(const Status& status) {
  if (!status) throw std::runtime_error(status.error().message);
}

Json List(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

double GroupSign(int view) { return view < 2 ? -1 : 1; }
std::string GaugeColumn(int gauge) { return "gauge_" + std::to_string(gauge + 1) + "_microstrain"; }
const char* ViewName(int view) {
  static constexpr const char* kNames[] = {"A1", "A2", "B1", "B2"};
  return kNames[view];
}

Json Gauges() {
  Json gauges = Json::array();
  for (int i = 0; i < kGauges; ++i)
    gauges.push_back({{"column", GaugeColumn(i)},
                      {"axial_mm", kGaugeAxial_mm[i]},
                      {"angle_rad", kGaugeAngle_rad[i]},
                      {"length_mm", 3.0}});
  return gauges;
}

Json Inputs() {
  Json boards = Json::array();
  for (const auto& [group, sign] : {std::pair{"A", -1.0}, std::pair{"B", 1.0}})
    boards.push_back({{"group", group},
                      {"center_in_target_mm", {sign * kGroupX_mm, 0, 0}},
                      {"rotation_deg", 0.0}});
  return {{"schema", "telestrain.inputs/1"},
          {"title", "Made-up run"},
          {"sensor", {{"width_px", 2592}, {"height_px", 1944}, {"pixel_pitch_um", 2.2}}},
          {"lens", {{"magnification", 0.5}, {"depth_of_field_mm", 3.1}}},
          {"target", {{"columns", 13}, {"rows", 9}, {"square_mm", 0.3}, {"boards", boards}}},
          {"pipe", {{"outer_diameter_mm", 8.0}, {"gauges", Gauges()}}},
          {"acceptance", {{"ruler_mpe_um", 3.0}, {"coverage_factor", 2.0}}}};
}

// Section 13: the last mirrors send the axes to (0, -+0.5, -0.866).
Json Views() {
  Json views = Json::array();
  for (int i = 0; i < 4; ++i) {
    const double side = i % 2 == 0 ? -1 : 1, half = 0.5, root = std::sqrt(0.75);
    views.push_back({{"name", ViewName(i)},
                     {"group", i < 2 ? "A" : "B"},
                     {"region_px", {i < 2 ? 0 : 1296, i % 2 == 0 ? 0 : 972, 1296, 972}},
                     {"image_x_in_array", {1.0, 0.0, 0.0}},
                     {"image_y_in_array", {0.0, root, -side * half}},
                     {"axis_in_array", {0.0, -side * half, -root}},
                     {"center_in_array_mm", {GroupSign(i) * kGroupX_mm, 0.0, 0.0}},
                     {"depth_of_field_mm", 3.1},
                     {"rms_px", 0.09 + 0.01 * i}});
  }
  return views;
}

// Some covariance of six parameters, the 1e-6 rad and mm of a good calibration: L L^T.
Json PoseCovariance(int index) {
  Eigen::Matrix<double, 6, 6> lower = Eigen::Matrix<double, 6, 6>::Zero();
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k <= i; ++k) lower(i, k) = 1e-6 * std::cos(3.0 * i + 7.0 * k + index);
  const Eigen::Matrix<double, 6, 6> covariance = lower * lower.transpose();
  Json rows = Json::array();
  for (int i = 0; i < 6; ++i) {
    rows.push_back(Json::array());
    for (int k = 0; k < 6; ++k) rows.back().push_back(covariance(i, k));
  }
  return rows;
}

Json Pose(int index) {
  const double turn = 2.4 * index;  // spreads the tilts over all directions
  const Eigen::Vector3d tilt_rad =
      0.05 * Eigen::Vector3d(std::cos(turn), 0.25 * std::sin(turn), 0.3 * std::sin(1.7 * turn));
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(tilt_rad.norm(), tilt_rad.normalized()).toRotationMatrix();
  const double stage_mm = index % 2 == 0 ? -0.5 : 0.5;
  Json flat = Json::array(), boards = Json::array();
  for (int i = 0; i < 9; ++i) flat.push_back(rotation(i / 3, i % 3));
  for (int view = 0; view < 4; ++view) {
    if (index == 7 && view == 3) continue;  // rejected below
    const double rms_px = 0.08 + 0.012 * index * (1 + 0.1 * view);
    boards.push_back(
        {{"view", ViewName(view)}, {"rms_px", rms_px}, {"max_px", 3 * rms_px}, {"corners", 117}});
  }
  const Eigen::Vector3d origin_mm(0.2 * std::sin(3.0 * index), 0.2 * std::cos(5.0 * index),
                                  stage_mm);
  return {{"image", "calibration/" + std::to_string(index) + ".png"},
          {"pose", "p" + std::to_string(index / 2)},
          {"stage_mm", stage_mm},
          {"rotation_array_from_target", flat},
          {"origin_in_array_mm", List(origin_mm)},
          {"covariance", PoseCovariance(index)},
          {"boards", boards}};
}

Json Calibration() {
  Json poses = Json::array();
  for (int i = 0; i < 12; ++i) poses.push_back(Pose(i));
  return {{"schema", "telestrain.calibration/1"},
          {"lens", {{"magnification_px_per_mm", kPxPerMm}}},
          {"views", Views()},
          {"poses", poses},
          {"rejected",
           {{{"image", "calibration/7.png"},
             {"view", "B2"},
             {"reason", "9 corners missing"},
             {"corners", 108},
             {"whole_board", true}},
            {{"image", "calibration/8.png"},
             {"view", "A1"},
             {"reason", "outlier"},
             {"corners", 1},
             {"whole_board", false}}}},
          {"pose_covariance_parameters",
           {"rotation_x_rad", "rotation_y_rad", "rotation_z_rad", "origin_x_mm", "origin_y_mm",
            "origin_z_mm"}},
          {"reprojection", {{"rms_px", 0.1034}}}};
}

Json Ruler() {
  Json images = Json::array(), decisions = Json::array();
  for (int i = 0; i < 17; ++i) {
    const double y_mm = -0.8 + 0.1 * i, z_mm = 0.7 * std::sin(1.3 * i);
    const Eigen::Vector3d half(13.8, 0.12 * std::cos(2.0 * i), 0.1 * std::sin(4.0 * i));
    const Eigen::Vector3d middle(0.3 * std::sin(2.0 * i), y_mm, z_mm);
    images.push_back({{"image", "ruler/" + std::to_string(i) + ".png"},
                      {"length_mm", 2 * half.norm()},
                      {"error_um", 0.25 * (i - 8)},
                      {"ends_in_array_mm", {List(middle - half), List(middle + half)}}});
    decisions.push_back({{"image", "ruler/" + std::to_string(i) + ".png"},
                         {"expanded_uncertainty_um", i == 3 ? 2.5 : 1.0},
                         {"verdict", i == 4 ? Json(nullptr) : Json(i == 3 ? "doubt" : "pass")}});
  }
  images.push_back({{"image", "ruler/17.png"}, {"rejected_because", "cross not found in A2"}});
  return {{"schema", "telestrain.ruler/1"},
          {"nominal_length_mm", 27.6},
          {"images", images},
          {"acceptance", {{"images", decisions}}}};
}

// The last gauge reads under load only.
Json GaugeReadings(double load) {
  Json readings = Json::array();
  for (int i = 0; i < kGauges; ++i) {
    const bool is_read = i + 1 < kGauges || load > 0;
    readings.push_back({{"column", GaugeColumn(i)},
                        {"microstrain", is_read ? Json(800 * load + i) : Json(nullptr)}});
  }
  return readings;
}

Json Strain() {
  Json states = Json::array();
  for (int i = 0; i < kStates; ++i) {
    const double load = i == 0 ? 0 : (i == 1 ? 1.0 : 0.5);
    states.push_back({{"image", "pipe/" + std::to_string(i) + ".png"},
                      {"cycle", i == 0 ? "0" : "1"},
                      {"step", std::to_string(i)},
                      {"axial_microstrain", 812.4 * load},
                      {"standard_uncertainty_microstrain", 11.3},
                      {"local_a_microstrain", 824.0 * load},
                      {"local_b_microstrain", 803.0 * load},
                      {"gauge_readings", GaugeReadings(load)},
                      {"gauge_mean_microstrain", 810 * load},
                      {"file", "pipe_00" + std::to_string(i) + ".vtp"}});
  }
  return {
      {"schema", "telestrain.strain/1"},
      {"pipe",
       {{"axis_point_in_array_mm", {0.0, 0.0, kPipeAxisZ_mm}},
        {"axis_in_array", {1.0, 0.0, 0.0}},
        {"radius_mm", kPipeRadius_mm}}},
      {"geometry", {{"angle_0_in_array", {0.0, 0.0, 1.0}}, {"angle_90_in_array", {0.0, 1.0, 0.0}}}},
      {"base_length_mm", 27.702},
      {"states", states}};
}

// Both patches as grids of quads.
struct Grid {
  static constexpr int kColumns = 54, kRows = 44;
  std::string points, displacements, strains, zeros, sigmas, groups, connectivity, offsets;
  int count = 0, quads = 0;
};

void AddPatch(int group, double load, Grid* grid) {
  const int first = grid->count;
  for (int row = 0; row < Grid::kRows; ++row)
    for (int column = 0; column < Grid::kColumns; ++column) {
      const double x_mm = (group == 0 ? -1 : 1) * kGroupX_mm + 5.4 * (column / 53.0 - 0.5);
      const double y_mm = 4.0 * (row / 43.0 - 0.5);
      const double z_mm = kPipeAxisZ_mm + std::sqrt(kPipeRadius_mm * kPipeRadius_mm - y_mm * y_mm);
      const double strain = load * PipeStrain_microstrain(x_mm, y_mm);
      grid->points +=
          FormatShortest(x_mm) + " " + FormatShortest(y_mm) + " " + FormatShortest(z_mm) + "\n";
      grid->displacements += FormatShortest(1e-6 * strain * x_mm) + " 0 0\n";
      grid->strains += FormatShortest(strain) + "\n";
      grid->zeros += "0\n";
      grid->sigmas += "0.75\n";
      grid->groups += std::to_string(group) + "\n";
      ++grid->count;
    }
  for (int row = 0; row + 1 < Grid::kRows; ++row)
    for (int column = 0; column + 1 < Grid::kColumns; ++column) {
      const int corner = first + row * Grid::kColumns + column;
      for (const int id :
           {corner, corner + 1, corner + 1 + Grid::kColumns, corner + Grid::kColumns})
        grid->connectivity += std::to_string(id) + " ";
      grid->offsets += std::to_string(4 * ++grid->quads) + " ";
    }
}

std::string DataArray(const std::string& type, const std::string& name, int components,
                      const std::string& numbers) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(components) + "\" format=\"ascii\">\n" + numbers + "\n</DataArray>\n";
}

std::string SurfaceFile(double load) {
  Grid grid;
  AddPatch(0, load, &grid);
  AddPatch(1, load, &grid);
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
      std::to_string(grid.count) + "\" NumberOfPolys=\"" + std::to_string(grid.quads) +
      "\">\n<PointData>\n";
  text += DataArray("Float64", "displacement_mm", 3, grid.displacements);
  text += DataArray("Float64", "axial_microstrain", 1, grid.strains);
  text += DataArray("Float64", "hoop_microstrain", 1, grid.zeros);
  text += DataArray("Float64", "sigma_um", 1, grid.sigmas);
  text += DataArray("Int32", "group", 1, grid.groups);
  text += "</PointData>\n<Points>\n" + DataArray("Float64", "points", 3, grid.points);
  text += "</Points>\n<Polys>\n" + DataArray("Int64", "connectivity", 1, grid.connectivity);
  text += DataArray("Int64", "offsets", 1, grid.offsets);
  return text + "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace

double PipeStrain_microstrain(double x_mm, double y_mm) {
  return 812 + 42 * y_mm + 3 * x_mm + 25 * std::sin(2.1 * x_mm) * std::cos(1.7 * y_mm);
}

std::filesystem::path FreshFolder(const std::string& name) {
  // Of the running test alone: ctest runs several at a time.
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string owner =
      test == nullptr ? "none" : std::string(test->test_suite_name()) + "." + test->name();
  const std::filesystem::path folder =
      std::filesystem::path(TELESTRAIN_BINARY_DIR) / "visual_test" / owner / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

void WriteResults(const std::filesystem::path& folder, const FixtureContent& content) {
  Require(WriteJson(folder / "inputs.json", Inputs()));
  Require(WriteJson(folder / "calibration.json", Calibration()));
  if (content.ruler) Require(WriteJson(folder / "ruler.json", Ruler()));
  if (!content.pipe) return;
  Require(WriteJson(folder / "strain.json", Strain()));
  for (const auto& [name, load] :
       {std::pair{"pipe_000.vtp", 0.0}, std::pair{"pipe_001.vtp", 1.0}, {"pipe_002.vtp", 0.5}})
    Require(WriteFileAtomically(folder / name, SurfaceFile(load)));
}

}  // namespace telestrain::visual_test
