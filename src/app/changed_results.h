#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace telestrain {

// The files that a report's results are read from.
inline const std::vector<std::string> kMeasuredFiles{
    "inputs.json",     "detection.json", "calibration.json", "mrcal.json",
    "comparison.json", "ruler.json",     "strain.json"};

// Those of the files that the results folder's audit.jsonl knows with another SHA-256: "PATH: was
// changed since 'telestrain VERB' wrote it". None without a trail or with a damaged one, which
// other checks name.
std::vector<std::string> ChangesSinceRecorded(const std::filesystem::path& results,
                                              const std::vector<std::string>& names);

// Fails (kBadInput) when the folder's audit.jsonl is damaged, or when a file that it knows is
// missing or was changed, a report.pdf other than by signatures: nobody may certify or sign that. A
// folder without a trail tells nothing.
Status RequireAsRecorded(const std::filesystem::path& results);

}  // namespace telestrain
