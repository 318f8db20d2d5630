#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace telestrain::fuzz {

// One change of a JSON value inside `input` that keeps it JSON: a value becomes one of another type
// or an unlikely number, a member goes, comes twice or swaps with another. Of an input of several
// files (FilesIn) one is changed. Nothing when no part of the input is JSON.
std::optional<std::string> MutateJson(const std::string& input, std::uint64_t seed);

}  // namespace telestrain::fuzz
