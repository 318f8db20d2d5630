#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "base/result.h"

namespace telestrain {

// Brackets deeper than this are in no file of ours; what works through JSON calls itself for each
// level and would run out of stack.
constexpr int kDeepestJson = 200;

// Whether brackets outside of strings are nested deeper, in time that grows with the text's length
// and no stack. To be asked before parsing what comes from outside.
bool IsJsonDeeper(std::string_view text, int deepest = kDeepestJson);

// Parses a JSON file of ours and checks its `schema` key. Fails (kBadInput) with path, offset and
// what to do; `maker` is the command that makes the file ("telestrain calibrate").
Result<nlohmann::ordered_json> ReadJson(const std::filesystem::path& path,
                                        const std::string& schema, const std::string& maker);

// Two-space indented text with a final line feed; doubles read back to the same value.
std::string JsonText(const nlohmann::ordered_json& json);
Status WriteJson(const std::filesystem::path& path, const nlohmann::ordered_json& json);

}  // namespace telestrain
