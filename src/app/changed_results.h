#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace telestrain {

// What `report` reads in a results folder and its audit.jsonl knows with another SHA-256: a
// sentence for each file. None without a trail or with a damaged one, which other checks name.
std::vector<std::string> ChangesSinceRecorded(const std::filesystem::path& results);

}  // namespace telestrain
