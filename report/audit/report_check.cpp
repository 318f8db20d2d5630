#include "report/audit/report_check.h"

#include <algorithm>
#include <array>

#include "base/files.h"
#include "base/numbers.h"
#include "report/audit/trail_files.h"
#include "report/reading/pdf_contents.h"
#include "report/signature/signed_layout.h"

namespace telestrain {
namespace {

constexpr const char* kTrail = "audit.jsonl";

// Files of the results folder that a report carries when they exist.
constexpr std::array kCarried = {"results.json", "calibration.json", "dcc.xml", "session.toml"};

bool Prints(const PdfContents& contents, const std::string& file, const std::string& hash) {
  const auto printed = contents.printed_hashes.find(file);
  return printed != contents.printed_hashes.end() && printed->second == hash;
}

Result<std::vector<AuditEntry>> TrailInside(const std::string& name, const PdfContents& contents) {
  const auto attached = contents.attachments.find(kTrail);
  if (attached == contents.attachments.end()) return BadInput(name + " carries no audit trail");
  TELESTRAIN_ASSIGN_OR_RETURN(auto entries,
                              ReadAuditTrail("the audit trail in " + name, attached->second));
  if (entries.empty()) return BadInput("the audit trail in " + name + " is empty");
  if (contents.printed_hashes.empty())
    return BadInput(name +
                    " prints no SHA-256 of its attachments, so that they can be compared with "
                    "nothing; make it again with 'telestrain report'");
  if (contents.printed_head != entries.back().hash)
    return BadInput("the audit trail in " + name +
                    " does not end with the line whose hash is printed on its pages: it was cut "
                    "short or continued");
  TELESTRAIN_RETURN_IF_ERROR(CheckPaths(entries));
  TELESTRAIN_RETURN_IF_ERROR(CheckStory(entries));
  return entries;
}

Status CheckAttachments(const std::string& name, const PdfContents& contents,
                        const std::vector<AuditEntry>& entries) {
  for (const auto& [file, bytes] : contents.attachments)
    if (!Prints(contents, file, Sha256Hex(bytes)))
      return BadInput("attachment " + file + " of " + name +
                      " is not the one whose SHA-256 is printed on its pages");
  const auto made = LatestOutputs(entries);
  for (const char* file : kCarried) {
    const auto wanted = made.find(file);
    const auto attached = contents.attachments.find(file);
    if (wanted == made.end() && attached == contents.attachments.end()) continue;
    const std::string what = std::string("attachment ") + file + " of " + name + " ";
    if (attached == contents.attachments.end())
      return BadInput(what + "is missing, which " + LineName(entries, wanted->second.entry) +
                      " of its audit trail made");
    if (wanted == made.end()) return BadInput(what + "is not told of in its audit trail");
    if (Sha256Hex(attached->second) != wanted->second.sha256)
      return BadInput(what + "is not the one that " + LineName(entries, wanted->second.entry) +
                      " of its audit trail made");
  }
  return {};
}

// The roles that the trail says have signed the latest report.
std::vector<std::pair<std::size_t, std::string>> RecordedRoles(
    const std::vector<AuditEntry>& entries) {
  std::vector<std::pair<std::size_t, std::string>> roles;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].type == "report") roles.clear();
    if (entries[i].type == "sign" && TextAt(entries[i].body, "/file") == "report.pdf")
      roles.emplace_back(i, TextAt(entries[i].body, "/role"));
  }
  return roles;
}

bool IsRecorded(const std::vector<AuditEntry>& entries, const std::string& role) {
  const auto roles = RecordedRoles(entries);
  return std::any_of(roles.begin(), roles.end(),
                     [&](const auto& recorded) { return recorded.second == role; });
}

Result<std::string> Signatures(const std::string& name, const std::string& bytes,
                               const TrustOptions& trust, const FolderTrail* folder) {
  TELESTRAIN_ASSIGN_OR_RETURN(const SignatureCheck check, CheckSignatures(bytes, trust));
  if (!check.failure.empty()) return BadInput(check.failure);
  if (folder)
    for (const auto& [index, role] : RecordedRoles(folder->entries))
      if (std::none_of(check.signatures.begin(), check.signatures.end(),
                       [&role = role](const auto& signature) { return signature.role == role; }))
        return BadInput("the signature of the " + role + " is missing in " + name + ", which " +
                        LineName(folder->entries, index) + " of the audit trail tells of");
  if (check.signatures.empty() && !trust.certificates.empty())
    return BadInput(name + " is not signed although --trust names who may sign");
  if (check.signatures.empty()) return std::string("not signed");
  std::string text;
  for (const PdfSignature& signature : check.signatures) {
    text += (text.empty() ? "signed by " : ", ") + signature.role + " " + signature.signer + " (" +
            TimeText(signature) + ")";
    if (folder && !IsRecorded(folder->entries, signature.role))
      text += " (not told of in the audit trail)";
  }
  return text;
}

// A report that carries nothing (level 1b) is known by its bytes before the first signature, and
// outside of its results folder by its signatures alone.
Status CheckBare(const std::string& name, const std::string& bytes, const FolderTrail* folder) {
  const SignedLayout layout = ReadSignedLayout(bytes);
  if (!folder && layout.signatures.empty())
    return BadInput(name +
                    " carries no audit trail and no signature: nothing in it can be checked; "
                    "verify its results folder");
  if (!folder) return {};
  const std::size_t made_bytes =
      layout.signatures.empty() ? bytes.size() : layout.signatures.front().begin;
  const auto report = std::find_if(folder->entries.rbegin(), folder->entries.rend(),
                                   [](const AuditEntry& entry) { return entry.type == "report"; });
  if (report != folder->entries.rend() &&
      TextAt(FindBy(ListAt(report->body, "/outputs"), "path", name), "/sha256") ==
          Sha256Hex(std::string_view(bytes).substr(0, made_bytes)))
    return {};
  return BadInput(name + " carries no audit trail");
}

Status CheckAgainstFolder(const std::string& name, const PdfContents& contents,
                          const FolderTrail& folder) {
  if (!LatestOutputs(folder.entries).contains("report.pdf"))
    return BadInput(name + " is there, but no line of the audit trail made it: lines were cut off");
  if (folder.text.starts_with(contents.attachments.at(kTrail))) return {};
  return BadInput("the audit trail in " + name +
                  " is not the beginning of the one in the results folder: lines of one of them "
                  "were taken out or exchanged");
}

}  // namespace

Result<std::string> CheckReport(const std::string& name, const std::string& bytes,
                                const TrustOptions& trust, const FolderTrail* folder) {
  TELESTRAIN_ASSIGN_OR_RETURN(const PdfContents contents, ReadPdfContents(name, bytes));
  if (contents.attachments.empty()) {
    TELESTRAIN_RETURN_IF_ERROR(CheckBare(name, bytes, folder));
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string words, Signatures(name, bytes, trust, folder));
    return "no attachments (level 1b), " + words;
  }
  TELESTRAIN_ASSIGN_OR_RETURN(const auto entries, TrailInside(name, contents));
  TELESTRAIN_RETURN_IF_ERROR(CheckAttachments(name, contents, entries));
  if (folder) TELESTRAIN_RETURN_IF_ERROR(CheckAgainstFolder(name, contents, *folder));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string signatures, Signatures(name, bytes, trust, folder));
  return CountText(contents.attachments.size(), "attachment") + " as printed, " + signatures;
}

}  // namespace telestrain
