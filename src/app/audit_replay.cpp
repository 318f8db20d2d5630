#include "app/audit_replay.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <ctime>
#include <map>
#include <sstream>

#include "app/command.h"
#include "app/step_options.h"
#include "base/files.h"
#include "base/numbers.h"
#include "base/signals.h"
#include "base/utf8.h"
#include "report/audit/file_difference.h"
#include "report/audit/repeatable.h"
#include "report/audit/step_order.h"
#include "report/audit/trail_files.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

using MakeCommand = std::unique_ptr<Command> (*)();

// Verbs of the entries, and whether they take the session.
struct Verb {
  MakeCommand make;
  bool takes_session;
};
const std::map<std::string, Verb> kVerbs = {
    {"detect", {&MakeDetectCommand, true}},      {"calibrate", {&MakeCalibrateCommand, true}},
    {"verify", {&MakeVerifyCommand, true}},      {"measure", {&MakeMeasureCommand, true}},
    {"diagnose", {&MakeDiagnoseCommand, false}}, {"render", {&MakeRenderCommand, false}},
    {"report", {&MakeReportCommand, false}},     {"review", {&MakeReviewCommand, false}},
    {"export", {&MakeExportCommand, false}}};

// A folder that goes with the object, unless it is to be kept.
class WorkFolder {
 public:
  static Result<WorkFolder> Make(const fs::path& keep) {
    WorkFolder folder;
    folder.stays_ = !keep.empty();
    std::string pattern = (fs::temp_directory_path() / "telestrain_replay_XXXXXX").string();
    if (!folder.stays_ && !::mkdtemp(pattern.data()))
      return OutputFailed(pattern + ": cannot be made; name a folder with --keep");
    folder.path_ = folder.stays_ ? keep : fs::path(pattern);
    TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(folder.path_));
    if (fs::is_empty(folder.path_)) return folder;
    return Error{ErrorKind::kUsage,
                 "--keep " + keep.string() + ": is not empty; name a new folder"};
  }
  WorkFolder(WorkFolder&& other) noexcept
      : path_(std::exchange(other.path_, {})), stays_(other.stays_) {}
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    if (!stays_ && !path_.empty()) fs::remove_all(path_, ignored);
  }
  fs::path Results() const { return path_ / "results"; }
  fs::path Elsewhere() const { return path_ / "elsewhere"; }

 private:
  WorkFolder() = default;
  fs::path path_;
  bool stays_ = false;
  const AtSignal remove_{[this](int) {
    std::error_code ignored;
    if (!stays_ && !path_.empty()) fs::remove_all(path_, ignored);
    return AfterSignal::kEnd;
  }};
};

// The declared time of an entry that comes from no document: SOURCE_DATE_EPOCH was set then.
void SetSurroundings(const std::string& time) {
  std::tm parts{};
  const bool is_epoch = ::strptime(time.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts) != nullptr;
  if (is_epoch)
    ::setenv("SOURCE_DATE_EPOCH", std::to_string(::timegm(&parts)).c_str(), 1);
  else
    ::unsetenv("SOURCE_DATE_EPOCH");
}

class Replay {
 public:
  Replay(const ReplayChoices& choices, fs::path session, std::vector<AuditEntry> entries,
         const WorkFolder& work)
      : choices_(choices),
        session_(std::move(session)),
        entries_(std::move(entries)),
        work_(work) {}

