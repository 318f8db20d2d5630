#include "app/steps.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "app/changed_results.h"
#include "app/results_folder.h"
#include "app/step_record.h"
#include "base/files.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "calibration/calibration_file.h"
#include "measurement/ruler_acceptance.h"
#include "report/template_list.h"
#include "target/corner_import.h"
#include "viz/picture_set.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// One line for every limit that is not met or could not be decided.
Status SayWhy(const fs::path& results, Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(
      const auto json,
      ReadJson(results / "results.json", "telestrain.results/1", "telestrain report"));
  try {
    for (const auto& quantity : json.at("quantities")) {
      const auto text = [&](const char* key) {
        const auto at = quantity.find(key);
        if (at == quantity.end()) return std::string("-");
        const auto& entry = at->is_object() ? at->at("printed") : *at;  // a Phrase
        return entry.is_string() ? entry.template get<std::string>() : std::string("-");
      };
      if (quantity.at("limit").is_null() || text("verdict") == "pass") continue;
      console.Say("  " + text("label") + ": " + text("printed") + " " + text("unit") + " (U " +
                  text("printed_uncertainty") + "), limit " + text("printed_limit") + ": " +
                  (text("verdict") == "-" ? "not decided" : text("verdict")));
    }
  } catch (const nlohmann::json::exception& e) {
    return BadInput((results / "results.json").string() + ": " + e.what());
  }
  return {};
}

// What the layout says of the report's content, with the earlier results that it needs.
Result<ReportScope> ScopeOf(const ReportOptions& options, const fs::path& against) {
  TELESTRAIN_ASSIGN_OR_RETURN(LayoutScope layout, ScopeOfLayout(options));
  if (layout.against_earlier && against.empty())
    return Error{ErrorKind::kUsage,
                 "the report '" + options.name +
                     "' compares with an earlier one; name its results folder or its report.pdf "
                     "with --against EARLIER"};
  if (!layout.against_earlier && !against.empty())
    return Error{ErrorKind::kUsage, "--against: the report '" + options.name +
                                        "' shows no comparison; use --template reverification"};
  layout.scope.earlier = against;
  return layout.scope;
}

std::vector<fs::path> IfGiven(const fs::path& path) {
  return path.empty() ? std::vector<fs::path>{} : std::vector{path};
}

// Leaves the session's description and its place in the results folder, and records what was read.
Status RecordOpening(const fs::path& folder, const fs::path& results, const fs::path& corners) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string description,
                              ReadFile(folder / "session.toml", kMostTextBytes));
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(results / "session.toml", description));
  std::error_code code;
  const std::string place = fs::absolute(folder, code).lexically_normal().string();
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(results / "session.path", place + "\n"));
  TELESTRAIN_ASSIGN_OR_RETURN(std::vector<std::string> files, SessionFiles(results));
  return RecordStep(results, {"open",
                              {{"corners", corners.string()}},
                              std::move(files),
                              {},
                              IfGiven(corners),
                              {"inputs.json", "session.toml"}});
}

StepRecord VerifyRecord() {
  return {"verify",
          Json::object(),
          {"session.toml", "ruler.csv"},
          {"detection.json", "calibration.json"},
          {},
          {"ruler.csv", "ruler.json"}};
}

// Recorded before the report is written, which carries the trail up to here.
StepRecord ResultsRecord(const Json& options, const fs::path& against) {
  std::error_code code;
  const fs::path earlier = fs::is_directory(against, code) ? against / "results.json" : against;
  return {"results",
          options,
          {},
          {"inputs.json", "detection.json", "calibration.json", "residuals.csv", "mrcal.json",
           "comparison.json", "ruler.json", "strain.json"},
          IfGiven(earlier),
          {"results.json", "dcc.xml"}};
}

