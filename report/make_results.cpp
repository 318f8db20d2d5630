#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "report/acceptance_report.h"
#include "report/dcc/dcc.h"
#include "report/results_parts.h"
#include "report/results_scope.h"

namespace telestrain {
namespace {

struct Parts {
  // Null when the file does not exist.
  Json inputs, detection, calibration, comparison, diagnosis, ruler, strain;
};

Result<Json> ReadOptional(const std::filesystem::path& path, const std::string& schema,
                          const std::string& maker) {
  if (!std::filesystem::exists(path)) return Json(nullptr);
  return ReadJson(path, schema, maker);
}

Result<Parts> ReadParts(const std::filesystem::path& results) {
  Parts parts;
  TELESTRAIN_ASSIGN_OR_RETURN(
      parts.inputs, ReadJson(results / "inputs.json", "telestrain.inputs/1", "telestrain detect"));
  TELESTRAIN_ASSIGN_OR_RETURN(
      parts.detection,
      ReadOptional(results / "detection.json", "telestrain.detection/1", "telestrain detect"));
  TELESTRAIN_ASSIGN_OR_RETURN(parts.calibration,
                              ReadOptional(results / "calibration.json", "telestrain.calibration/1",
                                           "telestrain calibrate"));
  TELESTRAIN_ASSIGN_OR_RETURN(
      parts.comparison,
      ReadOptional(results / "comparison.json", "telestrain.comparison/1", "telestrain calibrate"));
  TELESTRAIN_ASSIGN_OR_RETURN(
      parts.diagnosis,
      ReadOptional(results / "mrcal.json", "telestrain.mrcal/1", "telestrain diagnose"));
  TELESTRAIN_ASSIGN_OR_RETURN(
      parts.ruler, ReadOptional(results / "ruler.json", "telestrain.ruler/1", "telestrain verify"));
  TELESTRAIN_ASSIGN_OR_RETURN(
      parts.strain,
      ReadOptional(results / "strain.json", "telestrain.strain/1", "telestrain measure"));
  return parts;
}

// Limits that were asked for and could not be decided, so that a pass never hides them.
bool IsUndecided(const Quantity& quantity) {
  return quantity.limit && quantity.verdict.value_or(Verdict::kUndecided) == Verdict::kUndecided;
}

Json UndecidedSentence(const ResultsDraft& draft) {
  std::vector<Json> labels;
  for (const Quantity& quantity : draft.quantities)
    if (IsUndecided(quantity)) labels.push_back(quantity.label);
  if (labels.empty()) return "";
  return Phrase("Not decided although a limit is set: {{quantities}}.",
                {{"quantities", JoinPhrases(labels, "; ")}});
}

ResultTable SummaryTable(const ResultsDraft& draft) {
  ResultTable table(
      "summary", "Summary of results",
      {{"Quantity", ""},
       {"Result", ""},
       {Phrase("U (k = {{k}})", {{"k", FormatShortest(draft.acceptance.coverage_factor)}}), ""},
       {"Limit", ""},
       {"Unit", ""},
       {"Verdict", ""}});
  for (const Quantity& quantity : draft.quantities) {
    if (!quantity.in_summary) continue;
    const Json json = QuantityJson(quantity, draft.acceptance.coverage_factor);
    table.AddRow(
        {quantity.label,
         {{"value", json["value"]}, {"printed", json["printed"]}},
         {{"value", json["expanded_uncertainty"]}, {"printed", json["printed_uncertainty"]}},
         {{"value", json["limit"]}, {"printed", json["printed_limit"]}},
         quantity.unit,
         VerdictCell(quantity.verdict.value_or(Verdict::kUndecided))});
    table.LinkLastRow(quantity.section);
  }
  return table;
}

// Every limit's verdict with its margin in words.
ResultTable DecisionsTable(const ResultsDraft& draft) {
  ResultTable table("decisions", "Decisions", {{"Quantity", ""}, {"Decision", ""}});
  for (const Quantity& quantity : draft.quantities) {
    if (!quantity.in_summary || !quantity.limit || quantity.is_check) continue;
    table.AddRow({quantity.label, DecisionWords(quantity, draft.acceptance)});
    table.LinkLastRow(quantity.section);
  }
  return table;
}

// The files this report was made from, as they are now.
Result<ResultTable> EvidenceTable(const std::filesystem::path& results) {
  ResultTable table("result-files", "Files of the results folder",
                    {{"File", ""}, {"Size", "bytes"}, {"SHA-256", ""}});
  for (const char* name : {"inputs.json", "detection.json", "calibration.json", "residuals.csv",
                           "mrcal.json", "ruler.json", "strain.json"}) {
    if (!std::filesystem::exists(results / name)) continue;
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes,
                                ReadFile(results / name, kMostResultBytes));
    table.AddRow({name, CountCell(static_cast<double>(bytes.size())), Sha256Hex(bytes)});
  }
  return table;
}

Json ResultsJson(ResultsDraft draft, const ReportScope& scope, const Json& inputs,
                 const std::string& verdict) {
  Json json = {{"schema", "telestrain.results/1"},
               {"report", {{"layout", scope.name}, {"sections", scope.sections}}},
               {"verdict", verdict},
               {"title", TextAt(inputs, "/title")},
               {"document", EntryAt(inputs, "/document")},
               {"decision",
                {{"rule", draft.acceptance.rule == DecisionRule::kSimple ? "simple" : "guarded"},
                 {"coverage_factor", draft.acceptance.coverage_factor},
                 {"printed", RuleSentence(draft.acceptance)},
                 {"printed_undecided", UndecidedSentence(draft)}}},
               {"measured", draft.measured},
               {"diagnosis", std::move(draft.diagnosis)},
               {"sentences", std::move(draft.sentences)},
               {"quantities", Json::array()},
               {"tables", std::move(draft.tables)},
               {"inputs", inputs}};
  if (!json["document"].is_object()) json["document"] = Json::object();
  for (const Quantity& quantity : draft.quantities)
    json["quantities"].push_back(QuantityJson(quantity, draft.acceptance.coverage_factor));
  return json;
}

// Only what was measured can be accepted, even where nothing had to be decided. A limit that could
// not be decided must not hide behind others that passed.
Outcome OutcomeOf(const ResultsDraft& draft) {
  std::vector<Verdict> verdicts;
  for (const Quantity& quantity : draft.quantities)
    if (!quantity.is_check || quantity.verdict != Verdict::kPass)
      verdicts.push_back(quantity.verdict.value_or(Verdict::kUndecided));
  Outcome outcome{VerdictName(OverallVerdict(verdicts)), false};
  const bool all_decided =
      std::none_of(draft.quantities.begin(), draft.quantities.end(), IsUndecided);
  if (outcome.verdict == "pass" && !all_decided) outcome.verdict = "undecided";
  const bool measured = std::any_of(draft.measured.begin(), draft.measured.end(),
                                    [](const Json& section) { return section == true; });
  const bool nothing_to_decide = outcome.verdict == "undecided" && all_decided;
  outcome.accepted = measured && (outcome.verdict == "pass" || nothing_to_decide);
  return outcome;
}

// The parts of the sections that the layout is about; the others stay out as if they did not exist.
void AddSections(const Parts& parts, const ReportScope& scope, ResultsDraft& draft) {
  static const Json kNothing;
  const auto part = [&](const char* section, const Json& json) -> const Json& {
    return IsInScope(scope, section) ? json : kNothing;
  };
  const Json& ruler = part("ruler", parts.ruler);
  const Json& strain = part("strain", parts.strain);
  AddCalibration(parts.calibration, parts.detection, draft);
  AddDiagnosis(part("diagnosis", parts.diagnosis), parts.ruler, draft);
  AddRuler(ruler, draft);
  AddStrain(strain, draft);
  AddCorrelation(parts.inputs, parts.calibration, strain, draft);
  AddBudgets(part("calibration", parts.calibration), ruler, strain, draft);
  LeaveScope(scope, draft);
}

// What moved since the earlier calibration. comparison.json counts when it compares with that very
// file; else the two are compared here.
ChangeCount AddInstrumentChanges(const Parts& parts, const EarlierResults& earlier,
                                 const std::string& calibration_sha256, ResultsDraft& draft) {
  if (!earlier.calibration_sha256.empty() && earlier.calibration_sha256 == calibration_sha256) {
    draft.sentences["changes_calibration"] = "Both reports use the same calibration.";
    return {};
  }
  const bool same = TextAt(parts.comparison, "/compared_with/sha256") == earlier.calibration_sha256;
  return AddCalibrationChanges(same ? ChangesOfComparison(parts.comparison)
                                    : ChangesOfCalibrations(earlier.calibration, parts.calibration),
                               draft);
}

Status AddEarlier(const Parts& parts, const ReportScope& scope, const Json& evidence,
                  ResultsDraft& draft) {
  draft.measured["changes"] = !scope.earlier.empty();
  if (scope.earlier.empty()) {
    AddCalibrationChanges(ChangesOfComparison(parts.comparison), draft);
    return {};
  }
  TELESTRAIN_ASSIGN_OR_RETURN(const EarlierResults earlier, ReadEarlierResults(scope.earlier));
  TELESTRAIN_RETURN_IF_ERROR(RequireComparable(earlier, scope.earlier.string(), parts.inputs,
                                               parts.calibration, evidence));
  const ChangeCount quantities = AddChanges(earlier, draft);
  std::string calibration_sha256;
  for (const Json& row : ListAt(evidence, "/rows"))
    if (TextAt(row, "/0") == "calibration.json") calibration_sha256 = TextAt(row, "/2");
  const ChangeCount moved = AddInstrumentChanges(parts, earlier, calibration_sha256, draft);
  AddComparedWith(earlier, quantities, moved, draft);
  return {};
}

}  // namespace

