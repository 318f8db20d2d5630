#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace telestrain {

// Name below the export's folder, and bytes.
using NamedFiles = std::vector<std::pair<std::string, std::string>>;

// Writes the files of an export below `folder`, which is made when it does not exist, and returns
// their names for the user. With `is_index` pieces of an earlier export that the new index does not
// name are removed. Fails with kOutputFailed.
Result<std::string> WriteExportedFiles(const std::filesystem::path& folder, const NamedFiles& files,
                                       bool is_index);

}  // namespace telestrain
