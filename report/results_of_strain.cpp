#include <algorithm>
#include <cmath>

#include "report/results_parts.h"

namespace telestrain {
namespace {

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

// One decimal place per column. The U of the local strains is not printed.
void AlignStates(const Json& strain, const Acceptance& acceptance, ResultTable& table) {
  enum Column : std::size_t { kLong = 3, kLongU, kLocalA, kLocalB, kGauges, kGaugesU, kError = 10 };
  std::vector<double> local;
  for (const Json& state : ListAt(strain, "/states"))
    for (const char* patch : {"/0", "/1"})
      if (const auto expanded = acceptance.Expanded(
              NumberAt(state, std::string("/local_standard_uncertainty_microstrain") + patch)))
        local.push_back(*expanded);
  table.AlignDecimals(kLongU, {kLong});
  table.AlignDecimals(local, {kLocalA, kLocalB});
  table.AlignDecimals(kGaugesU, {kGauges, kError});
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
                  ResultCells(Difference(compared, gauge), compared_expanded, 1).value,
                  CountCell(NumberAt(state, "/points_used")), CountCell(RejectedPoints(state))});
  }
  AlignStates(strain, draft.acceptance, table);
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
  for (std::size_t uncertainty : {2, 4, 6, 8}) table.AlignDecimals(uncertainty, {uncertainty - 1});
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

Quantity StrainError(const Json& comparison, const Acceptance& acceptance) {
  Quantity error;
  error.id = "strain_error";
  error.section = "strain";
  error.label = "Strain error against the gauges, RMS";
  error.unit = "µε";
  error.limit_kind = "max";
  error.decimals = 1;
  error.value = NumberAt(comparison, "/rms_error_microstrain");
  const auto with_gauges = NumberAt(comparison, "/error_uncertainty_microstrain");
  error.expanded_uncertainty = acceptance.Expanded(
      with_gauges ? with_gauges : NumberAt(comparison, "/standard_uncertainty_microstrain"));
  error.has_uncertainty = true;
  error.limit = acceptance.strain_error_microstrain;
  return error;
}

void AddComparison(const Json& strain, ResultsDraft& draft) {
  const Json& comparison = EntryAt(strain, "/comparison");
  const bool has_gauges = comparison.is_object();
  draft.measured["gauges"] = has_gauges;
  const Quantity error = StrainError(comparison, draft.acceptance);
  draft.AddQuantity(error);
  if (!has_gauges) return;
  const bool with_gauges = NumberAt(comparison, "/error_uncertainty_microstrain").has_value();
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
  const auto bias_u =
      NumberAt(strain, "/sequence/regression/bias_microstrain/expanded_uncertainty");
  table.AddFact("Mean error",
                ResultCells(NumberAt(comparison, "/mean_error_microstrain"), bias_u, 1).value,
                "µε");
  table.AddFact("Largest error", fixed("/max_abs_error_microstrain", 1), "µε");
  // That of the sequence, with errors in both, says the same better.
  if (!NumberAt(strain, "/sequence/regression/slope/value")) {
    table.AddFact("Slope of the regression", fixed("/slope", 4));
    table.AddFact("Intercept of the regression", fixed("/intercept_microstrain", 1), "µε");
  }
  draft.AddTable(std::move(table));
}

// The diameter against the nominal one, and the form.
void AddGeometry(const Json& geometry, ResultsDraft& draft, ResultTable& table) {
  const auto diameter = NumberAt(geometry, "/diameter_mm");
  const auto sigma_um = NumberAt(geometry, "/standard_uncertainty_um");
  if (!diameter || !sigma_um) return;
  const auto expanded_um = draft.acceptance.Expanded(*sigma_um),
             expanded_mm = draft.acceptance.Expanded(*sigma_um / 1000);
  draft.AddPlain({"pipe_diameter", "strain", "Outer diameter of the pipe", "mm", 4}, diameter,
                 expanded_mm);
  table.AddFact("Outer diameter", UncertainCell(*diameter, expanded_mm, FixedCell(diameter, 4)),
                "mm");
  if (const auto deviation_um = NumberAt(geometry, "/deviation_um"))
    table.AddFact("Deviation from the nominal diameter",
                  UncertainCell(*deviation_um, expanded_um, FixedCell(deviation_um, 2)), "µm");
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
    AddGeometry(geometry, draft, table);
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

// What the first page has to say of the recording.
void AddDoubts(const Json& strain, ResultsDraft& draft) {
  std::vector<Json> sentences;
  for (const Json& doubt : ListAt(strain, "/doubts"))
    if (doubt.is_string()) sentences.push_back(PhraseOfText(doubt.get<std::string>()));
  if (!sentences.empty()) draft.sentences["doubts"] = JoinPhrases(sentences);
}

}  // namespace

void AddStrain(const Json& strain, ResultsDraft& draft) {
  const bool measured = !ListAt(strain, "/states").empty();
  draft.measured["strain"] = measured;
  AddComparison(strain, draft);
  draft.measured["sequence"] = false;
  if (!measured) return;
  AddDoubts(strain, draft);
  AddStates(strain, draft);
  AddBeam(strain, draft);
  AddRejectedPoints(strain, draft);
  AddPipe(strain, draft);
  AddSequence(strain, draft);
}

}  // namespace telestrain
