#include "measurement/state_record.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/json_file.h"
#include "base/numbers.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

// Numbers that JSON does not have are null.
Json Write(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
void Read(const Json& json, double& value) {
  value = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Json Write(int value) { return value; }
void Read(const Json& json, int& value) { value = json.get<int>(); }

template <int kRows, int kColumns>
Json Write(const Eigen::Matrix<double, kRows, kColumns>& matrix) {
  Json json = Json::array();
  for (Eigen::Index row = 0; row < kRows; ++row)
    for (Eigen::Index column = 0; column < kColumns; ++column)
      json.push_back(Write(matrix(row, column)));
  return json;
}
template <int kRows, int kColumns>
void Read(const Json& json, Eigen::Matrix<double, kRows, kColumns>& matrix) {
  for (Eigen::Index row = 0; row < kRows; ++row)
    for (Eigen::Index column = 0; column < kColumns; ++column)
      Read(json.at(static_cast<std::size_t>(row * kColumns + column)), matrix(row, column));
}

Json Write(const std::map<std::string, int>& counts) { return counts; }
void Read(const Json& json, std::map<std::string, int>& counts) {
  counts = json.get<std::map<std::string, int>>();
}

Json Write(const BudgetLine& line) {
  return Json::array({line.source, Write(line.standard_uncertainty)});
}
void Read(const Json& json, BudgetLine& line) {
  line.source = json.at(0).get<std::string>();
  Read(json.at(1), line.standard_uncertainty);
}

Json Write(const ViewMotion& motion) {
  return Json::array({Write(motion.shift_px), Write(motion.gradient)});
}
void Read(const Json& json, ViewMotion& motion) {
  Read(json.at(0), motion.shift_px);
  Read(json.at(1), motion.gradient);
}

Json Write(const std::string& text) { return text; }
void Read(const Json& json, std::string& text) { text = json.get<std::string>(); }

// Declared before the templates that need them.
Json Write(const StrainValue& v);
void Read(const Json& json, StrainValue& v);
Json Write(const SurfaceTensor& tensor);
void Read(const Json& json, SurfaceTensor& tensor);
Json Write(const GaugeStrain& gauge);
void Read(const Json& json, GaugeStrain& gauge);

template <class Value>
Json Write(const std::vector<Value>& values) {
  Json json = Json::array();
  for (const Value& value : values) json.push_back(Write(value));
  return json;
}
template <class Value>
void Read(const Json& json, std::vector<Value>& values) {
  values.resize(json.size());
  for (std::size_t i = 0; i < values.size(); ++i) Read(json.at(i), values[i]);
}

// A list of members in their order.
template <class... Member>
Json WriteAll(const Member&... member) {
  return Json::array({Write(member)...});
}
template <class... Member>
void ReadAll(const Json& json, Member&... member) {
  std::size_t i = 0;
  (Read(json.at(i++), member), ...);
}

Json Write(const SurfaceTensor& t) {
  const auto& [axial, hoop, shear, first, second, angle, green_axial, green_hoop, green_shear,
               green_first, green_second] = t;
  return WriteAll(axial, hoop, shear, first, second, angle, green_axial, green_hoop, green_shear,
                  green_first, green_second);
}
void Read(const Json& json, SurfaceTensor& t) {
  auto& [axial, hoop, shear, first, second, angle, green_axial, green_hoop, green_shear,
         green_first, green_second] = t;
  ReadAll(json, axial, hoop, shear, first, second, angle, green_axial, green_hoop, green_shear,
          green_first, green_second);
}

Json Write(const StrainValue& v) { return WriteAll(v.value, v.standard_uncertainty, v.budget); }
void Read(const Json& json, StrainValue& v) {
  ReadAll(json, v.value, v.standard_uncertainty, v.budget);
}

Json Write(const GaugeStrain& gauge) { return WriteAll(gauge.column, gauge.strain); }
void Read(const Json& json, GaugeStrain& gauge) { ReadAll(json, gauge.column, gauge.strain); }

Json Write(const std::optional<MechanicalStrain>& mechanical) {
  if (!mechanical) return nullptr;
  const auto& [change, thermal, sigma, axial, uncertainty, membrane, membrane_uncertainty] =
      *mechanical;
  return WriteAll(change, thermal, sigma, axial, uncertainty, membrane, membrane_uncertainty);
}
void Read(const Json& json, std::optional<MechanicalStrain>& mechanical) {
  mechanical.reset();
  if (json.is_null()) return;
  auto& [change, thermal, sigma, axial, uncertainty, membrane, membrane_uncertainty] =
      mechanical.emplace();
  ReadAll(json, change, thermal, sigma, axial, uncertainty, membrane, membrane_uncertainty);
}

// Calls `visit(name, member)` for all of a state's strain but its points. The binding does not
// compile when StateStrain has a member that is not listed here.
template <class Strain, class Visit>
void ForEachMember(Strain& strain, const Visit& visit) {
  auto& [axial, uncertainty, local_axial, local_hoop, local_uncertainty, tensors, local_sigma,
         membrane, bending_0, bending_90, torsion, across, beam_chi2, beam_misfit, fibre, gauges,
         mechanical, translation, rotation, points, used, rejected, budget] = strain;
  visit("axial_strain", axial);
  visit("standard_uncertainty", uncertainty);
  visit("local_axial_strain", local_axial);
  visit("local_hoop_strain", local_hoop);
  visit("local_uncertainty", local_uncertainty);
  visit("patch_tensors", tensors);
  visit("local_sigma", local_sigma);
  visit("membrane", membrane);
  visit("bending_0", bending_0);
  visit("bending_90", bending_90);
  visit("torsion", torsion);
  visit("across", across);
  visit("beam_chi2_per_freedom", beam_chi2);
  visit("beam_misfit_rms_um", beam_misfit);
  visit("fibre_mm", fibre);
  visit("gauges", gauges);
  visit("mechanical", mechanical);
  visit("translation_mm", translation);
  visit("rotation_rad", rotation);
  visit("points_used", used);
  visit("points_rejected", rejected);
  visit("budget", budget);
  static_cast<void>(points);
}

}  // namespace

std::string StateRecordLine(const StateRecord& record) {
  Json strain;
  ForEachMember(record.state.strain,
                [&](const char* name, const auto& member) { strain[name] = Write(member); });
  const Json json{{"schema", kStateSchema},
                  {"image", record.image},
                  {"made_from", record.made_from},
                  {"surface_sha256", record.surface_sha256},
                  {"from", Write(record.state.from)},
                  {"motions", Write(record.state.motions)},
                  {"strain", strain}};
  return json.dump() + '\n';
}

Result<StateRecord> ReadStateRecord(const std::string& line) {
  try {
    const auto parsed = ParseJson(line);
    if (!parsed) return BadInput("no whole record: it " + parsed.error().message);
    const Json& json = *parsed;
    if (json.at("schema") != kStateSchema)
      return BadInput("a record of another version; it is measured again");
    StateRecord record;
    record.image = json.at("image").get<std::string>();
    record.made_from = json.at("made_from").get<std::map<std::string, std::string>>();
    record.surface_sha256 = json.at("surface_sha256").get<std::string>();
    Read(json.at("from"), record.state.from);
    Read(json.at("motions"), record.state.motions);
    ForEachMember(record.state.strain, [&](const char* name, auto& member) {
      Read(json.at("strain").at(name), member);
    });
    return record;
  } catch (const nlohmann::json::exception& e) {
    return BadInput(std::string("no whole record: ") + JsonProblem(e));
  }
}

std::string PipeOptionsText(const PipeOptions& options) {
  const auto number = [](const char* name, double value) {
    return std::string(name) + ' ' + FormatShortest(value);
  };
  return number("subset_px", options.subset_px) + ", " + number("step_px", options.Step_px()) +
         ", " + number("shape_order", options.shape_order) + ", spline degree " +
         (options.interpolation == Interpolation::kQuintic ? "5" : "3") + ", " +
         number("prefilter_sigma_px", options.prefilter_sigma_px) + ", " +
         number("max_iterations", options.max_iterations) + ", " +
         number("convergence_px", options.convergence_px) + ", " +
         number("min_zncc", options.min_zncc) + ", " +
         number("min_contrast_gray", options.min_contrast_gray);
}

}  // namespace telestrain