// Every picture beside the report may stand in it, every file of the user's templates shape it.
StepRecord ReportRecord(const fs::path& results, const fs::path& templates, const Json& options) {
  StepRecord record{"report", options,
                    {},       {"results.json", "calibration.json", "residuals.csv", "dcc.xml"},
                    {},       {"report.pdf"}};
  std::error_code code;
  for (fs::recursive_directory_iterator entry(templates, code), end; !code && entry != end;
       entry.increment(code))
    if (entry->path().extension() == ".json" || entry->path().extension() == ".png")
      record.inputs_elsewhere.push_back(entry->path());
  std::sort(record.inputs_elsewhere.begin(), record.inputs_elsewhere.end());
  for (fs::directory_iterator entry(results / "pictures", code), end; !code && entry != end;
       entry.increment(code))
    if (viz::IsStandardPicture(entry->path().filename().string()))
      record.inputs.push_back("pictures/" + entry->path().filename().string());
  std::sort(record.inputs.begin(), record.inputs.end());
  return record;
}

}  // namespace

Result<ArrayCalibration> LoadCalibration(const Session& session, const fs::path& results) {
  TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results, Step::kDiagnose));
  TELESTRAIN_ASSIGN_OR_RETURN(ArrayCalibration array,
                              ReadArrayCalibration(results / "calibration.json"));
  bool same = array.views.size() == session.views.size();
  for (std::size_t i = 0; same && i < array.views.size(); ++i)
    same = array.views[i].name == session.views[i].name;
  if (!same)
    return BadInput((results / "calibration.json").string() +
                    ": has other views than the session; run 'telestrain calibrate' again");
  return array;
}

Result<Session> OpenSession(const fs::path& folder, const fs::path& results,
                            const fs::path& corners) {
  TELESTRAIN_ASSIGN_OR_RETURN(Session session, ReadSession(folder, !corners.empty()));
  std::error_code code;
  if (fs::equivalent(folder, results, code))
    return Error{ErrorKind::kUsage,
                 "--out is the session folder itself; name another folder, the "
                 "recorded session stays as it is"};
  if (!corners.empty() && fs::equivalent(corners, results / "corners.vnl", code))
    return Error{ErrorKind::kUsage,
                 "--corners is the corners.vnl of --out itself, which this step writes anew; copy "
                 "it elsewhere, or leave --corners out to use it as it is"};
  // Bad input must be known before anything in the results folder is touched.
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string inputs, InputsText(session, corners));
  TELESTRAIN_RETURN_IF_ERROR(CheckTrail(results));
  TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(results));
  TELESTRAIN_RETURN_IF_ERROR(RemoveOutputsFrom(results, Step::kDetect));
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(results / "inputs.json", inputs));
  TELESTRAIN_RETURN_IF_ERROR(RecordOpening(folder, results, corners));
  return session;
}

Result<Session> ReopenSession(const fs::path& folder, const fs::path& results) {
  TELESTRAIN_ASSIGN_OR_RETURN(const bool corners_are_given, CornersWereGiven(results));
  TELESTRAIN_ASSIGN_OR_RETURN(Session session, ReadSession(folder, corners_are_given));
  TELESTRAIN_RETURN_IF_ERROR(RequireSameInputs(session, results));
  TELESTRAIN_RETURN_IF_ERROR(CheckTrail(results));
  return session;
}

Status DetectStep(const Session& session, const fs::path& results, const fs::path& corners,
                  Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(
      const Detection detection,
      corners.empty() ? DetectAll(session, console) : ImportCorners(session, corners, console));
  TELESTRAIN_RETURN_IF_ERROR(WriteDetection(session, detection, results));
  std::size_t found = 0, crosses = 0;
  for (const BoardObservation& board : detection.boards) found += board.rejected_because.empty();
  for (const CrossObservation& cross : detection.crosses) crosses += cross.center.has_value();
  console.Say("detect     " + std::to_string(found) + " of " +
              CountText(detection.boards.size(), "board view") + " used, " +
              std::to_string(crosses) + " of " + std::to_string(detection.crosses.size()) +
              " ruler crosses");
  for (const BoardObservation& board : detection.boards)
    if (!board.rejected_because.empty())
      console.Note("  not used: " + board.image + " " + board.view + ": " + board.rejected_because);
  return RecordStep(results, {"detect",
                              {{"corners", corners.string()}},
                              TargetFiles(session),
                              {"inputs.json"},
                              IfGiven(corners),
                              {"corners.vnl", "corner_covariances.csv", "detection.json"}});
}

