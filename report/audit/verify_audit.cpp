#include "report/audit/verify_audit.h"

#include <algorithm>

#include "base/files.h"
#include "base/numbers.h"
#include "report/audit/report_check.h"
#include "report/audit/trail_files.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

bool IsThere(const fs::path& path) {
  std::error_code code;
  return fs::exists(path, code);
}

Status RequireThere(const fs::path& path) {
  if (path.empty() || IsThere(path)) return {};
  return BadInput(path.string() + ": does not exist");
}

Result<FolderTrail> ReadTrail(const fs::path& file) {
  if (!IsThere(file)) return BadInput(file.string() + " is missing: nothing tells what was done");
  FolderTrail trail;
  TELESTRAIN_ASSIGN_OR_RETURN(trail.text, ReadFile(file));
  TELESTRAIN_ASSIGN_OR_RETURN(trail.entries, ReadAuditTrail(file.string(), trail.text));
  if (trail.entries.empty()) return BadInput(file.string() + " is empty");
  return trail;
}

// In words; a session that is not there any more is no fault of the results.
Result<std::string> InputsInWords(const AuditQuestion& question, const FolderTrail& trail) {
  fs::path session = question.session;
  if (session.empty()) {
    const auto place = ReadFile(question.subject / "session.path");
    if (!place) return std::string("inputs not checked: session.path is missing");
    session = place->substr(0, place->find('\n'));
  }
  if (!IsThere(session)) return "inputs not checked: " + session.string() + " is not there";
  TELESTRAIN_ASSIGN_OR_RETURN(const std::size_t count, CheckInputs(trail.entries, session));
  return CountText(count, "input") + " unchanged";
}

bool CarriesNothing(const FolderTrail& trail) {
  const auto report = std::find_if(trail.entries.rbegin(), trail.entries.rend(),
                                   [](const AuditEntry& entry) { return entry.type == "report"; });
  return report != trail.entries.rend() && TextAt(report->body, "/options/archive-level") == "1b";
}

Result<std::string> ReportInWords(const AuditQuestion& question, const FolderTrail& trail) {
  const fs::path path = question.subject / "report.pdf";
  if (!IsThere(path)) return std::string("no report.pdf");
  if (CarriesNothing(trail)) return std::string("report.pdf of level 1b carries no attachments");
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string words,
                              CheckReport("report.pdf", bytes, question.trust, &trail));
  return "report.pdf: " + words;
}

Result<std::string> CheckLogFile(const AuditQuestion& question, const fs::path& file,
                                 const std::string& head) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(file));
  std::string key;
  if (!question.public_key.empty()) {
    TELESTRAIN_ASSIGN_OR_RETURN(key, ReadFile(question.public_key));
  }
  TELESTRAIN_ASSIGN_OR_RETURN(const auto entries, ReadAuditTrail(file.string(), text, key));
  const bool tells = std::any_of(entries.begin(), entries.end(), [&](const AuditEntry& entry) {
    return TextAt(entry.body, "/trail_head") == head;
  });
  if (!head.empty() && !tells)
    return BadInput(file.string() +
                    " does not tell of the latest line of the audit trail: it was written or cut "
                    "off without the instrument's log");
  return CountText(entries.size(), "line") + " of the instrument's log chained" +
         (key.empty() ? "" : " and signed");
}

Result<std::string> CheckFolder(const AuditQuestion& question) {
  TELESTRAIN_ASSIGN_OR_RETURN(const FolderTrail trail, ReadTrail(question.subject / "audit.jsonl"));
  TELESTRAIN_RETURN_IF_ERROR(CheckStory(trail.entries));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::size_t files,
                              CheckOutputs(trail.entries, question.subject));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string inputs, InputsInWords(question, trail));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string report, ReportInWords(question, trail));
  std::string words = CountText(trail.entries.size(), "step") + " chained, " +
                      CountText(files, "file") + " unchanged, " + inputs + "; " + report;
  if (question.log.empty()) return words;
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string log,
                              CheckLogFile(question, question.log, trail.entries.back().hash));
  return words + "; " + log;
}

// A report that lies in its results folder must fit the trail there.
Result<std::string> CheckPdf(const AuditQuestion& question) {
  const std::string name = question.subject.filename().string();
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(question.subject));
  const fs::path beside = question.subject.parent_path() / "audit.jsonl";
  if (name != "report.pdf" || !IsThere(beside))
    return CheckReport(name, bytes, question.trust, nullptr);
  TELESTRAIN_ASSIGN_OR_RETURN(const FolderTrail trail, ReadTrail(beside));
  TELESTRAIN_RETURN_IF_ERROR(CheckOutputs(trail.entries, beside.parent_path()));
  return CheckReport(name, bytes, question.trust, &trail);
}

Result<std::string> Check(const AuditQuestion& question) {
  std::error_code code;
  if (fs::is_directory(question.subject, code)) return CheckFolder(question);
  if (question.subject.extension() == ".jsonl") return CheckLogFile(question, question.subject, "");
  return CheckPdf(question);
}

}  // namespace

Result<AuditAnswer> VerifyAudit(const AuditQuestion& question) {
  for (const fs::path& path :
       {question.subject, question.session, question.log, question.public_key})
    TELESTRAIN_RETURN_IF_ERROR(RequireThere(path));
  for (const fs::path& path : question.trust.certificates)
    TELESTRAIN_RETURN_IF_ERROR(RequireThere(path));
  if (!question.public_key.empty() && question.log.empty() &&
      question.subject.extension() != ".jsonl")
    return Error{ErrorKind::kUsage,
                 "--public-key is of the instrument's log; name it, or give it with --log"};
  const Result<std::string> checked = Check(question);
  if (checked) return AuditAnswer{true, "PASS: " + *checked};
  return AuditAnswer{false, "FAIL: " + checked.error().message};
}

}  // namespace telestrain
