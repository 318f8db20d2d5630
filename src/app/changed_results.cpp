#include "app/changed_results.h"

#include "base/files.h"
#include "report/audit/audit_trail.h"
#include "report/audit/trail_files.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

// The entry "open" is that of `detect`, "results" that of `report`.
std::string VerbOf(const std::string& type) {
  return type == "open" ? "detect" : type == "results" ? "report" : type;
}

}  // namespace

std::vector<std::string> ChangesSinceRecorded(const fs::path& results,
                                              const std::vector<std::string>& names) {
  std::vector<std::string> sentences;
  const fs::path trail = results / "audit.jsonl";
  std::error_code code;
  if (!fs::exists(trail, code)) return sentences;
  const auto text = ReadFile(trail, kMostLogBytes);
  if (!text) return sentences;
  const auto entries = ReadAuditTrail(trail.string(), *text);
  if (!entries) return sentences;
  const auto recorded = LatestOutputs(*entries);
  for (const std::string& name : names) {
    const auto known = recorded.find(name);
    if (known == recorded.end() || !fs::exists(results / name, code)) continue;
    const auto hash = Sha256HexOfFile(results / name);
    if (hash && *hash != known->second.sha256)
      sentences.push_back((results / name).string() + ": was changed since 'telestrain " +
                          VerbOf((*entries)[known->second.entry].type) + "' wrote it");
  }
  return sentences;
}

Status RequireAsRecorded(const fs::path& results) {
  const fs::path trail = results / "audit.jsonl";
  std::error_code code;
  if (!fs::exists(trail, code)) return {};
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(trail, kMostLogBytes));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto entries, ReadAuditTrail(trail.string(), text));
  Status fits = CheckPaths(entries);
  if (fits) {
    const auto files = CheckOutputs(entries, results);
    if (!files) fits = files.error();
  }
  if (fits) return {};
  return BadInput(results.string() + ": " + fits.error().message +
                  "; put that file back, or do that step and those after it again");
}

}  // namespace telestrain
