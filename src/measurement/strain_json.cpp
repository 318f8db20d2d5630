#include "measurement/strain_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/numbers.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kMicro = 1e6;
constexpr double kDegPerRad = 57.29577951308232;

Json ValueJson(const StrainValue& value) {
  return {{"microstrain", kMicro * value.value},
          {"standard_uncertainty_microstrain", kMicro * value.standard_uncertainty},
          {"budget", BudgetLinesJson(value.budget)}};
}

Json TensorJson(const SurfaceTensor& tensor) {
  return {{"axial_microstrain", kMicro * tensor.axial},
          {"hoop_microstrain", kMicro * tensor.hoop},
          {"shear_microstrain", kMicro * tensor.shear},
          {"principal_1_microstrain", kMicro * tensor.principal_1},
          {"principal_2_microstrain", kMicro * tensor.principal_2},
          {"principal_angle_deg", kDegPerRad * tensor.principal_angle_rad},
          {"green_lagrange",
           {{"axial_microstrain", kMicro * tensor.green_axial},
            {"hoop_microstrain", kMicro * tensor.green_hoop},
            {"shear_microstrain", kMicro * tensor.green_shear},
            {"principal_1_microstrain", kMicro * tensor.green_principal_1},
            {"principal_2_microstrain", kMicro * tensor.green_principal_2}}}};
}

Json BeamJson(const StateStrain& strain) {
  const double amplitude = std::hypot(strain.bending_0.value, strain.bending_90.value);
  return {{"membrane", ValueJson(strain.membrane)},
          {"bending_0", ValueJson(strain.bending_0)},
          {"bending_90", ValueJson(strain.bending_90)},
          {"bending_amplitude_microstrain", kMicro * amplitude},
          {"bending_angle_deg",
           kDegPerRad * std::atan2(strain.bending_90.value, strain.bending_0.value)},
          {"torsion", ValueJson(strain.torsion)},
          {"across", ValueJson(strain.across)},
          {"chi2_per_freedom", strain.beam_chi2_per_freedom},
          {"misfit_rms_um", strain.beam_misfit_rms_um}};
}

Json MechanicalJson(const std::optional<MechanicalStrain>& mechanical) {
  if (!mechanical) return nullptr;
  return {{"temperature_change_k", mechanical->temperature_change_k},
          {"thermal_microstrain", kMicro * mechanical->thermal_strain},
          {"sigma_thermal_microstrain", kMicro * mechanical->sigma_thermal_strain},
          {"axial_microstrain", kMicro * mechanical->axial_strain},
          {"standard_uncertainty_microstrain", kMicro * mechanical->standard_uncertainty},
          {"membrane_microstrain", kMicro * mechanical->membrane_strain},
          {"membrane_uncertainty_microstrain", kMicro * mechanical->membrane_uncertainty}};
}

std::string Micro(double strain) { return FormatFixed(kMicro * strain, 3); }

}  // namespace

nlohmann::ordered_json BudgetLinesJson(const std::vector<BudgetLine>& budget) {
  const double total = Combine(budget);
  Json lines = Json::array();
  for (const BudgetLine& line : budget) {
    const double share = total > 0 ? std::pow(line.standard_uncertainty / total, 2) : 0;
    lines.push_back({{"source", line.source},
                     {"standard_uncertainty_microstrain", kMicro * line.standard_uncertainty},
                     {"share", share}});
  }
  return lines;
}

nlohmann::ordered_json StrainDetailsJson(const StateStrain& strain) {
  Json locals = Json::array(), patches = Json::array(), gauges = Json::array();
  for (const double sigma : strain.local_uncertainty) locals.push_back(kMicro * sigma);
  for (const SurfaceTensor& tensor : strain.patch_tensors) patches.push_back(TensorJson(tensor));
  for (const GaugeStrain& gauge : strain.gauges) {
    Json json{{"column", gauge.column}};
    json.update(ValueJson(gauge.strain));
    gauges.push_back(std::move(json));
  }
  return {{"local_standard_uncertainty_microstrain", locals},
          {"patches", patches},
          {"beam", BeamJson(strain)},
          {"fibre_mm", {strain.fibre_mm.x(), strain.fibre_mm.y()}},
          {"camera_at_gauges", gauges},
          {"mechanical", MechanicalJson(strain.mechanical)}};
}

nlohmann::ordered_json GaugeReadingsJson(
    const std::vector<std::string>& columns,
    const std::vector<std::optional<double>>& readings_microstrain) {
  Json json = Json::array();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    // A state that came while watching may stand in no table.
    const bool has_value = i < readings_microstrain.size() && readings_microstrain[i];
    json.push_back({{"column", columns[i]},
                    {"microstrain", has_value ? Json(*readings_microstrain[i]) : Json(nullptr)}});
  }
  return json;
}

nlohmann::ordered_json StrainDefinitionsJson() {
  return {
      {"strain", "engineering, relative to the reference state; Green-Lagrange where it says so"},
      {"shear",
       "change of the right angle between the pipe's axis and its circumference; "
       "Green-Lagrange shear is the tensor's component, half of it for small strains"},
      {"angle",
       "about the pipe's axis from the direction that faces the instrument (0 deg) "
       "towards the array's y (90 deg)"},
      {"bending",
       "axial strain that bending adds at the outer fibre at 0 deg and at 90 deg; at "
       "the angle t: membrane + bending_0 cos t + bending_90 sin t"},
      {"torsion", "shear of the surface; positive when it turns to larger angles along the pipe"},
      {"fibre_mm",
       "from the axis towards 90 deg and 0 deg: the fibre that the long-base and the "
       "local strain refer to, the mean over the arc that both nominal views see"},
      {"calibration", "the line holds what a wrong calibration makes of the rigid motion"}};
}

std::vector<std::string> StrainDetailColumns(const StateStrain& first) {
  std::vector<std::string> columns;
  for (const char* name : {"membrane", "bending_0", "bending_90", "torsion"}) {
    columns.push_back(std::string(name).append("_microstrain"));
    columns.push_back(std::string(name).append("_uncertainty_microstrain"));
  }
  for (const char* name :
       {"local_a_uncertainty_microstrain", "local_b_uncertainty_microstrain",
        "mechanical_axial_microstrain", "mechanical_axial_uncertainty_microstrain"})
    columns.emplace_back(name);
  for (const GaugeStrain& gauge : first.gauges) {
    columns.push_back("camera_at_" + gauge.column);
    columns.push_back("uncertainty_at_" + gauge.column);
  }
  return columns;
}

std::vector<std::string> StrainDetailCells(const StateStrain& strain) {
  std::vector<std::string> cells;
  for (const StrainValue* value :
       {&strain.membrane, &strain.bending_0, &strain.bending_90, &strain.torsion}) {
    cells.push_back(Micro(value->value));
    cells.push_back(Micro(value->standard_uncertainty));
  }
  for (std::size_t g = 0; g < 2; ++g) cells.push_back(Micro(strain.local_uncertainty.at(g)));
  cells.push_back(strain.mechanical ? Micro(strain.mechanical->axial_strain) : "");
  cells.push_back(strain.mechanical ? Micro(strain.mechanical->standard_uncertainty) : "");
  for (const GaugeStrain& gauge : strain.gauges) {
    cells.push_back(Micro(gauge.strain.value));
    cells.push_back(Micro(gauge.strain.standard_uncertainty));
  }
  return cells;
}

}  // namespace telestrain
