#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "report/audit/audit_trail.h"

namespace telestrain {

// What an audit trail says about files, and whether that is so. Failures (kBadInput) are one
// sentence that names the file and the line of the trail.

// A file that an entry made in the results folder.
struct TrailFile {
  std::string sha256;
  std::size_t bytes = 0;
  std::size_t entry = 0;  // its index: the latest that made the file
};
// By the path inside the results folder.
std::map<std::string, TrailFile> LatestOutputs(const std::vector<AuditEntry>& entries);

// "line 5 (verify)".
std::string LineName(const std::vector<AuditEntry>& entries, std::size_t index);

// Whether the file that the trail calls `path` is as it was made; a report.pdf may have been signed
// since, as for CheckOutputs.
bool IsAsMade(const std::filesystem::path& file, const std::string& path, const TrailFile& made);

// Every path of an entry's inputs and outputs lies inside the folder it is of: relative, without
// "..". A trail is a file that anybody may have written; ask this before any of its paths is
// opened.
Status CheckPaths(const std::vector<AuditEntry>& entries);
bool LiesInside(const std::string& path);

// Every entry read the files that entries before it had made: none was exchanged between two steps.
Status CheckStory(const std::vector<AuditEntry>& entries);

// The files in the folder are as the latest entries made them; one may be missing only where a
// later step took it away. A report.pdf that was signed since begins as it was made, with updates
// from there on that are laid out as signatures are: whether they hold is asked elsewhere. The
// value is how many there are.
Result<std::size_t> CheckOutputs(const std::vector<AuditEntry>& entries,
                                 const std::filesystem::path& results);

// The session's files are as the latest "open" read them. The value is how many there are.
Result<std::size_t> CheckInputs(const std::vector<AuditEntry>& entries,
                                const std::filesystem::path& session);

}  // namespace telestrain
