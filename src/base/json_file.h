#pragma once

#include <exception>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "base/result.h"

namespace telestrain {

// Brackets deeper than this are in no file of ours; what works through JSON calls itself for each
// level and would run out of stack.
constexpr int kDeepestJson = 200;

// Nothing that is measured or counted is larger, and products of a few such numbers are finite.
constexpr double kLargestJsonNumber = 1e100;

// Fails (kBadInput, without a name of the file) where a text is unfit for the parser: brackets
// outside of strings are nested deeper, or a byte is zero, which the parser takes for the end.
// Takes time that grows with the text's length and no stack. To be asked before parsing what comes
// from outside.
Status CheckJsonText(std::string_view text, int deepest = kDeepestJson);

// Parses JSON from outside. Fails (kBadInput) without a name of the file: "is not valid JSON: ...",
// "is nested deeper than ...", "... is larger than any number that is measured".
Result<nlohmann::ordered_json> ParseJson(std::string_view text);

// Parses a JSON file of ours and checks its `schema` key. Fails (kBadInput) with path, offset and
// what to do; `maker` is the command that makes the file ("telestrain calibrate").
Result<nlohmann::ordered_json> ReadJson(const std::filesystem::path& path,
                                        const std::string& schema, const std::string& maker);

// What an exception of the JSON library says, without the tag that it puts before.
std::string JsonProblem(const std::exception& e);

// Two-space indented text with a final line feed; doubles read back to the same value, bytes that
// are not UTF-8 as U+FFFD.
std::string JsonText(const nlohmann::ordered_json& json);
Status WriteJson(const std::filesystem::path& path, const nlohmann::ordered_json& json);

}  // namespace telestrain
