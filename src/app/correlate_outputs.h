#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace telestrain {

// A name without ending for the results of every image: its file's stem. Where an earlier image or
// the assessment (`pattern`) has that name already, _2, _3, … is added, upper and lower case taken
// as one for the sake of file systems that do so.
std::vector<std::string> OutputStems(const std::vector<std::string>& images);

// Fails (kUsage) when a result would take the place of one of the inputs.
Status CheckOutputs(const std::filesystem::path& folder, const std::vector<std::string>& stems,
                    const std::vector<std::filesystem::path>& inputs);

}  // namespace telestrain