  // Empty when all is equal, else the first difference in words.
  Result<std::string> Run() {
    std::size_t first = 0;
    for (std::size_t i = 0; i < entries_.size(); ++i)
      if (entries_[i].type == "open") first = i;
    TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(work_.Results()));
    TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(work_.Elsewhere()));
    std::vector<std::size_t> made;  // since a verb was last run: one run may make two entries
    for (std::size_t i = first; i < entries_.size(); ++i) {
      made.push_back(i);
      if (!kVerbs.contains(entries_[i].type)) continue;
      TELESTRAIN_RETURN_IF_ERROR(Seed(i));
      SetSurroundings(entries_[i].time);
      TELESTRAIN_RETURN_IF_ERROR(Repeat(entries_[i]));
      for (const std::size_t entry : made) {
        TELESTRAIN_ASSIGN_OR_RETURN(const std::string difference, Compare(entry));
        if (!difference.empty()) return difference;
      }
      made.clear();
      ++steps_;
    }
    return std::string();
  }

  std::size_t steps() const { return steps_; }
  std::size_t files() const { return files_; }

 private:
  // The chain before the entry, so that what a step adds and a report carries is the same.
  Status Seed(std::size_t count) const {
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string text,
                                ReadFile(choices_.results / "audit.jsonl", kMostLogBytes));
    std::size_t end = 0;
    for (std::size_t i = 0; i < count; ++i) end = text.find('\n', end) + 1;
    return WriteFileAtomically(work_.Results() / "audit.jsonl", text.substr(0, end));
  }

  std::string Place(const std::string& recorded) const {
    constexpr std::string_view kInside = "RESULTS/";
    return (recorded.starts_with(kInside) ? work_.Results() / recorded.substr(kInside.size())
                                          : work_.Elsewhere() / recorded)
        .string();
  }

  std::vector<std::string> Words(const AuditEntry& entry) const {
    const bool takes_session = kVerbs.at(entry.type).takes_session;
    std::vector<std::string> words = {entry.type};
    if (takes_session)
      words.insert(words.end(), {session_.string(), "--out", work_.Results().string()});
    else
      words.push_back(work_.Results().string());
    Json options = EntryAt(entry.body, "/options");
    for (const char* place : kWritingOptions)
      if (const std::string recorded = TextAt(options, std::string("/") + place); !recorded.empty())
        options[place] = Place(recorded);
    if (!TextAt(options, "/watch").empty()) {  // as many states as had arrived
      int arrived = 0;
      for (const Json& file : ListAt(entry.body, "/inputs"))
        arrived += TextAt(file, "/of") == "elsewhere";
      options["until"] = arrived;
    }
    const auto more = OptionWords(options);
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  Status Repeat(const AuditEntry& entry) const {
    const auto command = kVerbs.at(entry.type).make();
    CLI::App app;
    command->AddOptions(app);
    const std::vector<std::string> words = Words(entry);
    std::vector<const char*> pointers;
    for (const std::string& word : words) pointers.push_back(word.c_str());
    try {
      app.parse(static_cast<int>(pointers.size()), pointers.data());
    } catch (const CLI::ParseError& e) {
      return BadInput(entry.type + " cannot be repeated: " + e.what());
    }
    std::ostringstream nobody;
    Console silent(nobody, nobody, false);
    const Result<int> result = command->Run(silent);
    if (result) return {};
    return BadInput(entry.type + " cannot be repeated: " + result.error().message);
  }

  // The folder of an entry's files that are not results: its place, or what holds it.
  fs::path ElsewhereOf(std::size_t index) const {
    fs::path place = work_.Elsewhere();
    for (const char* name : kWritingOptions)
      if (const auto recorded = TextAt(entries_[index].body, std::string("/options/") + name);
          !recorded.empty())
        place = Place(recorded);
    return fs::is_directory(place) ? place : place.parent_path();
  }

  // What the entry made, against what was made now.
  Result<std::string> Compare(std::size_t index) {
    for (const Json& file : ListAt(entries_[index].body, "/outputs")) {
      const std::string path = TextAt(file, "/path"), hash = TextAt(file, "/sha256");
      const bool is_inside = TextAt(file, "/of") == "results";
      const auto now =
          ReadFile((is_inside ? work_.Results() : ElsewhereOf(index)) / path, kMostResultBytes);
      if (!now) return path + " was not made again";
      const std::string difference = is_inside ? DifferenceInResults(path, hash, *now) : "";
      if (!difference.empty()) return path + ": " + difference;
      if (Sha256Hex(*now) != hash)
        return path + " is made again with other bytes than " + LineName(entries_, index) +
               " of the audit trail says";
      ++files_;
    }
    return std::string();
  }

  // Of a file that lies in the results folder as the entry with this hash made it. One that a later
  // step replaced or took away is known by its hash only; signatures follow what was made.
  std::string DifferenceInResults(const std::string& path, const std::string& hash,
                                  const std::string& now) const {
    const TrailFile latest = LatestOutputs(entries_).at(path);
    if (latest.sha256 != hash) return "";
    const auto then = ReadFile(choices_.results / path, kMostResultBytes);
    if (!then) return IsSuperseded(entries_, latest.entry) ? "" : "is missing in the results";
    if (path == "report.pdf" && then->starts_with(now)) return "";
    return FirstDifference(path, *then, now);
  }

  const ReplayChoices& choices_;
  const fs::path session_;
  const std::vector<AuditEntry> entries_;
  const WorkFolder& work_;
  std::size_t steps_ = 0, files_ = 0;
};

// Versions in words when the recorded program is another than this one.
std::string OtherProgram(const std::vector<AuditEntry>& entries) {
  const std::string recorded = TextAt(entries.back().body, "/program/version", TELESTRAIN_VERSION);
  if (recorded == TELESTRAIN_VERSION) return "";
  return " (recorded by telestrain " + recorded + ", made again by " TELESTRAIN_VERSION ")";
}

Result<fs::path> SessionOf(const ReplayChoices& choices) {
  fs::path session = choices.session;
  if (session.empty()) {
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string place,
                                ReadFile(choices.results / "session.path", kMostTextBytes));
    session = place.substr(0, place.find('\n'));
  }
  std::error_code code;
  if (fs::is_directory(session, code)) return session;
  return BadInput(session.string() + ": the session is not there; name it with --session");
}

// In words what was compared; an error is a difference.
Result<std::string> Compared(const ReplayChoices& choices, const fs::path& session,
                             const std::string& text, const WorkFolder& work) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto entries,
                              ReadAuditTrail((choices.results / "audit.jsonl").string(), text));
  if (entries.empty()) return BadInput("the audit trail is empty");
  TELESTRAIN_RETURN_IF_ERROR(CheckRepeatable(entries));
  TELESTRAIN_RETURN_IF_ERROR(CheckInputs(entries, session));
  Replay replay(choices, session, entries, work);
  const Result<std::string> difference = replay.Run();
  const std::string programs = OtherProgram(entries);
  if (!difference) return BadInput(difference.error().message + programs);
  if (!difference->empty()) return BadInput(*difference + programs);
  return CountText(replay.steps(), "step") + " repeated, " + CountText(replay.files(), "file") +
         " equal to the byte" + programs;
}

}  // namespace

Result<int> ReplayAudit(const ReplayChoices& choices, Console& console) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string text,
                              ReadFile(choices.results / "audit.jsonl", kMostLogBytes));
  TELESTRAIN_ASSIGN_OR_RETURN(const fs::path session, SessionOf(choices));
  TELESTRAIN_ASSIGN_OR_RETURN(const WorkFolder work, WorkFolder::Make(choices.keep));
  const Result<std::string> compared = Compared(choices, session, text, work);
  console.Say(PrintableText(compared ? "PASS: " + *compared : "FAIL: " + compared.error().message));
  return compared ? 0 : 1;
}

}  // namespace telestrain
