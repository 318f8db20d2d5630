#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace telestrain {

// What is in a results folder but of the decision.
inline const std::vector<std::string> kMeasuredFiles{
    "inputs.json", "detection.json", "calibration.json", "mrcal.json", "ruler.json", "strain.json"};

// Those of the files that the results folder's audit.jsonl knows with another SHA-256: "PATH: was
// changed since 'telestrain VERB' wrote it". None without a trail or with a damaged one, which
// other checks name.
std::vector<std::string> ChangesSinceRecorded(const std::filesystem::path& results,
                                              const std::vector<std::string>& names);

// Fails (kBadInput) when one of them was changed: nobody may certify or sign that.
Status RequireAsRecorded(const std::filesystem::path& results);

}  // namespace telestrain
