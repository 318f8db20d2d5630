#include <cmath>

#include "report/calibration_changes.h"
#include "report/results_parts.h"

namespace telestrain {
namespace {

// How a change compares with its U; En = |change| / U (ISO 13528 for two results).
struct Change {
  double value = 0;
  std::optional<double> expanded_uncertainty;

  std::optional<double> En() const {
    if (!expanded_uncertainty || !(*expanded_uncertainty > 0)) return {};
    return std::abs(value) / *expanded_uncertainty;
  }
  bool IsBeyond() const { return En().value_or(0) > 1; }
  const char* Words() const {
    if (!En()) return "no uncertainty to judge it by";
    return IsBeyond() ? "changed by more than U" : "within U";
  }
};

struct Tally {
  int judged = 0;
  std::vector<Json> beyond;  // labels

  ChangeCount Counted() const { return {judged, static_cast<int>(beyond.size())}; }
  void Count(const Json& label, const Change& change) {
    if (change.En()) ++judged;
    if (change.IsBeyond()) beyond.push_back(label);
  }
};

// An En far beyond 1 says no more than that it is.
Json EnCell(const Change& change) {
  constexpr double kMostPrinted = 100;
  Json cell = FixedCell(change.En(), 2);
  if (change.En().value_or(0) > kMostPrinted) cell["printed"] = "> 100";
  return cell;
}

// The earlier U as it would be with the coverage factor of now.
std::optional<double> EarlierU(const Json& before, double coverage_factor) {
  const auto u = NumberAt(before, "/expanded_uncertainty");
  const auto k = NumberAt(before, "/coverage_factor");
  if (!u || *u <= 0) return {};
  return k && *k > 0 ? *u * coverage_factor / *k : *u;
}

Change ChangeOf(const Json& before, const Quantity& now, double coverage_factor) {
  Change change;
  change.value = *now.value - *NumberAt(before, "/value");
  const auto then = EarlierU(before, coverage_factor);
  if (then && now.expanded_uncertainty && *now.expanded_uncertainty > 0)
    change.expanded_uncertainty = std::hypot(*then, *now.expanded_uncertainty);
  return change;
}

Json PrintedCell(const Json& quantity, const char* value, const char* printed) {
  return {{"value", EntryAt(quantity, value)}, {"printed", TextAt(quantity, printed, kNoValue)}};
}

void AddRow(const Json& before, const Quantity& now, const Change& change, double coverage_factor,
            ResultTable& table) {
  const Json after = QuantityJson(now, coverage_factor);
  const ResultCellPair cells = ResultCells(change.value, change.expanded_uncertainty, now.decimals);
  table.AddRow({now.label, PrintedCell(before, "/value", "/printed"),
                PrintedCell(before, "/expanded_uncertainty", "/printed_uncertainty"),
                PrintedCell(after, "/value", "/printed"),
                PrintedCell(after, "/expanded_uncertainty", "/printed_uncertainty"), cells.value,
                cells.uncertainty, EnCell(change), now.unit, change.Words()});
  table.LinkLastRow(now.section);
}

Json SentenceOf(const Tally& tally, const char* none, const char* some) {
  const std::map<std::string, Json> values{{"judged", std::to_string(tally.judged)},
                                           {"changed", std::to_string(tally.beyond.size())},
                                           {"names", JoinPhrases(tally.beyond, "; ")}};
  return Phrase(tally.beyond.empty() ? none : some, values);
}

void AddEarlierFacts(const EarlierResults& earlier, ResultsDraft& draft) {
  ResultTable table = FactTable("earlier", "Earlier report");
  const auto add = [&](const char* name, std::initializer_list<const char*> pointers) {
    for (const char* pointer : pointers)
      if (const std::string text = TextAt(earlier.results, pointer); !text.empty())
        return table.AddFact(name, text);
  };
  add("Report number", {"/document/number", "/document/report_number"});
  add("Revision", {"/document/revision"});
  add("Date", {"/document/issued", "/document/issue_date", "/document/date"});
  add("Verdict", {"/verdict"});
  table.AddFact("File", earlier.file);
  table.AddFact("SHA-256", earlier.sha256);
  draft.AddTable(std::move(table));
}

ChangeCount AddQuantityChanges(const EarlierResults& earlier, ResultsDraft& draft) {
  ResultTable table("changes", "Changes since the earlier report",
                    {{"Quantity", ""},
                     {"Earlier", ""},
                     {"U", ""},
                     {"Now", ""},
                     {"U", ""},
                     {"Change", ""},
                     {"U of the change", ""},
                     {"En", ""},
                     {"Unit", ""},
                     {"Judgement", ""}});
  Tally tally;
  for (const Quantity& now : draft.quantities) {
    const Json& before = FindBy(ListAt(earlier.results, "/quantities"), "id", now.id);
    const bool comparable = NumberAt(before, "/value") && now.value &&
                            TextAt(before, "/unit") == now.unit && !now.is_drawing_aid;
    if (!comparable) continue;
    const Change change = ChangeOf(before, now, draft.acceptance.coverage_factor);
    AddRow(before, now, change, draft.acceptance.coverage_factor, table);
    tally.Count(now.label, change);
  }
  draft.sentences["changes"] = SentenceOf(
      tally, "None of the {{judged}} quantities with an uncertainty changed by more than U.",
      "Of the {{judged}} quantities with an uncertainty {{changed}} changed by more than U: "
      "{{names}}.");
  draft.sentences["changes_note"] =
      "U of a change is the root of the sum of the squares of both expanded uncertainties, and "
      "En = |change| / U of the change; a change is within U when En ≤ 1. What both reports share, "
      "such as one certificate, is counted twice, which hides small changes rather than feigning "
      "them. A quantity without U is not judged.";
  if (!table.empty()) draft.AddTable(std::move(table));
  return tally.Counted();
}

// The earlier report by its number, else its file, and its date.
Json NameOf(const EarlierResults& earlier) {
  const std::string number =
      TextAt(earlier.results, "/document/number",
             TextAt(earlier.results, "/document/report_number", earlier.file));
  const std::string date =
      TextAt(earlier.results, "/document/issued", TextAt(earlier.results, "/document/date"));
  if (date.empty()) return number;
  return Phrase("{{number}} of {{date}}", {{"number", number}, {"date", date}});
}

}  // namespace

ChangeCount AddChanges(const EarlierResults& earlier, ResultsDraft& draft) {
  AddEarlierFacts(earlier, draft);
  return AddQuantityChanges(earlier, draft);
}

void AddComparedWith(const EarlierResults& earlier, const ChangeCount& quantities,
                     const ChangeCount& calibration, ResultsDraft& draft) {
  const auto sentence = [&](const char* pattern, const ChangeCount& count) {
    return Phrase(pattern, {{"report", NameOf(earlier)},
                            {"changed", std::to_string(count.changed)},
                            {"judged", std::to_string(count.judged)}});
  };
  std::vector<Json> sentences{
      sentence("Compared with {{report}}: {{changed}} of {{judged}} values changed by more than "
               "their uncertainty.",
               quantities)};
  if (calibration.judged > 0)
    sentences.push_back(
        sentence("In the instrument {{changed}} of {{judged}} values moved by more "
                 "than their uncertainty.",
                 calibration));
  draft.sentences["compared_with"] = JoinPhrases(sentences);
}

ChangeCount AddCalibrationChanges(const std::vector<CalibrationChange>& changes,
                                  ResultsDraft& draft) {
  if (changes.empty()) return {};
  ResultTable table(
      "changes-calibration", "What moved in the instrument",
      {{"Quantity", ""}, {"Change", ""}, {"U", ""}, {"En", ""}, {"Unit", ""}, {"Judgement", ""}});
  Tally tally;
  for (const CalibrationChange& moved : changes) {
    const Change change{moved.value, draft.acceptance.Expanded(moved.standard_uncertainty)};
    const ResultCellPair cells = ResultCells(change.value, change.expanded_uncertainty, 2);
    table.AddRow({moved.quantity, cells.value, cells.uncertainty, EnCell(change), moved.unit,
                  change.Words()});
    tally.Count(moved.quantity, change);
  }
  draft.sentences["changes_calibration"] =
      tally.judged == 0
          ? Json("")
          : SentenceOf(tally,
                       "Calibration: none of the {{judged}} changes with an uncertainty is larger "
                       "than U.",
                       "Calibration: of the {{judged}} changes with an uncertainty {{changed}} are "
                       "larger than U: {{names}}.");
  draft.AddTable(std::move(table));
  return tally.Counted();
}

}  // namespace telestrain
