#include "base/json_file.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/files.h"
#include "base/numbers.h"
#include "base/utf8.h"

namespace telestrain {
namespace {

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

// The first number beyond the limit.
const nlohmann::ordered_json* TooLargeIn(const nlohmann::ordered_json& json) {
  if (json.is_number_float() && std::abs(json.get<double>()) > kLargestJsonNumber) return &json;
  if (!json.is_structured()) return nullptr;
  for (const auto& child : json)
    if (const auto* found = TooLargeIn(child)) return found;
  return nullptr;
}

}  // namespace

std::string JsonProblem(const std::exception& e) {
  const std::string text = e.what();  // "[json.exception.type_error.302] type must be ..."
  const std::size_t end = text.find("] ");
  return text.starts_with("[json.exception") && end != std::string::npos ? text.substr(end + 2)
                                                                         : text;
}

Status CheckJsonText(std::string_view text, int deepest) {
  const std::size_t zero = text.find('\0');
  if (zero != std::string_view::npos)
    return BadInput("is not valid JSON: the byte at offset " + std::to_string(zero) + " is zero");
  if (IsJsonDeeper(text, deepest))
    return BadInput("is nested deeper than " + std::to_string(deepest) + " brackets");
  return {};
}

Result<nlohmann::ordered_json> ParseJson(std::string_view text) {
  TELESTRAIN_RETURN_IF_ERROR(CheckJsonText(text));
  try {
    auto json = nlohmann::ordered_json::parse(text);
    if (const auto* number = TooLargeIn(json))
      return BadInput("the number " + number->dump() + " is larger than any that is measured, " +
                      FormatShortest(kLargestJsonNumber));
    return json;
  } catch (const nlohmann::json::exception& e) {
    return BadInput(std::string("is not valid JSON: ") + JsonProblem(e));
  }
}

Result<nlohmann::ordered_json> ReadJson(const std::filesystem::path& path,
                                        const std::string& schema, const std::string& maker) {
  std::error_code code;
  const std::filesystem::path folder = path.parent_path();
  if (!folder.empty() && !std::filesystem::exists(folder, code) && !code)
    return BadInput(folder.string() + ": does not exist; correct the path, or run '" + maker +
                    "' first");
  if (!std::filesystem::exists(path, code))
    return BadInput(path.string() + ": does not exist; run '" + maker + "' first");
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(path, kMostJsonBytes));
  auto json = ParseJson(text);
  if (!json)
    return BadInput(path.string() + ": " + json.error().message + "; make the file again with '" +
                    maker + "'");
  const bool has_schema =
      json->is_object() && json->contains("schema") && (*json)["schema"].is_string();
  const std::string found = has_schema ? (*json)["schema"].get<std::string>() : "none";
  if (found != schema)
    return BadInput(path.string() + ": schema is '" + PrintableText(found) + "', wanted '" +
                    schema + "'; make the file again with '" + maker + "'");
  return json;
}

// A name of a file need not be UTF-8.
std::string JsonText(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Status WriteJson(const std::filesystem::path& path, const nlohmann::ordered_json& json) {
  return WriteFileAtomically(path, JsonText(json));
}

}  // namespace telestrain
