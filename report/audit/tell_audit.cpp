#include "report/audit/tell_audit.h"

#include <map>

#include "base/files.h"
#include "base/numbers.h"
#include "base/utf8.h"
#include "report/reading/pdf_contents.h"
#include "report/signature/integrity.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

// What a step does, as the beginning of a sentence.
const std::map<std::string, std::string> kDeeds = {
    {"open", "The session was opened"},
    {"detect", "Corners and crosses were found in the images"},
    {"calibrate", "Lens and views were calibrated"},
    {"diagnose", "The calibration was checked by other means"},
    {"verify", "The ruler was measured"},
    {"measure", "The strain of the pipe was measured"},
    {"render", "Pictures were drawn"},
    {"results", "The limits were decided"},
    {"report", "The report was written"},
    {"review", "The review page was written"},
    {"export", "Files for other programs were written"}};

// More names than this are counted.
constexpr std::size_t kMostNames = 4;

// "a, b and 3 more".
std::string Listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i)
    text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kMostNames)
    text += " and " + std::to_string(names.size() - kMostNames) + " more";
  return text;
}

std::vector<std::string> PathsOf(const Json& files) {
  std::vector<std::string> paths;
  for (const Json& file : files) paths.push_back(TextAt(file, "/path"));
  return paths;
}

std::string OptionsInWords(const Json& options) {
  std::string text;
  for (const auto& [name, value] : options.items()) {
    const bool is_unused = value.is_null() || value == false || value == "" || value == 0 ||
                           (value.is_array() && value.empty());
    if (is_unused) continue;
    text += (text.empty() ? "" : ", ") + name;
    if (value != true) text += " " + (value.is_string() ? value.get<std::string>() : value.dump());
  }
  return text;
}

std::string StepInWords(const AuditEntry& entry) {
  const auto deed = kDeeds.find(entry.type);
  std::string text = deed != kDeeds.end() ? deed->second : "'" + entry.type + "' was done";
  if (const std::string session = TextAt(entry.body, "/session"); !session.empty())
    text += ", \"" + session + "\"";
  const Json& inputs = ListAt(entry.body, "/inputs");
  const Json& outputs = ListAt(entry.body, "/outputs");
  if (!inputs.empty())
    text += ", from " + (inputs.size() <= kMostNames ? Listed(PathsOf(inputs))
                                                     : CountText(inputs.size(), "file"));
  if (!outputs.empty()) text += "; made " + Listed(PathsOf(outputs));
  return text + " (telestrain " + TextAt(entry.body, "/program/version") + ").";
}

std::string SigningInWords(const AuditEntry& entry) {
  return TextAt(entry.body, "/signer") + " signed " + TextAt(entry.body, "/file") + " as " +
         TextAt(entry.body, "/role") + ".";
}

std::string RunInWords(const AuditEntry& entry) {
  std::string words = "telestrain";
  for (const Json& word : ListAt(entry.body, "/arguments"))
    words += " " + (word.is_string() ? word.get<std::string>() : word.dump());
  const std::string code = TextAt(entry.body, "/exit_code");
  std::string text = TextAt(entry.body, "/user") + " on " + TextAt(entry.body, "/host/name") +
                     " ran '" + words + "', which ended with " + code;
  text += code == "0" ? " (accepted)." : code == "1" ? " (not accepted)." : " (failed).";
  return text;
}

// What a report.pdf says of itself: the trail inside ends before it was written.
std::vector<std::string> TellReport(const std::string& bytes) {
  std::vector<std::string> lines{"     The report was written with these results."};
  const SignatureCheck check = CheckIntegrity(bytes, nullptr);
  if (!check.failure.empty())
    lines.push_back("     Its signatures do not hold: " + check.failure + ".");
  else if (check.signatures.empty())
    lines.push_back("     It is not signed.");
  for (const PdfSignature& signature : check.signatures)
    if (check.failure.empty())
      lines.push_back("     " + signature.claimed_time + "  " + signature.signer +
                      " signed it as " + signature.role +
                      " (by this name and time; 'audit verify --trust' says whose it is).");
  return lines;
}

std::vector<std::string> Printable(std::vector<std::string> lines) {
  for (std::string& line : lines) line = PrintableText(line);
  return lines;
}

}  // namespace

std::vector<std::string> TellAudit(const std::vector<AuditEntry>& entries) {
  std::vector<std::string> lines;
  for (const AuditEntry& entry : entries) {
    const std::string number = std::to_string(entry.seq + 1);
    std::string line = std::string(number.size() < 3 ? 3 - number.size() : 0, ' ') + number + "  ";
    if (!entry.time.empty()) line += entry.time + "  ";
    if (entry.type == "run")
      line += RunInWords(entry);
    else
      line += entry.type == "sign" ? SigningInWords(entry) : StepInWords(entry);
    lines.push_back(line);
    const std::string options = OptionsInWords(EntryAt(entry.body, "/options"));
    if (!options.empty()) lines.push_back("     with " + options);
  }
  return Printable(std::move(lines));
}

Result<std::vector<std::string>> TellAuditOf(const fs::path& subject) {
  std::error_code code;
  const bool is_folder = fs::is_directory(subject, code);
  const fs::path file = is_folder ? subject / "audit.jsonl" : subject;
  std::string name = file.string();
  TELESTRAIN_ASSIGN_OR_RETURN(std::string text, ReadFile(file, kMostLogBytes));
  std::vector<std::string> of_report;
  if (text.starts_with("%PDF-")) {
    TELESTRAIN_ASSIGN_OR_RETURN(PdfContents contents, ReadPdfContents(name, text));
    const auto trail = contents.attachments.find("audit.jsonl");
    if (trail == contents.attachments.end()) return BadInput(name + ": carries no audit trail");
    of_report = Printable(TellReport(text));
    name = "the audit trail in " + name;
    text = std::move(trail->second);
  }
  TELESTRAIN_ASSIGN_OR_RETURN(const auto entries, ReadAuditTrail(name, text));
  std::vector<std::string> lines = TellAudit(entries);
  lines.insert(lines.end(), of_report.begin(), of_report.end());
  return lines;
}

}  // namespace telestrain
