#include "report/audit/verify_audit.h"

#include <algorithm>

#include "base/files.h"
#include "base/numbers.h"
#include "base/utf8.h"
#include "report/audit/report_check.h"
#include "report/audit/trail_files.h"
#include "report/reading/pdf_contents.h"
#include "report/signature/certificate.h"

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
  TELESTRAIN_ASSIGN_OR_RETURN(trail.text, ReadFile(file, kMostLogBytes));
  TELESTRAIN_ASSIGN_OR_RETURN(trail.entries, ReadAuditTrail(file.string(), trail.text));
  if (trail.entries.empty()) return BadInput(file.string() + " is empty");
  TELESTRAIN_RETURN_IF_ERROR(CheckPaths(trail.entries));
  return trail;
}

// In words; a session that is not there any more is no fault of the results.
Result<std::string> InputsInWords(const AuditQuestion& question, const FolderTrail& trail) {
  fs::path session = question.session;
  if (session.empty()) {
    const auto place = ReadFile(question.subject / "session.path", kMostTextBytes);
    if (!place) return std::string("inputs not checked: session.path is missing");
    session = place->substr(0, place->find('\n'));
  }
  if (!IsThere(session)) return "inputs not checked: " + session.string() + " is not there";
  TELESTRAIN_ASSIGN_OR_RETURN(const std::size_t count, CheckInputs(trail.entries, session));
  return CountText(count, "input") + " unchanged";
}

Result<std::string> ReportInWords(const AuditQuestion& question, const FolderTrail& trail) {
  const fs::path path = question.subject / "report.pdf";
  const TrustOptions& trust = question.trust;
  if (!IsThere(path) && !trust.required_roles.empty())
    return BadInput("report.pdf is missing, which the " + trust.required_roles.front() +
                    " must have signed (--require)");
  if (!IsThere(path) && !trust.certificates.empty())
    return BadInput("report.pdf is missing although --trust names who may sign");
  if (!IsThere(path)) return std::string("no report.pdf");
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path, kMostReportBytes));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string words,
                              CheckReport("report.pdf", bytes, trust, &trail));
  return "report.pdf: " + words;
}

// The lines after those of the report and its signatures, in words; empty without any.
std::string LooseLines(const AuditQuestion& question, const FolderTrail& trail) {
  std::size_t held = 0;
  for (std::size_t i = 0; i < trail.entries.size(); ++i)
    if (trail.entries[i].type == "report" ||
        (trail.entries[i].type == "sign" && TextAt(trail.entries[i].body, "/file") == "report.pdf"))
      held = i + 1;
  if (!IsThere(question.subject / "report.pdf")) held = 0;
  const std::size_t loose = trail.entries.size() - held;
  if (loose == 0) return "";
  if (loose == 1) return "; no signature holds the trail's last line (--log anchors it)";
  return "; no signature holds the trail's last " + std::to_string(loose) +
         " lines (--log anchors them)";
}

Result<std::string> CheckLogFile(const AuditQuestion& question, const fs::path& file,
                                 const std::string& head) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(file, kMostLogBytes));
  std::string key;
  if (!question.public_key.empty()) {
    TELESTRAIN_ASSIGN_OR_RETURN(key, ReadFile(question.public_key, kMostTextBytes));
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
  if (question.log.empty()) return words + LooseLines(question, trail);
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string log,
                              CheckLogFile(question, question.log, trail.entries.back().hash));
  return words + "; " + log;
}

// A report by itself: the session can be asked by the trail inside.
Result<std::string> CheckPdf(const AuditQuestion& question) {
  const std::string name = question.subject.filename().string();
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes,
                              ReadFile(question.subject, kMostReportBytes));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string words,
                              CheckReport(name, bytes, question.trust, nullptr));
  if (question.session.empty()) return words + "; inputs not checked: no --session";
  TELESTRAIN_ASSIGN_OR_RETURN(const PdfContents contents, ReadPdfContents(name, bytes));
  const auto trail = contents.attachments.find("audit.jsonl");
  if (trail == contents.attachments.end())
    return BadInput(name + " carries no audit trail, which would tell the inputs");
  TELESTRAIN_ASSIGN_OR_RETURN(const auto entries, ReadAuditTrail(name, trail->second));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::size_t count, CheckInputs(entries, question.session));
  return words + "; " + CountText(count, "input") + " unchanged";
}

bool IsLog(const fs::path& subject) { return subject.extension() == ".jsonl"; }

Result<std::string> Check(const AuditQuestion& question) {
  std::error_code code;
  if (fs::is_directory(question.subject, code)) return CheckFolder(question);
  if (IsLog(question.subject)) return CheckLogFile(question, question.subject, "");
  return CheckPdf(question);
}

// What is asked must have a sense for what it is asked of: nothing is passed over in silence.
Status CheckSense(const AuditQuestion& question) {
  const auto usage = [](const std::string& message) { return Error{ErrorKind::kUsage, message}; };
  std::error_code code;
  const bool is_folder = fs::is_directory(question.subject, code);
  if (IsLog(question.subject) && !is_folder &&
      (!question.trust.required_roles.empty() || !question.session.empty() ||
       !question.log.empty()))
    return usage("--require, --session and --log are of a report or a results folder; " +
                 question.subject.string() + " is a log");
  if (!question.log.empty() && !is_folder)
    return usage("--log must tell of the latest line of a results folder; name the folder");
  if (!question.public_key.empty() && question.log.empty() && !IsLog(question.subject))
    return usage("--public-key is of the instrument's log; name it, or give it with --log");
  return {};
}

// A report.pdf in its results folder is checked with all that lies there.
AuditQuestion OfFolder(AuditQuestion question) {
  const fs::path folder = question.subject.parent_path();
  if (question.subject.filename() == "report.pdf" && IsThere(folder / "audit.jsonl"))
    question.subject = folder.empty() ? fs::path(".") : folder;
  return question;
}

}  // namespace

Result<AuditAnswer> VerifyAudit(const AuditQuestion& question) {
  for (const fs::path& path :
       {question.subject, question.session, question.log, question.public_key})
    TELESTRAIN_RETURN_IF_ERROR(RequireThere(path));
  for (const fs::path& path : question.trust.certificates)
    TELESTRAIN_RETURN_IF_ERROR(RequireThere(path));
  const auto trusted = ReadCertificates(question.trust.certificates);
  if (!trusted) return trusted.error();
  const AuditQuestion of_folder = OfFolder(question);
  TELESTRAIN_RETURN_IF_ERROR(CheckSense(of_folder));
  const Result<std::string> checked = Check(of_folder);
  if (checked) return AuditAnswer{true, PrintableText("PASS: " + *checked)};
  return AuditAnswer{false, PrintableText("FAIL: " + checked.error().message)};
}

}  // namespace telestrain
