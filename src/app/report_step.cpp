#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "app/changed_results.h"
#include "app/results_folder.h"
#include "app/step_record.h"
#include "app/steps.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "report/template_list.h"
#include "viz/picture_set.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The verdict, and one line for every limit that is not met or could not be decided. The value is
// the exit code.
Result<int> SayVerdict(const fs::path& results, Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(
      const auto json,
      ReadJson(results / "results.json", "telestrain.results/1", "telestrain report"));
  const Outcome outcome = OutcomeIn(json);
  console.Say("verdict    " + outcome.verdict);
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
    return BadInput((results / "results.json").string() + ": " + JsonProblem(e));
  }
  return outcome.accepted ? 0 : 1;
}

// What the layout says of the report's content, with the earlier results that it needs.
Result<LayoutScope> ScopeOf(const ReportOptions& options, const fs::path& against,
                            const fs::path& results) {
  TELESTRAIN_ASSIGN_OR_RETURN(LayoutScope layout, ScopeOfLayout(options));
  if (layout.against_earlier && against.empty())
    return Error{ErrorKind::kUsage,
                 "the report '" + options.name +
                     "' compares with an earlier one; name its results folder or its report.pdf "
                     "with --against EARLIER"};
  if (!layout.against_earlier && !against.empty())
    return Error{ErrorKind::kUsage, "--against: the report '" + options.name +
                                        "' shows no comparison; use --template reverification"};
  std::error_code code;
  if (fs::equivalent(against, results, code))
    return BadInput(against.string() +
                    ": is the results folder itself; name an earlier one with --against");
  layout.scope.earlier = against;
  return layout;
}

Json OptionsOfResults(const ReportChoices& choices) {
  return {{"template", choices.layout},
          {"templates", choices.templates.string()},
          {"against", choices.against.string()}};
}

// Recorded before the report is written, which carries the trail up to here.
StepRecord ResultsRecord(const ReportChoices& choices) {
  std::error_code code;
  const bool is_folder = fs::is_directory(choices.against, code);
  return {"results",
          OptionsOfResults(choices),
          {},
          {"inputs.json", "detection.json", "calibration.json", "residuals.csv", "mrcal.json",
           "comparison.json", "ruler.json", "strain.json"},
          IfGiven(is_folder ? choices.against / "results.json" : choices.against),
          {"results.json", "dcc.xml"}};
}

// Every file of the user's templates shapes the report.
StepRecord ReportRecord(const fs::path& results, const ReportChoices& choices,
                        const std::set<std::string>& pictures) {
  Json options = OptionsOfResults(choices);
  options["language"] = choices.language;
  options["archive-level"] = choices.level == ArchiveLevel::k1b ? "1b" : "3a";
  StepRecord record{"report", std::move(options),
                    {},       {"results.json", "calibration.json", "residuals.csv", "dcc.xml"},
                    {},       {"report.pdf"}};
  std::error_code code;
  for (fs::recursive_directory_iterator entry(choices.templates, code), end; !code && entry != end;
       entry.increment(code))
    if (entry->path().extension() == ".json" || entry->path().extension() == ".png")
      record.inputs_elsewhere.push_back(entry->path());
  std::sort(record.inputs_elsewhere.begin(), record.inputs_elsewhere.end());
  // A picture that the layout names and that no step drew is the user's own.
  for (const std::string& picture : pictures)
    if (viz::IsStandardPicture(picture))
      record.inputs.push_back("pictures/" + picture);
    else if (fs::exists(results / "pictures" / picture, code))
      record.inputs_elsewhere.push_back(results / "pictures" / picture);
  std::sort(record.inputs.begin(), record.inputs.end());
  return record;
}

// A report may be made without pictures; nobody should find that out when reading it.
void WarnOfNoPictures(const fs::path& results, const std::set<std::string>& pictures,
                      Console& console) {
  std::error_code code;
  const bool has_one = std::any_of(pictures.begin(), pictures.end(), [&](const auto& picture) {
    return fs::exists(results / "pictures" / picture, code);
  });
  if (!pictures.empty() && !has_one)
    console.Warn("the report shows no pictures, since none are drawn; run 'telestrain render " +
                 results.string() + "', then this step again");
}

std::string PlaceOfReport(const fs::path& results) {
  std::error_code code;
  return fs::absolute(results / "report.pdf", code).lexically_normal().string();
}

// Whether both results and report are; then says so. Pictures that were drawn since to be looked at
// are no reason to make it anew.
Result<bool> ReportIsKept(const fs::path& results, const ReportChoices& choices,
                          const std::set<std::string>& pictures, Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(const bool decided, IsDone(results, ResultsRecord(choices)));
  if (!decided) return false;
  TELESTRAIN_ASSIGN_OR_RETURN(bool done, IsDone(results, ReportRecord(results, choices, pictures)));
  if (!done) {
    std::set<std::string> always;
    for (const viz::PictureKind& kind : viz::PictureKinds())
      if (kind.in_report) always.insert(std::string(kind.name) + ".png");
    TELESTRAIN_ASSIGN_OR_RETURN(done, IsDone(results, ReportRecord(results, choices, always)));
  }
  if (done)
    console.Say("report     " + PlaceOfReport(results) +
                ", kept: made from the same inputs, options and program");
  return done;
}

}  // namespace

Result<int> ReportStep(const fs::path& results, const ReportChoices& choices, Console& console,
                       Earlier earlier) {
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
  TELESTRAIN_ASSIGN_OR_RETURN(const LayoutScope layout, ScopeOf(options, choices.against, results));
  if (earlier == Earlier::kKept) {
    TELESTRAIN_ASSIGN_OR_RETURN(const bool kept,
                                ReportIsKept(results, choices, layout.pictures, console));
    if (kept) return SayVerdict(results, console);
  }
  for (const std::string& change : ChangesSinceRecorded(results, kMeasuredFiles))
    console.Warn(change + "; 'telestrain audit verify' will fail");
  WarnOfNoPictures(results, layout.pictures, console);
  // What cannot be read or compared must be known before an older report goes.
  TELESTRAIN_RETURN_IF_ERROR(MakeResults(
      results, layout.scope, [&] { return RemoveOutputsFrom(results, Step::kReport); }));
  TELESTRAIN_RETURN_IF_ERROR(RecordStep(results, ResultsRecord(choices)));
  TELESTRAIN_RETURN_IF_ERROR(WriteReport(results, options));
  TELESTRAIN_RETURN_IF_ERROR(RecordStep(results, ReportRecord(results, choices, layout.pictures)));
  console.Say("report     " + PlaceOfReport(results));
  if (!untranslated.empty())
    console.Note("  printed in English for want of a translation: " +
                 CountText(untranslated.size(), "text") + ", the first is '" +
                 *untranslated.begin() + "'");
  return SayVerdict(results, console);
}

}  // namespace telestrain
