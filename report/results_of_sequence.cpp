#include "report/results_parts.h"

namespace telestrain {
namespace {

ResultCellPair EstimateCells(const Json& json, int decimals) {
  return ResultCells(NumberAt(json, "/value"), NumberAt(json, "/expanded_uncertainty"), decimals);
}

void AddEstimate(const Json& estimate, const std::string& name, const std::string& unit,
                 ResultTable& table) {
  if (const auto value = NumberAt(estimate, "/value"))
    table.AddFact(
        name,
        UncertainCell(*value, NumberAt(estimate, "/expanded_uncertainty"), FixedCell(value, 3)),
        unit);
}

void AddNumber(std::optional<double> value, int digits, const std::string& name,
               const std::string& unit, ResultTable& table) {
  if (value) table.AddFact(name, SignificantCell(value, digits), unit);
}

void AddFloor(const Json& floor, const std::string& what, ResultTable& table) {
  if (!floor.is_object()) return;
  table.AddFact("States " + what, CountCell(NumberAt(floor, "/count")));
  AddEstimate(EntryAt(floor, "/mean_microstrain"), "Mean strain " + what, "µε", table);
  AddNumber(NumberAt(floor, "/sd_microstrain"), 2, "Standard deviation " + what, "µε", table);
  AddNumber(NumberAt(floor, "/stated_sd_microstrain"), 2, "Stated for one reading " + what, "µε",
            table);
}

void AddFacts(const Json& sequence, ResultsDraft& draft) {
  ResultTable table = FactTable("sequence", "Sequence: regression, drift, noise floors");
  const Json& regression = EntryAt(sequence, "/regression");
  const auto number = [&](const char* pointer) { return NumberAt(regression, pointer); };
  draft.AddPlain({"strain_slope", "strain", "Slope, camera over gauges", "", 4},
                 number("/slope/value"), number("/slope/expanded_uncertainty"));
  draft.AddPlain({"strain_bias", "strain", "Bias: mean of camera - gauges", "µε", 2},
                 number("/bias_microstrain/value"),
                 number("/bias_microstrain/expanded_uncertainty"));
  AddEstimate(EntryAt(regression, "/slope"), "Slope, camera over gauges", "", table);
  AddEstimate(EntryAt(regression, "/intercept_microstrain"), "Intercept", "µε", table);
  AddEstimate(EntryAt(regression, "/bias_microstrain"), "Bias: mean of camera - gauges", "µε",
              table);
  AddNumber(NumberAt(regression, "/residual_rms_microstrain"), 2, "Residuals, RMS", "µε", table);
  AddEstimate(EntryAt(sequence, "/drift_microstrain_per_hour"), "Drift of the zero states", "µε/h",
              table);
  AddEstimate(EntryAt(sequence, "/largest_change_between_cycles_microstrain"),
              "Largest change of zero between cycles", "µε", table);
  AddNumber(NumberAt(sequence, "/repeatability/sd_microstrain"), 2,
            "Repeatability at equal steps, one value", "µε", table);
  AddEstimate(EntryAt(sequence, "/warm_up/time_constant_s"), "Time constant of warming up", "s",
              table);
  AddFloor(EntryAt(sequence, "/noise_floor_still"), "without strain, not moved", table);
  AddFloor(EntryAt(sequence, "/noise_floor_moved"), "without strain, moved", table);
  if (!table.empty()) draft.AddTable(std::move(table));
}

void AddCycles(const Json& sequence, ResultsDraft& draft) {
  ResultTable table("sequence-cycles", "Cycles",
                    {{"Cycle", ""},
                     {"States", ""},
                     {"Slope", ""},
                     {"U", ""},
                     {"Intercept", "µε"},
                     {"U", "µε"},
                     {"Hysteresis", "µε"},
                     {"U", "µε"},
                     {"Zero", "µε"},
                     {"U", "µε"}});
  for (const Json& cycle : ListAt(sequence, "/cycles")) {
    if (!EntryAt(cycle, "/regression").is_object()) continue;
    const ResultCellPair slope = EstimateCells(EntryAt(cycle, "/regression/slope"), 4);
    const ResultCellPair intercept =
        EstimateCells(EntryAt(cycle, "/regression/intercept_microstrain"), 2);
    const ResultCellPair loop = EstimateCells(EntryAt(cycle, "/hysteresis/largest_microstrain"), 2);
    const ResultCellPair zero = EstimateCells(EntryAt(cycle, "/zero_microstrain"), 2);
    table.AddRow({TextAt(cycle, "/cycle", kNoValue),
                  CountCell(NumberAt(cycle, "/regression/count")), slope.value, slope.uncertainty,
                  intercept.value, intercept.uncertainty, loop.value, loop.uncertainty, zero.value,
                  zero.uncertainty});
  }
  for (std::size_t uncertainty : {3, 5, 7, 9}) table.AlignDecimals(uncertainty, {uncertainty - 1});
  if (!table.empty()) draft.AddTable(std::move(table));
}

void AddClasses(const Json& sequence, ResultsDraft& draft) {
  ResultTable table("extensometer-class", "Class of the extensometer system",
                    {{"Standard", ""},
                     {"Class", ""},
                     {"Class with U", ""},
                     {"Values", ""},
                     {"Up to", ""},
                     {"Deciding error", ""},
                     {"Its limit", ""},
                     {"Resolution", ""},
                     {"Its limit", ""},
                     {"Unit", ""}});
  std::vector<Json> not_covered;
  for (const char* pointer : {"/iso9513", "/astm_e83"}) {
    const Json& result = EntryAt(sequence, pointer);
    if (!result.is_object()) continue;
    table.AddRow({TextAt(result, "/standard", "?"), TextAt(result, "/class", "none"),
                  TextAt(result, "/class_with_uncertainty", "none"),
                  CountCell(NumberAt(result, "/count")),
                  SignificantCell(NumberAt(result, "/range"), 3),
                  SignificantCell(NumberAt(result, "/worst_error"), 2),
                  SignificantCell(NumberAt(result, "/worst_limit"), 3),
                  SignificantCell(NumberAt(result, "/resolution"), 2),
                  ExactCell(NumberAt(result, "/resolution_limit")), TextAt(result, "/unit", "?")});
    not_covered.clear();
    for (const Json& sentence : ListAt(result, "/not_covered"))
      if (sentence.is_string()) not_covered.push_back(PhraseOfText(sentence.get<std::string>()));
  }
  if (table.empty()) return;
  draft.AddTable(std::move(table));
  not_covered.insert(not_covered.begin(), "What the classes do not cover.");
  draft.sentences["class_note"] = JoinPhrases(not_covered);
}

void AddGaugeOutliers(const Json& strain, ResultsDraft& draft) {
  ResultTable table("gauge-outliers", "Gauges that disagree with the others",
                    {{"Gauge", ""}, {"Image", ""}, {"Deviation", "µε"}, {"U", "µε"}});
  for (const Json& outlier : ListAt(strain, "/gauge_outliers")) {
    const ResultCellPair cells = ResultCells(
        NumberAt(outlier, "/deviation_microstrain"),
        draft.acceptance.Expanded(NumberAt(outlier, "/standard_uncertainty_microstrain")), 1);
    table.AddRow({TextAt(outlier, "/column", "?"), TextAt(outlier, "/image", "?"), cells.value,
                  cells.uncertainty});
  }
  if (!table.empty()) draft.AddTable(std::move(table));
}

}  // namespace

void AddSequence(const Json& strain, ResultsDraft& draft) {
  const Json& sequence = EntryAt(strain, "/sequence");
  draft.measured["sequence"] = sequence.is_object();
  if (!sequence.is_object()) return;
  AddFacts(sequence, draft);
  AddCycles(sequence, draft);
  AddClasses(sequence, draft);
  AddGaugeOutliers(strain, draft);
  draft.sentences["warm_up"] = PhraseOfText(TextAt(sequence, "/warm_up/printed"));
}

}  // namespace telestrain
