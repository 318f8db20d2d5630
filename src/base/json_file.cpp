#include "base/json_file.h"

#include <nlohmann/json.hpp>
#include <system_error>

#include "base/files.h"

namespace telestrain {

Result<nlohmann::ordered_json> ReadJson(const std::filesystem::path& path,
                                        const std::string& schema, const std::string& maker) {
  std::error_code code;
  if (!std::filesystem::exists(path, code))
    return BadInput(path.string() + ": does not exist; run '" + maker + "' first");
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(path));
  try {
    auto json = nlohmann::ordered_json::parse(text);
    const std::string found = json.is_object() ? json.value("schema", std::string("none")) : "none";
    if (found != schema)
      return BadInput(path.string() + ": schema is '" + found + "', wanted '" + schema +
                      "'; make the file again with '" + maker + "'");
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
