#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace telestrain {

using Json = nlohmann::ordered_json;

// Reading of results that may be incomplete: nothing here throws for a missing or differently
// typed entry. `pointer` is a JSON pointer ("/reprojection/rms_px").

// The entry, or null JSON when it is not there.
const Json& EntryAt(const Json& json, const std::string& pointer);
// A finite number, or nothing.
std::optional<double> NumberAt(const Json& json, const std::string& pointer);
// A text; numbers and booleans are given as their JSON text, cells and Phrases as they are printed.
std::string TextAt(const Json& json, const std::string& pointer, const std::string& otherwise = "");
// An array, or an empty one.
const Json& ListAt(const Json& json, const std::string& pointer);
// The first element of `list` whose `key` is the text `wanted`, or null JSON.
const Json& FindBy(const Json& list, const std::string& key, const std::string& wanted);

}  // namespace telestrain
