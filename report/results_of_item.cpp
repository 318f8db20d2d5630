#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "base/numbers.h"
#include "report/results_parts.h"

namespace telestrain {
namespace {

// What a certificate states of its item, in the order of ISO/IEC 17025, 7.8.2.1. `keys`: the keys
// of the session's [document] that say it, the preferred one first.
struct ItemEntry {
  const char* label;
  std::array<const char*, 4> keys;
  bool wanted;  // by a complete certificate; the others only where they apply
};

constexpr std::array kEntries{
    ItemEntry{"Report number", {"number", "report_number"}, true},
    ItemEntry{"Laboratory", {"laboratory"}, true},
    ItemEntry{"Address of the laboratory", {"laboratory_address"}, false},
    ItemEntry{"Accreditation", {"accreditation"}, false},
    ItemEntry{"Customer", {"customer"}, true},
    ItemEntry{"Address of the customer", {"customer_address"}, false},
    ItemEntry{"Item", {"item"}, true},
    ItemEntry{"Serial numbers", {"serial_numbers", "item_serial", "serial_number", "serial"}, true},
    ItemEntry{"Condition of the item", {"condition", "item_condition"}, true},
    ItemEntry{"Instrument", {"instrument"}, false},
    ItemEntry{"Serial number of the instrument", {"instrument_serial"}, false},
    ItemEntry{"Method", {"method", "procedure"}, true},
    ItemEntry{"Deviations from the method", {"deviations"}, false},
    ItemEntry{"Sampling", {"sampling"}, false},
    ItemEntry{"Place of the test", {"place", "performance_location"}, true},
    ItemEntry{"Date of receipt", {"received", "receipt_date", "date_received"}, false},
    ItemEntry{"Date of the test", {"measured", "measured_from", "test_date", "begin_date"}, true},
    ItemEntry{"End of the test", {"measured_to", "end_date"}, false},
    ItemEntry{"Date of issue", {"issued", "issue_date", "date"}, true},
    ItemEntry{"Environmental conditions", {"environment"}, true},
    ItemEntry{"Operator", {"operator"}, true},
    ItemEntry{"Traceability", {"traceability"}, false},
    ItemEntry{"Serial number of the target", {"target_serial"}, false},
    ItemEntry{"Certificate of the target", {"target_certificate", "traceability"}, true},
    ItemEntry{"Serial number of the ruler", {"ruler_serial"}, false},
    ItemEntry{"Certificate of the ruler", {"ruler_certificate", "traceability"}, true},
    ItemEntry{"Certificate of the gauges", {"gauge_certificate"}, false},
    ItemEntry{"Authorised by", {"authorised_by", "authorized_by", "authoriser", "approver"}, true}};

// The first key that is given; nullptr: none.
const char* GivenKey(const ItemEntry& entry, const Json& document) {
  for (const char* key : entry.keys)
    if (key != nullptr && document.contains(key) &&
        !TextAt(document, std::string("/") + key).empty())
      return key;
  return nullptr;
}

// Rows in the order of the standard, then what else the session says.
void AddItemTable(const Json& document, ResultsDraft& draft) {
  ResultTable table = FactTable("item", "Item, method and circumstances");
  std::set<std::string> told{"title", "revision"};  // in the title band
  for (const ItemEntry& entry : kEntries) {
    const char* key = GivenKey(entry, document);
    if (key == nullptr || !told.insert(key).second) continue;
    table.AddFact(entry.label, TextAt(document, std::string("/") + key));
  }
  for (const auto& [key, value] : document.items())
    if (told.count(key) == 0)
      table.AddFact(KeyAsLabel(key), value.is_string() ? value : Json(value.dump()));
  if (!table.empty()) draft.AddTable(std::move(table));
}

// The first page's choice; everything stands in the table "item".
void AddDocument(const Json& document, ResultsDraft& draft) {
  ResultTable table = FactTable("document", "Document");
  bool has_date = false;
  for (const std::string_view label : {"Customer", "Item", "Serial numbers", "Date of the test",
                                       "Date of issue", "Place of the test", "Operator"}) {
    const auto entry = std::find_if(kEntries.begin(), kEntries.end(),
                                    [&](const ItemEntry& e) { return e.label == label; });
    const char* key = GivenKey(*entry, document);
    const bool is_date = label.starts_with("Date");
    if (key == nullptr || (is_date && has_date)) continue;
    has_date = has_date || is_date;
    table.AddFact(entry->label, TextAt(document, std::string("/") + key));
  }
  draft.AddTable(std::move(table));
}

Json NotStated(const Json& document) {
  std::vector<Json> labels;
  for (const ItemEntry& entry : kEntries)
    if (entry.wanted && GivenKey(entry, document) == nullptr) labels.push_back(entry.label);
  if (labels.empty()) return "";
  return Phrase("Not stated in the session: {{what}}.", {{"what", JoinPhrases(labels, "; ")}});
}

Json UncertaintySentence(const Acceptance& acceptance) {
  const std::map<std::string, Json> values{{"k", FormatShortest(acceptance.coverage_factor)}};
  if (acceptance.coverage_factor == 2)
    return Phrase(
        "U is the expanded uncertainty: the standard uncertainty times the coverage factor "
        "k = {{k}}, for a normal distribution a coverage probability of about 95 % (JCGM 100).",
        values);
  return Phrase(
      "U is the expanded uncertainty: the standard uncertainty times the coverage factor k = {{k}} "
      "(JCGM 100).",
      values);
}

}  // namespace

Json RuleSentence(const Acceptance& acceptance) {
  const std::map<std::string, Json> values{{"k", FormatShortest(acceptance.coverage_factor)}};
  if (acceptance.rule == DecisionRule::kSimple)
    return Phrase(
        "Decision rule: simple acceptance; pass if |result| ≤ limit, fail otherwise. The expanded "
        "uncertainty U (k = {{k}}) is stated and not used for the decision.",
        values);
  return Phrase(
      "Decision rule: guarded after ISO 14253-1; pass if |result| + U ≤ limit, fail if "
      "|result| - U > limit, in doubt between. U is the expanded uncertainty, k = {{k}}; a result "
      "that has no U by its nature is compared directly, one whose U is missing is not decided.",
      values);
}

void AddItem(const Json& inputs, ResultsDraft& draft) {
  static const Json kNothing = Json::object();
  const Json& given = EntryAt(inputs, "/document");
  const Json& document = given.is_object() ? given : kNothing;
  AddItemTable(document, draft);
  AddDocument(document, draft);
  draft.sentences["not_stated"] = NotStated(document);
  ResultTable table("statements", "Statements", {{"On", ""}, {"Statement", ""}});
  table.AddRow({"Scope", "The results relate only to the items tested."});
  table.AddRow({"Uncertainty", UncertaintySentence(draft.acceptance)});
  table.AddRow({"Reproduction", "This report may not be reproduced except in full."});
  const char* authoriser = GivenKey(kEntries.back(), document);
  table.AddRow({"Authorised by", authoriser ? Json(TextAt(document, std::string("/") + authoriser))
                                            : Json("not stated in the session")});
  draft.AddTable(std::move(table));
}

}  // namespace telestrain
