#include "report/json_lookup.h"

#include <cmath>

namespace telestrain {
namespace {

const Json& Nothing() {
  static const Json nothing;
  return nothing;
}

}  // namespace

const Json& EntryAt(const Json& json, const std::string& pointer) {
  try {
    const Json::json_pointer path(pointer);
    return json.contains(path) ? json.at(path) : Nothing();
  } catch (const nlohmann::json::exception&) {
    return Nothing();
  }
}

std::optional<double> NumberAt(const Json& json, const std::string& pointer) {
  const Json& entry = EntryAt(json, pointer);
  if (!entry.is_number()) return {};
  const double value = entry.get<double>();
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

std::string TextAt(const Json& json, const std::string& pointer, const std::string& otherwise) {
  const Json& entry = EntryAt(json, pointer);
  if (entry.is_string()) return entry.get<std::string>();
  if (entry.is_object() && entry.contains("printed")) return TextAt(entry, "/printed", otherwise);
  if (entry.is_number() || entry.is_boolean()) return entry.dump();
  return otherwise;
}

const Json& ListAt(const Json& json, const std::string& pointer) {
  static const Json empty = Json::array();
  const Json& entry = EntryAt(json, pointer);
  return entry.is_array() ? entry : empty;
}

const Json& FindBy(const Json& list, const std::string& key, const std::string& wanted) {
  for (const Json& element : list)
    if (element.is_object() && element.contains(key) && element[key] == wanted) return element;
  return Nothing();
}

}  // namespace telestrain
