#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/result.h"

namespace telestrain {

// Parses a JSON file of ours and checks its `schema` key. Fails (kBadInput) with path, offset and
// what to do; `maker` is the command that makes the file ("telestrain calibrate").
Result<nlohmann::ordered_json> ReadJson(const std::filesystem::path& path,
                                        const std::string& schema, const std::string& maker);

// Two-space indented text with a final line feed; doubles read back to the same value.
std::string JsonText(const nlohmann::ordered_json& json);
Status WriteJson(const std::filesystem::path& path, const nlohmann::ordered_json& json);

}  // namespace telestrain
