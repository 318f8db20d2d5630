#include "measurement/pipe_file.h"

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "base/csv.h"
#include "base/numbers.h"
#include "measurement/strain_json.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kMicro = 1e6;
constexpr const char* kShapeNames[] = {"shift", "affine", "quadratic"};  // by order
constexpr double kDegPerRad = 57.29577951308232;

Json ArrayOf(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json OptionalNumber(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

double LocalMicrostrain(const StateStrain& strain, std::size_t group) {
  return group < strain.local_axial_strain.size() ? kMicro * strain.local_axial_strain[group] : 0;
}

Json StateJson(const PipeMeasurement& measurement, std::size_t row) {
  const MeasuredState& state = measurement.states[row];
  const StateStrain& strain = state.strain;
  Json json{{"image", state.table.image},
            {"image_sha256", state.image_sha256.empty() ? Json(nullptr) : Json(state.image_sha256)},
            {"cycle", state.table.cycle},
            {"step", state.table.step},
            {"axial_microstrain", kMicro * strain.axial_strain},
            {"standard_uncertainty_microstrain", kMicro * strain.standard_uncertainty},
            {"local_a_microstrain", LocalMicrostrain(strain, 0)},
            {"local_b_microstrain", LocalMicrostrain(strain, 1)},
            {"local_sigma_microstrain", kMicro * strain.local_sigma},
            {"gauge_mean_microstrain", OptionalNumber(state.gauge_mean_microstrain)},
            {"gauge_change_microstrain", OptionalNumber(state.gauge_change_microstrain)},
            {"gauge_readings",
             GaugeReadingsJson(measurement.gauge_columns, state.table.gauges_microstrain)},
            {"compared_microstrain", kMicro * state.compared.strain},
            {"compared_uncertainty_microstrain", kMicro * state.compared.standard_uncertainty},
            {"compared_at_gauges", state.compared.at_gauges},
            {"points_used", strain.points_used},
            {"points_rejected", strain.points_rejected},
            {"rigid_motion",
             {{"translation_mm", ArrayOf(strain.translation_mm)},
              {"rotation_deg", ArrayOf(strain.rotation_rad * kDegPerRad)}}},
            {"budget", BudgetLinesJson(strain.budget)},
            {"file", SurfaceFileName(row)}};
  json.update(StrainDetailsJson(strain));
  return json;
}

Json ComparisonJson(const std::optional<GaugeComparison>& comparison) {
  if (!comparison) return nullptr;
  return {
      {"count", comparison->count},
      {"rms_error_microstrain", comparison->rms_error_microstrain},
      {"mean_error_microstrain", comparison->mean_error_microstrain},
      {"max_abs_error_microstrain", comparison->max_abs_error_microstrain},
      {"standard_uncertainty_microstrain", comparison->standard_uncertainty_microstrain},
      {"error_uncertainty_microstrain", OptionalNumber(comparison->error_uncertainty_microstrain)},
      {"slope", OptionalNumber(comparison->slope)},
      {"intercept_microstrain", OptionalNumber(comparison->intercept_microstrain)}};
}

Json GaugeOutliersJson(const std::vector<GaugeOutlier>& outliers) {
  Json json = Json::array();
  for (const GaugeOutlier& outlier : outliers)
    json.push_back({{"column", outlier.column},
                    {"image", outlier.image},
                    {"deviation_microstrain", outlier.deviation_microstrain},
                    {"standard_uncertainty_microstrain", outlier.sigma_microstrain}});
  return json;
}

// Root mean square of every budget line over the states after the reference.
Json BudgetJson(const std::vector<MeasuredState>& states) {
  Json budget = Json::array();
  if (states.size() < 2) return budget;
  for (std::size_t line = 0; line < states[1].strain.budget.size(); ++line) {
    double squares = 0;
    for (std::size_t i = 1; i < states.size(); ++i)
      squares += std::pow(states[i].strain.budget[line].standard_uncertainty, 2);
    budget.push_back({{"source", states[1].strain.budget[line].source},
                      {"standard_uncertainty_microstrain",
                       kMicro * std::sqrt(squares / static_cast<double>(states.size() - 1))}});
  }
  return budget;
}

// Quads whose four corners are used points of one group.
std::vector<std::array<int, 4>> Quads(const PipeGrid& grid, const std::vector<int>& id_of_point) {
  std::map<std::array<int, 3>, int> at;
  for (std::size_t i = 0; i < grid.points.size(); ++i)
    if (id_of_point[i] >= 0)
      at[{grid.points[i].group, grid.points[i].row, grid.points[i].column}] = id_of_point[i];
  std::vector<std::array<int, 4>> quads;
  for (const auto& [key, id] : at) {
    const auto right = at.find({key[0], key[1], key[2] + 1});
    const auto below = at.find({key[0], key[1] + 1, key[2]});
    const auto across = at.find({key[0], key[1] + 1, key[2] + 1});
    if (right != at.end() && below != at.end() && across != at.end())
      quads.push_back({id, right->second, across->second, below->second});
  }
  return quads;
}

std::string DataArray(const std::string& type, const std::string& name, int components,
                      const std::string& values) {
  std::string text = "        <DataArray type=\"" + type + "\" Name=\"" + name + "\"";
  if (components > 1) text += " NumberOfComponents=\"" + std::to_string(components) + "\"";
  return text + " format=\"ascii\">\n" + values + "        </DataArray>\n";
}

std::string Triple(const Eigen::Vector3d& v, int decimals) {
  return FormatFixed(v.x(), decimals) + " " + FormatFixed(v.y(), decimals) + " " +
         FormatFixed(v.z(), decimals) + "\n";
}

// VTK's ASCII reader knows "nan".
std::string Scalar(double value, int decimals) {
  return (std::isfinite(value) ? FormatFixed(value, decimals) : std::string("nan")) + "\n";
}

}  // namespace

std::string SurfaceFileName(std::size_t state) {
  std::string number = std::to_string(state);
  if (number.size() < 3) number.insert(0, 3 - number.size(), '0');
  return "pipe_" + number + ".vtp";
}

std::string StrainCsvHeader() {
  return "image,cycle,step,axial_microstrain,standard_uncertainty_microstrain,local_a_microstrain,"
         "local_b_microstrain,gauge_mean_microstrain\n";
}

std::string StrainCsvLine(const MeasuredState& state) {
  return CsvLine({state.table.image, state.table.cycle, state.table.step,
                  FormatFixed(kMicro * state.strain.axial_strain, 3),
                  FormatFixed(kMicro * state.strain.standard_uncertainty, 3),
                  FormatFixed(LocalMicrostrain(state.strain, 0), 3),
                  FormatFixed(LocalMicrostrain(state.strain, 1), 3),
                  state.gauge_mean_microstrain ? FormatFixed(*state.gauge_mean_microstrain, 3)
                                               : std::string()});
}

std::string StrainComponentsCsv(const std::vector<MeasuredState>& states) {
  std::string text;
  for (const MeasuredState& state : states) {
    std::vector<std::string> header{"image", "cycle", "step"};
    std::vector<std::string> row{state.table.image, state.table.cycle, state.table.step};
    for (std::string& column : StrainDetailColumns(state.strain))
      header.push_back(std::move(column));
    for (std::string& cell : StrainDetailCells(state.strain)) row.push_back(std::move(cell));
    if (text.empty()) text = CsvLine(header);
    text += CsvLine(row);
  }
  return text;
}

nlohmann::ordered_json StrainJson(const PipeMeasurement& measurement,
                                  const std::map<std::string, std::string>& made_from) {
  const PipeGrid& grid = measurement.grid;
  const double step_mm = grid.step_px / measurement.magnification_px_per_mm;
  const double subset_mm = measurement.options.subset_px / measurement.magnification_px_per_mm;
  Json states = Json::array();
  for (std::size_t i = 0; i < measurement.states.size(); ++i)
    states.push_back(StateJson(measurement, i));
  return {{"schema", kStrainSchema},
          {"made_from", made_from},
          {"pipe",
           {{"axis_point_in_array_mm", ArrayOf(grid.pipe.axis_point_mm)},
            {"axis_in_array", ArrayOf(grid.pipe.axis)},
            {"radius_mm", grid.pipe.radius_mm},
            {"diameter_mm", 2 * grid.pipe.radius_mm},
            {"sigma_diameter_mm", grid.sigma_diameter_mm},
            {"surface_rms_mm", grid.surface_rms_mm},
            {"points", grid.points.size()},
            {"found_by_search", grid.found_by_search},
            {"rejected", grid.rejected}}},
          {"geometry", PipeGeometryJson(measurement.geometry)},
          {"definitions", StrainDefinitionsJson()},
          {"base_length_mm", BaseLength_mm(grid)},
          {"options",
           {{"subset_px", measurement.options.subset_px},
            {"step_px", grid.step_px},
            {"shape_function", kShapeNames[measurement.options.shape_order]},
            {"interpolant", measurement.options.interpolation == Interpolation::kQuintic
                                ? "quintic B-spline"
                                : "cubic B-spline"},
            {"criterion", "ZNSSD"},
            {"prefilter_sigma_px", measurement.options.prefilter_sigma_px},
            {"virtual_strain_gauge_mm", 2 * kGaugeReach_steps * step_mm + subset_mm}}},
          {"states", states},
          {"comparison", ComparisonJson(measurement.comparison)},
          {"gauge_outliers", GaugeOutliersJson(measurement.gauge_outliers)},
          {"sequence", SequenceJson(measurement.sequence, measurement.sequence_states,
                                    measurement.coverage_factor)},
          {"budget", BudgetJson(measurement.states)}};
}

namespace {

// One array of point data as it grows, point by point.
struct PointArray {
  const char* name;
  int decimals;
  std::function<double(std::size_t)> value;
  std::string text = {};
};

std::vector<PointArray> ScalarArrays(const StateStrain& state, const PipeGeometry* geometry) {
  const auto micro = [&state](double SurfaceTensor::*member) {
    return [&state, member](std::size_t i) { return kMicro * state.points[i].tensor.*member; };
  };
  std::vector<PointArray> arrays{
      {"axial_microstrain", 3, micro(&SurfaceTensor::axial)},
      {"hoop_microstrain", 3, micro(&SurfaceTensor::hoop)},
      {"zncc", 6, [&state](std::size_t i) { return state.points[i].zncc; }},
      {"sigma_um", 6, [&state](std::size_t i) { return state.points[i].sigma_um; }},
      {"shear_microstrain", 3, micro(&SurfaceTensor::shear)},
      {"principal_1_microstrain", 3, micro(&SurfaceTensor::principal_1)},
      {"principal_2_microstrain", 3, micro(&SurfaceTensor::principal_2)},
      {"principal_angle_deg", 3,
       [&state](std::size_t i) { return kDegPerRad * state.points[i].tensor.principal_angle_rad; }},
      {"green_axial_microstrain", 3, micro(&SurfaceTensor::green_axial)},
      {"green_hoop_microstrain", 3, micro(&SurfaceTensor::green_hoop)},
      {"green_shear_microstrain", 3, micro(&SurfaceTensor::green_shear)}};
  if (geometry)
    arrays.push_back({"radial_deviation_um", 4, [geometry](std::size_t i) {
                        return 1000 * geometry->radial_deviation_mm[i];
                      }});
  return arrays;
}

}  // namespace

std::string SurfaceVtp(const PipeGrid& grid, const StateStrain& state,
                       const PipeGeometry* geometry) {
  std::vector<int> id_of_point(grid.points.size(), -1);
  int count = 0;
  std::string points, displacement, group;
  std::vector<PointArray> arrays = ScalarArrays(state, geometry);
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    const PointResult& result = state.points[i];
    // Too few neighbours: no strain, and VTK's text format has no NaN.
    if (!result.used || !std::isfinite(result.axial_strain)) continue;
    id_of_point[i] = count++;
    points += Triple(grid.points[i].reference_in_array_mm + result.displacement_mm, 7);
    displacement += Triple(result.displacement_mm, 8);
    for (PointArray& array : arrays) array.text += Scalar(array.value(i), array.decimals);
    group += std::to_string(grid.points[i].group) + "\n";
  }
  std::string scalars, connectivity, offsets;
  for (const PointArray& array : arrays) scalars += DataArray("Float64", array.name, 1, array.text);
  int end = 0;
  const auto quads = Quads(grid, id_of_point);
  for (const auto& quad : quads) {
    connectivity += std::to_string(quad[0]) + " " + std::to_string(quad[1]) + " " +
                    std::to_string(quad[2]) + " " + std::to_string(quad[3]) + "\n";
    offsets += std::to_string(end += 4) + "\n";
  }
  return "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
         "  <PolyData>\n    <Piece NumberOfPoints=\"" +
         std::to_string(count) + "\" NumberOfPolys=\"" + std::to_string(quads.size()) +
         "\">\n      <Points>\n" + DataArray("Float64", "position_in_array_mm", 3, points) +
         "      </Points>\n      <PointData Scalars=\"axial_microstrain\">\n" +
         DataArray("Float64", "displacement_mm", 3, displacement) + scalars +
         DataArray("Int32", "group", 1, group) + "      </PointData>\n      <Polys>\n" +
         DataArray("Int64", "connectivity", 1, connectivity) +
         DataArray("Int64", "offsets", 1, offsets) +
         "      </Polys>\n    </Piece>\n  </PolyData>\n</VTKFile>\n";
}

}  // namespace telestrain
