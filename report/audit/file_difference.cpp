#include "report/audit/file_difference.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/json_file.h"
#include "base/utf8.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

// More of a value than this helps nobody.
constexpr std::size_t kLongestValue = 60;

std::string Shortened(const std::string& text) {
  const std::string_view first = FirstCharacters(text, kLongestValue);
  return first.size() < text.size() ? std::string(first) + "…" : text;
}

std::string ValueText(const Json& value) {
  return Shortened(value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

// The first pointer at which the two differ, in the order of `found`. The texts differ, so when the
// values do not, only the writing does.
std::string DifferenceOfJson(const Json& found, const Json& again) {
  const Json flat = found.flatten(), flat_again = again.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    const auto other = flat_again.find(pointer);
    if (other == flat_again.end()) return pointer + " is new: " + ValueText(value);
    if (*other != value)
      return pointer + " is " + ValueText(value) + ", made again " + ValueText(*other);
  }
  for (const auto& [pointer, value] : flat_again.items())
    if (!flat.contains(pointer)) return pointer + " is missing, made again " + ValueText(value);
  return "the same values are written otherwise";
}

std::string LineAt(const std::string& text, std::size_t begin) {
  return begin < text.size() ? text.substr(begin, text.find('\n', begin) - begin) : "";
}

std::string DifferenceOfLines(const std::string& found, const std::string& again, std::size_t at) {
  const auto line =
      1 + std::count(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  const std::size_t before = at == 0 ? std::string::npos : found.rfind('\n', at - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return "line " + std::to_string(line) + " is '" + Shortened(LineAt(found, begin)) +
         "', made again '" + Shortened(LineAt(again, begin)) + "'";
}

bool IsText(const std::string& bytes) { return bytes.find('\0') == std::string::npos; }

}  // namespace

std::string FirstDifference(const std::string& name, const std::string& found,
                            const std::string& again) {
  if (found == again) return "";
  if (name.ends_with(".json")) {
    const auto a = ParseJson(found), b = ParseJson(again);
    if (a && b) return DifferenceOfJson(*a, *b);
  }
  const auto apart = std::mismatch(found.begin(), found.end(), again.begin(), again.end()).first;
  const auto at = static_cast<std::size_t>(apart - found.begin());
  if (!name.ends_with(".pdf") && IsText(found) && IsText(again))
    return DifferenceOfLines(found, again, at);
  return "byte " + std::to_string(at) + " is another; it has " + std::to_string(found.size()) +
         " bytes, made again " + std::to_string(again.size());
}

}  // namespace telestrain