Outcome OutcomeIn(const Json& results) {
  const Json measured = EntryAt(results, "/measured");
  const bool any = std::any_of(measured.begin(), measured.end(),
                               [](const Json& section) { return section == true; });
  Outcome outcome{TextAt(results, "/verdict"), false};
  const bool nothing_to_decide =
      outcome.verdict == "undecided" && EntryAt(results, "/decision/printed_undecided") == "";
  outcome.accepted = any && (outcome.verdict == "pass" || nothing_to_decide);
  return outcome;
}

Result<Outcome> MakeResults(const std::filesystem::path& results, const ReportScope& scope,
                            const std::function<Status()>& before_writing) {
  TELESTRAIN_RETURN_IF_ERROR(CheckScope(scope));
  TELESTRAIN_ASSIGN_OR_RETURN(const Parts parts, ReadParts(results));
  ResultsDraft draft;
  draft.acceptance = ReadAcceptance(parts.inputs);
  ApplyLimits(scope, draft);
  AddSections(parts, scope, draft);
  const Outcome outcome = OutcomeOf(draft);
  draft.AddTable(SummaryTable(draft));
  ResultTable decisions = DecisionsTable(draft);
  if (!decisions.empty()) draft.AddTable(std::move(decisions));
  AddItem(parts.inputs, draft);
  AddInputs(parts.inputs, parts.strain, draft);
  TELESTRAIN_ASSIGN_OR_RETURN(ResultTable evidence, EvidenceTable(results));
  draft.AddTable(std::move(evidence));
  TELESTRAIN_RETURN_IF_ERROR(AddEarlier(parts, scope, draft.tables.back(), draft));
  const Json json = ResultsJson(std::move(draft), scope, parts.inputs, outcome.verdict);
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string dcc, MakeDcc(json, parts.calibration));
  TELESTRAIN_RETURN_IF_ERROR(before_writing());
  TELESTRAIN_RETURN_IF_ERROR(WriteJson(results / "results.json", json));
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(results / "dcc.xml", dcc));
  return outcome;
}

}  // namespace telestrain