Status VerifyStep(const Session& session, const fs::path& results, Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(const ArrayCalibration array, LoadCalibration(session, results));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<CrossObservation> crosses,
                              ReadDetectedCrosses(results));
  TELESTRAIN_RETURN_IF_ERROR(RemoveOutputsFrom(results, Step::kVerify));
  if (session.ruler_images.empty()) {
    console.Say("verify     the session has no ruler images");
    return RecordStep(results, VerifyRecord());
  }
  const std::vector<RulerLength> lengths = MeasureRuler(session, array, crosses);
  TELESTRAIN_ASSIGN_OR_RETURN(const auto made_from,
                              HashesOf(results, {"detection.json", "calibration.json"}));
  TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(results / "ruler.csv", RulerCsv(lengths)));
  const RulerAcceptance acceptance = AcceptRuler(session, array, lengths);
  auto json = RulerJson(session, lengths, made_from);
  json["acceptance"] = RulerAcceptanceJson(acceptance, lengths, session.acceptance.coverage_factor);
  TELESTRAIN_RETURN_IF_ERROR(WriteJson(results / "ruler.json", json));
  const RulerSummary summary = Summarise(lengths);
  if (summary.count == 0)
    console.Say("verify     none of " + CountText(lengths.size(), "ruler image") +
                " could be measured");
  else
    console.Say("verify     " + CountText(static_cast<std::size_t>(summary.count), "ruler length") +
                ", error mean " + FormatFixed(summary.mean_error_um, 3) + " um, sd " +
                FormatFixed(summary.sd_error_um, 3) + " um, largest " +
                FormatFixed(summary.max_abs_error_um, 3) + " um");
  for (const RulerLength& length : lengths)
    if (!length.rejected_because.empty())
      console.Note("  not used: " + length.image + ": " + length.rejected_because);
  return RecordStep(results, VerifyRecord());
}

Result<int> ReportStep(const fs::path& results, const ReportChoices& choices, Console& console) {
  TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results, Step::kReport));
  std::error_code code;
  if (!fs::exists(results / "calibration.json", code))
    return BadInput((results / "calibration.json").string() +
                    ": does not exist; run 'telestrain calibrate' first");
  std::set<std::string> untranslated;
  const ReportOptions options{choices.templates,
                              choices.layout,
                              choices.language,
                              choices.level,
                              [&](const std::string& text) { untranslated.insert(text); },
                              [&](const std::string& note) { console.Note("  " + note); }};
  // A wrong layout must be known before an older report goes.
  TELESTRAIN_ASSIGN_OR_RETURN(const ReportScope scope, ScopeOf(options, choices.against));
  for (const std::string& change : ChangesSinceRecorded(results)) console.Warn(change);
  TELESTRAIN_RETURN_IF_ERROR(RemoveOutputsFrom(results, Step::kReport));
  TELESTRAIN_ASSIGN_OR_RETURN(const Outcome outcome, MakeResults(results, scope));
  Json recorded{{"template", choices.layout},
                {"templates", choices.templates.string()},
                {"against", choices.against.string()}};
  TELESTRAIN_RETURN_IF_ERROR(RecordStep(results, ResultsRecord(recorded, choices.against)));
  TELESTRAIN_RETURN_IF_ERROR(WriteReport(results, options));
  recorded["language"] = choices.language;
  recorded["archive-level"] = choices.level == ArchiveLevel::k1b ? "1b" : "3a";
  TELESTRAIN_RETURN_IF_ERROR(
      RecordStep(results, ReportRecord(results, choices.templates, recorded)));
  console.Say("report     " +
              fs::absolute(results / "report.pdf", code).lexically_normal().string());
  console.Say("verdict    " + outcome.verdict);
  if (!untranslated.empty())
    console.Note("  printed in English for want of a translation: " +
                 CountText(untranslated.size(), "text") + ", the first is '" +
                 *untranslated.begin() + "'");
  TELESTRAIN_RETURN_IF_ERROR(SayWhy(results, console));
  return outcome.accepted ? 0 : 1;
}

}  // namespace telestrain
