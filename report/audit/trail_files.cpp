#include "report/audit/trail_files.h"

#include <algorithm>

#include "base/files.h"
#include "report/audit/step_order.h"
#include "report/signature/signed_layout.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReport = "report.pdf";

bool IsOf(const Json& file, const char* where) { return TextAt(file, "/of") == where; }

std::size_t BytesOf(const Json& file) {
  constexpr double kMost = 9007199254740992.0;  // 2^53: what a double still counts one by one
  const double bytes = NumberAt(file, "/bytes").value_or(0);
  return bytes > 0 && bytes <= kMost ? static_cast<std::size_t>(bytes) : 0;
}

// Devices, pipes and folders are no results, and reading one may never end.
Status RequireRegular(const fs::path& file, const std::string& name) {
  std::error_code code;
  if (fs::is_regular_file(file, code)) return {};
  return BadInput(name + " is no regular file");
}

// Whether the file has another size than recorded, so that it need not be read.
bool HasOtherSize(const fs::path& file, std::size_t wanted_bytes) {
  std::error_code code;
  return wanted_bytes > 0 && fs::file_size(file, code) != wanted_bytes;
}

// Whether what was made is followed by nothing but updates of signatures. Whether those hold is
// asked by CheckReport.
Status CheckSignedSince(const std::string& bytes, const std::string& made_by,
                        const TrailFile& wanted) {
  const SignedLayout layout = ReadSignedLayout(bytes);
  if (!layout.failure.empty()) return BadInput(layout.failure);
  for (const RawSignature& signature : layout.signatures) {
    const bool is_first = signature.begin == layout.signatures.front().begin;
    // `report` made what is before the first signature, `sign` what is before a later one.
    const bool fits = wanted.bytes > 0 ? is_first && signature.begin == wanted.bytes : !is_first;
    if (fits && Sha256Hex(std::string_view(bytes).substr(0, signature.begin)) == wanted.sha256)
      return {};
  }
  return BadInput(std::string(kReport) + " was changed after " + made_by + " made it");
}

Status CheckFile(const fs::path& file, const std::string& path, const std::string& made_by,
                 const TrailFile& wanted) {
  TELESTRAIN_RETURN_IF_ERROR(RequireRegular(file, path));
  const Error changed = BadInput(path + " was changed after " + made_by + " made it");
  if (path != kReport && HasOtherSize(file, wanted.bytes)) return changed;
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(file, kMostResultBytes));
  if (Sha256Hex(bytes) == wanted.sha256) return {};
  return path == kReport ? CheckSignedSince(bytes, made_by, wanted) : changed;
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

bool LiesInside(const std::string& path) {
  const fs::path parts(path);
  return !path.empty() && path.find('\0') == std::string::npos && !parts.is_absolute() &&
         std::find(parts.begin(), parts.end(), "..") == parts.end();
}

Status CheckPaths(const std::vector<AuditEntry>& entries) {
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (const char* list : {"/inputs", "/outputs"})
      for (const Json& file : ListAt(entries[i].body, list))
        if (const std::string path = TextAt(file, "/path"); !LiesInside(path))
          return BadInput(
              LineName(entries, i) + " of the audit trail names the file '" + path +
              "', which is no path inside the folder: it was not written by telestrain");
  return {};
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

// Where `render` drew pictures; empty for a film, which takes nothing away and goes for nothing.
std::string DrawnInto(const AuditEntry& entry) {
  const Json& out = EntryAt(entry.body, "/options/out");
  if (entry.type != "render" || !out.is_string()) return "";
  return out == "" ? "RESULTS/pictures" : out.get<std::string>();
}

// Whether the pictures of an entry gave way to a whole set that was drawn later; a single view
// takes no other away.
bool IsDrawnAnew(const std::vector<AuditEntry>& entries, std::size_t index) {
  const std::string place = DrawnInto(entries[index]);
  const auto after = entries.begin() + static_cast<std::ptrdiff_t>(index) + 1;
  return !place.empty() && std::any_of(after, entries.end(), [&](const AuditEntry& entry) {
    return DrawnInto(entry) == place && TextAt(entry.body, "/options/view").empty();
  });
}

bool IsAsMade(const fs::path& file, const std::string& path, const TrailFile& made) {
  return CheckFile(file, path, "", made).ok();
}

Result<std::size_t> CheckOutputs(const std::vector<AuditEntry>& entries, const fs::path& results) {
  std::size_t count = 0;
  for (const auto& [path, file] : LatestOutputs(entries)) {
    std::error_code code;
    const std::string made_by = LineName(entries, file.entry) + " of the audit trail";
    if (!fs::exists(results / path, code)) {
      if (IsSuperseded(entries, file.entry) || IsDrawnAnew(entries, file.entry)) continue;
      return BadInput(path + " is missing, which " + made_by + " made");
    }
    TELESTRAIN_RETURN_IF_ERROR(CheckFile(results / path, path, made_by, file));
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
    TELESTRAIN_RETURN_IF_ERROR(RequireRegular(session / path, "input " + path));
    const Error changed = BadInput("input " + path + " was changed after " +
                                   LineName(entries, open) + " of the audit trail read it");
    if (HasOtherSize(session / path, BytesOf(file))) return changed;
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string hash, Sha256HexOfFile(session / path));
    if (hash != TextAt(file, "/sha256")) return changed;
    ++count;
  }
  return count;
}

}  // namespace telestrain
