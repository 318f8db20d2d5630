#include "report/audit/trail_files.h"

#include "base/files.h"
#include "report/audit/step_order.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReport = "report.pdf";

bool IsOf(const Json& file, const char* where) { return TextAt(file, "/of") == where; }

std::size_t BytesOf(const Json& file) {
  const double bytes = NumberAt(file, "/bytes").value_or(0);
  return bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
}

Status CheckFile(const std::string& path, const std::string& made_by, const TrailFile& wanted,
                 const std::string& bytes) {
  if (Sha256Hex(bytes) == wanted.sha256) return {};
  // Signatures are added to the end; whether they are valid is asked elsewhere.
  const bool signed_since = path == kReport && wanted.bytes > 0 && bytes.size() > wanted.bytes &&
                            bytes.find("/ByteRange", wanted.bytes) != std::string::npos;
  if (signed_since && Sha256Hex(bytes.substr(0, wanted.bytes)) == wanted.sha256) return {};
  return BadInput(path + " was changed after " + made_by + " made it");
}

void AddOutputs(const std::vector<AuditEntry>& entries, std::size_t index,
                std::map<std::string, TrailFile>& files) {
  const Json& body = entries[index].body;
  if (entries[index].type == "sign" && TextAt(body, "/file") == kReport)
    files[kReport] = {TextAt(body, "/sha256_after"), 0, index};
  for (const Json& file : ListAt(body, "/outputs"))
    if (IsOf(file, "results"))
      files[TextAt(file, "/path")] = {TextAt(file, "/sha256"), BytesOf(file), index};
}

}  // namespace

std::map<std::string, TrailFile> LatestOutputs(const std::vector<AuditEntry>& entries) {
  std::map<std::string, TrailFile> files;
  for (std::size_t i = 0; i < entries.size(); ++i) AddOutputs(entries, i, files);
  return files;
}

std::string LineName(const std::vector<AuditEntry>& entries, std::size_t index) {
  return "line " + std::to_string(index + 1) + " (" + entries[index].type + ")";
}

Status CheckStory(const std::vector<AuditEntry>& entries) {
  std::map<std::string, TrailFile> made;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (const Json& file : ListAt(entries[i].body, "/inputs")) {
      if (!IsOf(file, "results")) continue;
      const std::string path = TextAt(file, "/path");
      const auto found = made.find(path);
      if (found == made.end())
        return BadInput(LineName(entries, i) + " of the audit trail read " + path +
                        ", which no line before it made");
      if (found->second.sha256 != TextAt(file, "/sha256"))
        return BadInput(LineName(entries, i) + " of the audit trail read another " + path +
                        " than " + LineName(entries, found->second.entry) + " made");
    }
    AddOutputs(entries, i, made);
  }
  return {};
}

Result<std::size_t> CheckOutputs(const std::vector<AuditEntry>& entries, const fs::path& results) {
  std::size_t count = 0;
  for (const auto& [path, file] : LatestOutputs(entries)) {
    std::error_code code;
    const std::string made_by = LineName(entries, file.entry) + " of the audit trail";
    if (!fs::exists(results / path, code)) {
      if (IsSuperseded(entries, file.entry)) continue;
      return BadInput(path + " is missing, which " + made_by + " made");
    }
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(results / path));
    TELESTRAIN_RETURN_IF_ERROR(CheckFile(path, made_by, file, bytes));
    ++count;
  }
  return count;
}

Result<std::size_t> CheckInputs(const std::vector<AuditEntry>& entries, const fs::path& session) {
  std::size_t open = entries.size();
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (entries[i].type == "open") open = i;
  if (open == entries.size()) return BadInput("the audit trail does not say what was opened");
  std::size_t count = 0;
  for (const Json& file : ListAt(entries[open].body, "/inputs")) {
    if (!IsOf(file, "session")) continue;
    const std::string path = TextAt(file, "/path");
    std::error_code code;
    if (!fs::exists(session / path, code))
      return BadInput("input " + path + " is missing in " + session.string());
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string hash, Sha256HexOfFile(session / path));
    if (hash != TextAt(file, "/sha256"))
      return BadInput("input " + path + " was changed after " + LineName(entries, open) +
                      " of the audit trail read it");
    ++count;
  }
  return count;
}

}  // namespace telestrain
