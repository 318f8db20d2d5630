#include "app/instrument_log.h"

#include <pwd.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <ctime>

#include "app/build_record.h"
#include "app/program_record.h"
#include "app/version_text.h"
#include "base/path_lock.h"
#include "report/audit/audit_trail.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

// Held while the file is read and continued, so that two programs do not both follow one line.
Result<PathLock> Lock(const fs::path& file) {
  return PathLock::Take(file, "name another log with --instrument-log");
}

// ISO 8601 in UTC with milliseconds.
std::string ClockTime() {
  using std::chrono::duration_cast, std::chrono::milliseconds;
  const auto now = std::chrono::system_clock::now();
  const long long ms = duration_cast<milliseconds>(now.time_since_epoch()).count();
  const std::time_t seconds = ms / 1000;
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S.", &parts);
  return text.data() + std::to_string(1000 + ms % 1000).substr(1) + "Z";
}

std::string UserName() {
  const ::passwd* const user = ::getpwuid(::geteuid());
  return user ? user->pw_name : std::to_string(::geteuid());
}

bool NamesAPassword(const std::string& option) {
  return option.starts_with("--") &&
         (option.find("pass") != std::string::npos || option.find("pin") != std::string::npos);
}

Json WordsWithoutPasswords(const std::vector<std::string>& words) {
  Json kept = Json::array();
  bool hide = false;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const std::string option = word.substr(0, equals);
    if (hide)
      kept.push_back("…");
    else if (NamesAPassword(option) && equals != std::string::npos)
      kept.push_back(option + "=…");
    else
      kept.push_back(word);
    hide = !hide && NamesAPassword(option) && equals == std::string::npos;
  }
  return kept;
}

// The head of the folder's trail; null without one. A broken one is said, not hidden.
Json HeadOf(const fs::path& results) {
  std::error_code code;
  if (results.empty() || !fs::exists(results / "audit.jsonl", code)) return nullptr;
  const auto trail = AuditTrail::Open(results / "audit.jsonl");
  return trail ? trail->head() : "broken: " + trail.error().message;
}

Result<AuditTrail> OpenLog(const InstrumentLog& log) {
  auto trail = AuditTrail::Open(log.file, log.key_file);
  if (trail) return trail;
  return BadInput(trail.error().message +
                  "; nothing is done without the instrument's log: look into it, or name a new one "
                  "with --instrument-log");
}

}  // namespace

Status CheckLog(const InstrumentLog& log) {
  if (log.file.empty()) {
    if (log.key_file.empty()) return {};
    return Error{ErrorKind::kUsage,
                 "--instrument-key signs the instrument's log; name it with --instrument-log"};
  }
  TELESTRAIN_ASSIGN_OR_RETURN(const PathLock lock, Lock(log.file));
  const auto trail = OpenLog(log);
  return trail ? Status() : Status(trail.error());
}

Status LogRun(const InstrumentLog& log, const LoggedRun& run) {
  if (log.file.empty()) return {};
  std::error_code code;
  const fs::path results = run.results.empty() ? fs::path() : fs::absolute(run.results, code);
  Json program = ProgramRecord();
  program["revision"] = kBuildRecord.revision;
  program["build_id"] = BuildId();
  const Json body{{"program", program},
                  {"host", HostRecord()},
                  {"user", UserName()},
                  {"verb", run.verb},
                  {"arguments", WordsWithoutPasswords(run.words)},
                  {"folder", fs::current_path(code).string()},
                  {"exit_code", run.exit_code},
                  {"results", results.lexically_normal().string()},
                  {"trail_head", HeadOf(results)}};
  TELESTRAIN_ASSIGN_OR_RETURN(const PathLock lock, Lock(log.file));
  TELESTRAIN_ASSIGN_OR_RETURN(AuditTrail trail, OpenLog(log));
  TELESTRAIN_RETURN_IF_ERROR(trail.Append("run", body, ClockTime()));
  return trail.Sync();
}

}  // namespace telestrain
