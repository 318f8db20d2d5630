#include <sstream>

#include "base/files.h"
#include "base/json_file.h"
#include "report/audit/audit_line.h"
#include "report/audit/file_difference.h"
#include "report/audit/repeatable.h"
#include "report/audit/step_order.h"
#include "report/audit/tell_audit.h"
#include "report/audit/trail_files.h"
#include "report/audit/verify_audit.h"
#include "robustness/fuzz/fuzz_target.h"

namespace telestrain::fuzz {
namespace {

const std::set<std::string> kFiles{"audit.jsonl",  "bodies.jsonl", "session.toml",
                                   "session.path", "results.json", "key.pem"};

// A whole chain of the entries whose types and bodies stand line by line in `bodies`, as
// {"type", "time", "body"}: hashes cannot be guessed by changing bytes.
std::string SealedTrail(const std::string& bodies) {
  std::string text, previous(64, '0');
  std::istringstream lines(bodies);
  long long seq = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!CheckJsonText(line, 32)) continue;
    const Json json = Json::parse(line, nullptr, false);
    if (!json.is_object()) continue;
    AuditEntry entry;
    entry.seq = ++seq;
    entry.type = TextAt(json, "/type");
    entry.time = TextAt(json, "/time");
    entry.body = EntryAt(json, "/body");
    entry.prev = previous;
    const std::string entry_text = EntryText(entry);
    entry.hash = previous = Sha256Hex(entry_text);
    text += AuditLine(entry, entry_text);
  }
  return text;
}

void TryEntries(const std::vector<AuditEntry>& entries, const std::filesystem::path& folder) {
  for (const std::string& line : TellAudit(entries))
    Require(line.find('\n') == std::string::npos, "a line of the story is one line");
  Succeeds(CheckStory(entries));
  Succeeds(CheckRepeatable(entries));
  for (std::size_t i = 0; i < entries.size(); ++i)
    static_cast<void>(IsSuperseded(entries, i) ? LineName(entries, i) : "");
  for (const auto& [path, file] : LatestOutputs(entries))
    Require(file.entry < entries.size(), "a file was made by an entry");
  if (!Succeeds(CheckPaths(entries))) return;
  Succeeds(CheckOutputs(entries, folder));
  Succeeds(CheckInputs(entries, folder));
}

void TryTrail(const std::string& text, const std::filesystem::path& folder) {
  const auto entries = ReadAuditTrail("audit.jsonl", text);
  if (!Succeeds(entries)) return;
  std::string written;
  for (const AuditEntry& entry : *entries) written += AuditLine(entry, EntryText(entry));
  Require(written == text, "a trail is written in one way");
  Require(text.starts_with(TrailOfResults(text)), "a report carries the beginning of the trail");
  TryEntries(*entries, folder);
}

void TryAnswers(const std::filesystem::path& folder, bool with_key) {
  AuditQuestion question;
  question.subject = folder;
  question.session = folder;
  const auto answer = VerifyAudit(question);
  if (Succeeds(answer))
    Require(answer->line.starts_with(answer->passed ? "PASS" : "FAIL"), "an answer says which");
  question.subject = folder / "audit.jsonl";
  if (with_key) question.public_key = folder / "key.pem";
  Succeeds(VerifyAudit(question));
  Succeeds(TellAuditOf(folder));
  Succeeds(AuditTrail::Open(folder / "audit.jsonl", with_key ? folder / "key.pem" : ""));
}

}  // namespace

void FuzzAudit(std::string_view input) {
  static MemoryFolder folder("audit_");
  auto files = FilesIn(input, kFiles);
  if (const auto at = files.find("bodies.jsonl"); at != files.end()) {
    files["audit.jsonl"] = SealedTrail(at->second);
    TryTrail(files["audit.jsonl"], folder.path());
    files.erase(at);
  } else if (files.contains("audit.jsonl")) {
    TryTrail(files["audit.jsonl"], folder.path());
  }
  folder.Hold(files, kFiles);
  TryAnswers(folder.path(), files.contains("key.pem"));
  const std::string& one = files["session.toml"];
  const std::string& other = files["results.json"];
  for (const char* name : {"a.json", "a.csv", "a.bin"})
    Require(FirstDifference(name, one, other).empty() == (one == other),
            "files differ where a difference is named");
}

}  // namespace telestrain::fuzz
