#include "report/results_parts.h"
#include "report/rounding.h"

namespace telestrain {
namespace {

// The value with its U; `decimals` where there is none.
ResultCellPair EstimateCells(const Json& json, int decimals) {
  return ResultCells(NumberAt(json, "/value"), NumberAt(json, "/expanded_uncertainty"), decimals);
}

// As EstimateCells, with up to two more digits while the value would print as zero: next to its
// effect that reads like a contradiction.
ResultCellPair TrendCells(const Json& json) {
  constexpr int kMoreDigits = 2;
  ResultCellPair cells = EstimateCells(json, 3);
  const auto value = NumberAt(json, "/value"), u = NumberAt(json, "/expanded_uncertainty");
  const auto decimals = u ? DecimalsOfColumn({*u}) : std::nullopt;
  for (int more = 1; decimals && value && *value != 0 && more <= kMoreDigits; ++more) {
    const std::string printed = TextAt(cells.value, "/printed");
    if (printed.find_first_of("123456789") != std::string::npos) break;
    cells.value["printed"] = PrintAtDecimals(*value, *decimals + more);
    cells.uncertainty["printed"] = PrintAtDecimals(*u, *decimals + more);
  }
  return cells;
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
    const ResultCellPair slope = TrendCells(EntryAt(trend, "/slope"));
    const ResultCellPair effect = TrendCells(EntryAt(trend, "/effect_um"));
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
