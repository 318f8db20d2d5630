#include <algorithm>
#include <array>
#include <cmath>

#include "report/results_parts.h"

namespace telestrain {
namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

std::optional<double> Difference(std::optional<double> a, std::optional<double> b) {
  return a && b ? std::optional<double>(*a - *b) : std::nullopt;
}

std::optional<double> RejectedPoints(const Json& state) {
  const Json& rejected = EntryAt(state, "/points_rejected");
  if (!rejected.is_object()) return NumberAt(state, "/points_rejected");
  double count = 0;
  for (const auto& [reason, number] : rejected.items())
    if (number.is_number()) count += number.get<double>();
  return count;
}

void AddStates(const Json& strain, ResultsDraft& draft) {
  ResultTable table("strain-states", "Axial strain of every state",
                    {{"Image", ""},
                     {"Cycle", ""},
                     {"Step", ""},
                     {"Long base", "µε"},
                     {"U", "µε"},
                     {"Local A", "µε"},
                     {"Local B", "µε"},
                     {"At gauges", "µε"},
                     {"U", "µε"},
                     {"Gauges, change", "µε"},
                     {"Difference", "µε"},
                     {"Points", ""},
                     {"Rejected", ""}});
  for (const Json& state : ListAt(strain, "/states")) {
    const auto axial = NumberAt(state, "/axial_microstrain");
    const auto gauge = NumberAt(state, "/gauge_change_microstrain");
    const Json& beside = EntryAt(state, "/compared_microstrain");
    const auto compared = beside.is_number() ? beside.get<double>() : axial;
    const auto compared_expanded = draft.acceptance.Expanded(
        NumberAt(state, beside.is_number() ? "/compared_uncertainty_microstrain"
                                           : "/standard_uncertainty_microstrain"));
    const ResultCellPair at_gauges = ResultCells(compared, compared_expanded, 1);
    const auto expanded =
        draft.acceptance.Expanded(NumberAt(state, "/standard_uncertainty_microstrain"));
    const ResultCellPair camera = ResultCells(axial, expanded, 1);
    table.AddRow({TextAt(state, "/image", "?"), TextAt(state, "/cycle", kNoValue),
                  TextAt(state, "/step", kNoValue), camera.value, camera.uncertainty,
                  FixedCell(NumberAt(state, "/local_a_microstrain"), 1),
                  FixedCell(NumberAt(state, "/local_b_microstrain"), 1), at_gauges.value,
                  at_gauges.uncertainty, FixedCell(gauge, 1),
                  FixedCell(Difference(compared, gauge), 1),
                  CountCell(NumberAt(state, "/points_used")), CountCell(RejectedPoints(state))});
  }
  draft.AddTable(std::move(table));
}

// How the pipe was loaded: the parts of the beam that both patches follow.
void AddBeam(const Json& strain, ResultsDraft& draft) {
  ResultTable table("strain-beam", "Membrane, bending and torsion of every state",
                    {{"Image", ""},
                     {"Membrane", "µε"},
                     {"U", "µε"},
                     {"Bending 0°", "µε"},
                     {"U", "µε"},
                     {"Bending 90°", "µε"},
                     {"U", "µε"},
                     {"Torsion", "µε"},
                     {"U", "µε"}});
  for (const Json& state : ListAt(strain, "/states")) {
    const Json& beam = EntryAt(state, "/beam");
    if (!beam.is_object()) continue;
    std::vector<Json> cells{TextAt(state, "/image", "?")};
    for (const char* part : {"/membrane", "/bending_0", "/bending_90", "/torsion"}) {
      const auto at = [&](const char* key) { return NumberAt(beam, std::string(part) + key); };
      const ResultCellPair pair =
          ResultCells(at("/microstrain"),
                      draft.acceptance.Expanded(at("/standard_uncertainty_microstrain")), 1);
      cells.push_back(pair.value);
      cells.push_back(pair.uncertainty);
    }
    table.AddRow(cells);
  }
  if (!table.empty()) draft.AddTable(std::move(table));
}

void AddReasons(const std::string& state, const Json& counts, ResultTable& table) {
  if (!counts.is_object()) return;
  for (const auto& [reason, number] : counts.items())
    if (number.is_number())
      table.AddRow({state, PhraseOfText(reason), CountCell(number.get<double>())});
}

// The points lost when the reference image was matched, then all reasons over all states, so that
// nothing is dropped silently.
void AddRejectedPoints(const Json& strain, ResultsDraft& draft) {
  Json sums = Json::object();
  for (const Json& state : ListAt(strain, "/states")) {
    const Json& rejected = EntryAt(state, "/points_rejected");
    if (!rejected.is_object()) continue;
    for (const auto& [reason, number] : rejected.items())
      if (number.is_number()) sums[reason] = sums.value(reason, 0.0) + number.get<double>();
  }
  ResultTable table("strain-rejected", "Surface points rejected",
                    {{"State", ""}, {"Reason", ""}, {"Points", ""}});
  AddReasons("reference image", EntryAt(strain, "/pipe/rejected"), table);
  AddReasons("all states", sums, table);
  if (!table.empty()) draft.AddTable(std::move(table));
}

void AddComparison(const Json& strain, ResultsDraft& draft) {
  const Json& comparison = EntryAt(strain, "/comparison");
  const bool has_gauges = comparison.is_object();
  draft.measured["gauges"] = has_gauges;
  Quantity error;
  error.id = "strain_error";
  error.section = "strain";
  error.label = "Strain error against the gauges, RMS";
  error.unit = "µε";
  error.limit_kind = "max";
  error.decimals = 1;
  error.value = NumberAt(comparison, "/rms_error_microstrain");
  const auto with_gauges = NumberAt(comparison, "/error_uncertainty_microstrain");
  error.expanded_uncertainty = draft.acceptance.Expanded(
      with_gauges ? with_gauges : NumberAt(comparison, "/standard_uncertainty_microstrain"));
  error.has_uncertainty = true;
  error.limit = draft.acceptance.strain_error_microstrain;
  draft.AddQuantity(error);
  if (!has_gauges) return;
  draft.sentences["strain_uncertainty"] =
      with_gauges ? "U of the strain error is the coverage factor times the RMS of the standard "
                    "uncertainties over the states compared: the camera's and the gauges'."
                  : "U of the strain error is the coverage factor times the RMS of the standard "
                    "uncertainties over the states compared: the camera's; the gauges' own "
                    "uncertainty is not included.";
  ResultTable table = FactTable("strain-comparison", "Camera against gauges");
  const auto fixed = [&](const char* pointer, int decimals) {
    return FixedCell(NumberAt(comparison, pointer), decimals);
  };
  table.AddFact("States compared", CountCell(NumberAt(comparison, "/count")));
  const ResultCellPair rms = ResultCells(error.value, error.expanded_uncertainty, error.decimals);
  table.AddFact("RMS error", rms.value, "µε");
  table.AddFact(
      with_gauges ? "U of the RMS error (camera and gauges)" : "U of the RMS error (camera only)",
      rms.uncertainty, "µε");
  table.AddFact("Mean error", fixed("/mean_error_microstrain", 1), "µε");
  table.AddFact("Largest error", fixed("/max_abs_error_microstrain", 1), "µε");
  table.AddFact("Slope of the regression", fixed("/slope", 4));
  table.AddFact("Intercept of the regression", fixed("/intercept_microstrain", 1), "µε");
  draft.AddTable(std::move(table));
}

// The diameter against the nominal one, and the form.
void AddGeometry(const Json& geometry, const Acceptance& acceptance, ResultTable& table) {
  const auto diameter = NumberAt(geometry, "/diameter_mm");
  const auto sigma_um = NumberAt(geometry, "/standard_uncertainty_um");
  if (!diameter || !sigma_um) return;
  table.AddFact(
      "Outer diameter",
      UncertainCell(*diameter, acceptance.Expanded(*sigma_um / 1000), FixedCell(diameter, 4)),
      "mm");
  table.AddFact("Deviation from the nominal diameter",
                FixedCell(NumberAt(geometry, "/deviation_um"), 2), "µm");
  table.AddFact("Roundness, RMS", FixedCell(NumberAt(geometry, "/roundness_rms_um"), 2), "µm");
  table.AddFact("Roundness, peak to valley",
                FixedCell(NumberAt(geometry, "/roundness_peak_to_valley_um"), 2), "µm");
  const auto radius = NumberAt(geometry, "/bend_radius_mm");
  table.AddFact("Axis", radius ? Json("bent") : Json("straight within its uncertainty"));
  if (radius) table.AddFact("Radius of the bend", FixedCell(radius, 0), "mm");
}

void AddPipe(const Json& strain, ResultsDraft& draft) {
  ResultTable table = FactTable("pipe", "Pipe as measured");
  const Json& geometry = EntryAt(strain, "/geometry");
  if (geometry.is_object()) {
    AddGeometry(geometry, draft.acceptance, table);
  } else if (const auto diameter = NumberAt(strain, "/pipe/diameter_mm")) {
    const auto expanded = draft.acceptance.Expanded(NumberAt(strain, "/pipe/sigma_diameter_mm"));
    table.AddFact("Outer diameter (U of the fit)",
                  UncertainCell(*diameter, expanded, FixedCell(diameter, 4)), "mm");
  }
  table.AddFact("Points of the fit", CountCell(NumberAt(strain, "/pipe/points")));
  table.AddFact("Base length of the axial strain",
                FixedCell(NumberAt(strain, "/base_length_mm"), 4), "mm");
  draft.AddTable(std::move(table));
}

void AddBudget(const Json& strain, ResultsDraft& draft) {
  ResultTable table("strain-budget", "Uncertainty budget of one axial strain",
                    {{"Source", ""}, {"Standard uncertainty", "µε"}});
  for (const Json& entry : ListAt(strain, "/budget"))
    table.AddRow({TextAt(entry, "/source", "?"),
                  SignificantCell(NumberAt(entry, "/standard_uncertainty_microstrain"), 2)});
  if (!table.empty()) draft.AddTable(std::move(table));
}

// The angle between the viewing directions of the first two views of `group`.
std::optional<double> StereoAngle_deg(const Json& calibration, const std::string& group) {
  std::vector<std::array<double, 3>> axes;
  for (const Json& view : ListAt(calibration, "/views")) {
    if (TextAt(view, "/group") != group) continue;
    const auto x = NumberAt(view, "/axis_in_array/0"), y = NumberAt(view, "/axis_in_array/1"),
               z = NumberAt(view, "/axis_in_array/2");
    if (x && y && z) axes.push_back({*x, *y, *z});
  }
  if (axes.size() < 2) return {};
  double dot = 0;
  for (int i = 0; i < 3; ++i) dot += axes[0][i] * axes[1][i];
  return kDegreesPerRadian * std::acos(std::clamp(dot, -1.0, 1.0));
}

void AddStereoAngles(const Json& calibration, ResultTable& table) {
  std::vector<std::string> groups;
  for (const Json& view : ListAt(calibration, "/views")) {
    const std::string group = TextAt(view, "/group");
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
  }
  for (const std::string& group : groups)
    if (const auto angle = StereoAngle_deg(calibration, group))
      table.AddFact(Phrase("Stereo angle, group {{group}}", {{"group", group}}),
                    FixedCell(angle, 2), "°");
}

// The reporting table of the iDICs good practices guide.
void AddCorrelation(const Json& strain, const Json& calibration, ResultsDraft& draft) {
  ResultTable table = FactTable("correlation", "Correlation settings (iDICs reporting table)");
  const auto number = [&](const char* pointer) { return ExactCell(NumberAt(strain, pointer)); };
  table.AddFact("Subset", number("/options/subset_px"), "px");
  table.AddFact("Step", number("/options/step_px"), "px");
  table.AddFact("Shape function", TextAt(strain, "/options/shape_function", kNoValue));
  table.AddFact("Interpolant", TextAt(strain, "/options/interpolant", kNoValue));
  table.AddFact("Criterion", TextAt(strain, "/options/criterion", kNoValue));
  table.AddFact("Prefilter, Gaussian sigma", number("/options/prefilter_sigma_px"), "px");
  table.AddFact("Virtual strain gauge",
                FixedCell(NumberAt(strain, "/options/virtual_strain_gauge_mm"), 2), "mm");
  if (!calibration.is_null()) {
    table.AddFact("Image scale",
                  SignificantCell(NumberAt(calibration, "/lens/magnification_px_per_mm"), 6),
                  "px/mm");
    AddStereoAngles(calibration, table);
  }
  draft.AddTable(std::move(table));
}

}  // namespace

void AddStrain(const Json& strain, const Json& calibration, ResultsDraft& draft) {
  const bool measured = !ListAt(strain, "/states").empty();
  draft.measured["strain"] = measured;
  AddComparison(strain, draft);
  draft.measured["sequence"] = false;
  if (!measured) return;
  AddStates(strain, draft);
  AddBeam(strain, draft);
  AddRejectedPoints(strain, draft);
  AddPipe(strain, draft);
  AddBudget(strain, draft);
  AddCorrelation(strain, calibration, draft);
  AddSequence(strain, draft);
}

}  // namespace telestrain
