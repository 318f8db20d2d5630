#include "base/json_file.h"

#include <nlohmann/json.hpp>
#include <system_error>

#include "base/files.h"
#include "base/utf8.h"

namespace telestrain {

bool IsJsonDeeper(std::string_view text, int deepest) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') ++i;
    if (c == '"') in_string = !in_string;
    if (in_string) continue;
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth > deepest) return true;
  }
  return false;
}

Result<nlohmann::ordered_json> ReadJson(const std::filesystem::path& path,
                                        const std::string& schema, const std::string& maker) {
  std::error_code code;
  if (!std::filesystem::exists(path, code))
    return BadInput(path.string() + ": does not exist; run '" + maker + "' first");
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(path, kMostJsonBytes));
  if (IsJsonDeeper(text))
    return BadInput(path.string() + ": is nested deeper than " + std::to_string(kDeepestJson) +
                    " brackets; make the file again with '" + maker + "'");
  try {
    auto json = nlohmann::ordered_json::parse(text);
    const bool has_schema =
        json.is_object() && json.contains("schema") && json["schema"].is_string();
    const std::string found = has_schema ? json["schema"].get<std::string>() : "none";
    if (found != schema)
      return BadInput(path.string() + ": schema is '" + PrintableText(found) + "', wanted '" +
                      schema + "'; make the file again with '" + maker + "'");
    return json;
  } catch (const nlohmann::json::exception& e) {
    return BadInput(path.string() + ": is not valid JSON: " + e.what() +
                    "; make the file again with '" + maker + "'");
  }
}

std::string JsonText(const nlohmann::ordered_json& json) { return json.dump(2) + "\n"; }

Status WriteJson(const std::filesystem::path& path, const nlohmann::ordered_json& json) {
  return WriteFileAtomically(path, JsonText(json));
}

}  // namespace telestrain
