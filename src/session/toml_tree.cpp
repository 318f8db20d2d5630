#include "session/toml_tree.h"

#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "base/numbers.h"
#include "base/utf8.h"

namespace telestrain {
namespace {

using Kind = TomlNode::Kind;

constexpr int kDeepestNesting = 8;
// Keeps chains of dotted keys far shorter than what overflows the stack of the TOML library.
constexpr std::size_t kLongestLine_bytes = 16384;

std::string PlaceOf(const std::string& file, toml::source_index line) {
  return file + ":" + std::to_string(std::max<toml::source_index>(line, 1)) + ": ";
}

template <typename Value>
std::string Streamed(const Value& value) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream << value;
  return stream.str();
}

void SetScalar(const toml::node& node, TomlNode& out) {
  if (const auto* text = node.as_string()) {
    out.kind = Kind::kText;
    out.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    out.kind = Kind::kInteger;
    out.number = static_cast<double>(integer->get());
    out.text = std::to_string(integer->get());
  } else if (const auto* number = node.as_floating_point()) {
    out.kind = Kind::kFloat;
    out.number = number->get() + 0.0;  // no minus zero: it would be written as zero
    out.text = TomlFloat(number->get());
  } else if (const auto* boolean = node.as_boolean()) {
    out.kind = Kind::kBoolean;
    out.text = boolean->get() ? "true" : "false";
  } else {
    out.kind = Kind::kDate;
    if (const auto* date = node.as_date()) out.text = Streamed(date->get());
    if (const auto* time = node.as_time()) out.text = Streamed(time->get());
    if (const auto* date_time = node.as_date_time()) out.text = Streamed(date_time->get());
  }
}

Status CheckLines(const std::string& file, const std::string& text) {
  std::size_t begin = 0;
  for (toml::source_index line = 1; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > kLongestLine_bytes)
      return BadInput(PlaceOf(file, line) + "the line has " + std::to_string(end - begin) +
                      " bytes, the limit is " + std::to_string(kLongestLine_bytes) +
                      "; break it into several lines");
    if (!IsValidUtf8(std::string_view(text).substr(begin, end - begin)))
      return BadInput(PlaceOf(file, line) +
                      "the line holds bytes that are not UTF-8; save the file as UTF-8");
    begin = end + 1;
  }
  return {};
}

// Throws an Error where tables or arrays are nested deeper than `depth_left`.
TomlNode Convert(const std::string& file, const toml::node& node, const std::string& path,
                 int depth_left) {
  TomlNode out;
  out.path = path;
  out.place = PlaceOf(file, node.source().begin.line);
  if (depth_left == 0)
    throw BadInput(out.place + "tables and arrays are nested more than " +
                   std::to_string(kDeepestNesting) + " deep; no key of a session is");
  if (const auto* table = node.as_table()) {
    std::vector<std::pair<toml::source_position, TomlNode>> members;
    for (const auto& [key, value] : *table) {
      const std::string name = PrintableText(key.str());
      TomlNode child =
          Convert(file, value, path.empty() ? name : path + "." + name, depth_left - 1);
      child.key = name;
      members.emplace_back(key.source().begin, std::move(child));
    }
    std::stable_sort(members.begin(), members.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& member : members) out.children.push_back(std::move(member.second));
  } else if (const auto* array = node.as_array()) {
    out.kind = Kind::kArray;
    for (const toml::node& item : *array)
      out.children.push_back(Convert(
          file, item, path + "[" + std::to_string(out.children.size() + 1) + "]", depth_left - 1));
  } else {
    SetScalar(node, out);
  }
  return out;
}

}  // namespace

const TomlNode* TomlNode::Find(const std::string& child_key) const {
  for (const TomlNode& child : children)
    if (child.key == child_key) return &child;
  return nullptr;
}

std::string TomlNode::Shown() const {
  switch (kind) {
    case Kind::kTable:
      return "a table";
    case Kind::kArray:
      return "an array of " + std::to_string(children.size()) + " values";
    case Kind::kText:
      return "'" + PrintableText(text) + "'";
    default:
      return text;
  }
}

std::string TomlFloat(double value) {
  std::string text = FormatShortest(value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";  // "n": inf and nan
  return text;
}

Result<TomlNode> ParseToml(const std::string& file, const std::string& text) {
  TELESTRAIN_RETURN_IF_ERROR(CheckLines(file, text));
  try {
    return Convert(file, toml::parse(text), "", kDeepestNesting);
  } catch (const Error& e) {
    return e;
  } catch (const toml::parse_error& e) {
    return BadInput(PlaceOf(file, e.source().begin.line) + "column " +
                    std::to_string(e.source().begin.column) +
                    ": is not valid TOML: " + std::string(e.description()) + "; correct this line");
  }
}

}  // namespace telestrain
