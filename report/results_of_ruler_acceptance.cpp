#include "report/results_parts.h"

namespace telestrain {
namespace {

// The value with its U; `decimals` where there is none.
ResultCellPair EstimateCells(const Json& json, int decimals) {
  return ResultCells(NumberAt(json, "/value"), NumberAt(json, "/expanded_uncertainty"), decimals);
}

void AddTrends(const Json& acceptance, ResultsDraft& draft) {
  ResultTable table("ruler-trends", "What the length error depends on",
                    {{"On", ""},
                     {"Slope", ""},
                     {"U", ""},
                     {"Unit", ""},
                     {"Range", "mm or °"},
                     {"Effect over the range", "µm"},
                     {"U of the effect", "µm"},
                     {"Significant", ""}});
  for (const Json& trend : ListAt(acceptance, "/trends")) {
    const ResultCellPair slope = EstimateCells(EntryAt(trend, "/slope"), 3);
    const ResultCellPair effect = EstimateCells(EntryAt(trend, "/effect_um"), 3);
    table.AddRow({TextAt(trend, "/on", "?"), slope.value, slope.uncertainty,
                  TextAt(trend, "/unit", "?"), FixedCell(NumberAt(trend, "/range"), 2),
                  effect.value, effect.uncertainty,
                  EntryAt(trend, "/significant") == true ? "yes" : "no"});
  }
  if (!table.empty()) draft.AddTable(std::move(table));
}

void AddFacts(const Json& acceptance, ResultsDraft& draft) {
  ResultTable table = FactTable("ruler-acceptance", "Bias, spread and repeatability");
  const auto add = [&](const char* name, const char* pointer) {
    const Json& estimate = EntryAt(acceptance, pointer);
    const auto value = NumberAt(estimate, "/value");
    if (value)
      table.AddFact(
          name,
          UncertainCell(*value, NumberAt(estimate, "/expanded_uncertainty"), FixedCell(value, 3)),
          "µm");
  };
  const auto number = [&](const char* pointer) { return NumberAt(acceptance, pointer); };
  draft.AddPlain({"ruler_bias", "ruler", "Bias of the length error", "µm", 3},
                 number("/bias_um/value"), number("/bias_um/expanded_uncertainty"));
  draft.AddPlain({"ruler_spread", "ruler", "Spread of the length error", "µm", 3},
                 number("/spread_um/value"), number("/spread_um/expanded_uncertainty"));
  add("Bias: mean of E, U with the certificates", "/bias_um");
  add("Spread: standard deviation of E", "/spread_um");
  table.AddFact("Spread that the image noise explains",
                SignificantCell(NumberAt(acceptance, "/stated_spread_um"), 2), "µm");
  table.AddFact("Repeatability", SignificantCell(NumberAt(acceptance, "/repeatability/sd_um"), 2),
                "µm");
  table.AddFact("Degrees of freedom of it",
                CountCell(NumberAt(acceptance, "/repeatability/degrees_of_freedom")));
  draft.AddTable(std::move(table));
}

}  // namespace

void AddRulerAcceptance(const Json& acceptance, ResultsDraft& draft) {
  if (!acceptance.is_object() || ListAt(acceptance, "/images").empty()) return;
  AddTrends(acceptance, draft);
  AddFacts(acceptance, draft);
  draft.sentences["ruler_count"] = PhraseOfText(TextAt(acceptance, "/printed_count"));
  std::vector<Json> notes;
  if (const std::string method = TextAt(acceptance, "/repeatability/method"); !method.empty())
    notes.push_back(Phrase("Repeatability: {{method}}.", {{"method", PhraseOfText(method)}}));
  for (const Json& missing : ListAt(acceptance, "/not_in_budget"))
    if (missing.is_string()) notes.push_back(PhraseOfText(missing.get<std::string>()));
  draft.sentences["ruler_note"] = JoinPhrases(notes);
}

}  // namespace telestrain
