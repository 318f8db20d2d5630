#include "report/text_filling.h"

#include <kainjow/mustache.hpp>
#include <string_view>

#include "base/check.h"

namespace telestrain {
namespace {

using Data = kainjow::mustache::data;

Data DataOf(const Json& json) {
  if (json.is_object()) {
    Data data(Data::type::object);
    for (const auto& [key, value] : json.items())
      if (!value.is_null() && value != "") data.set(key, DataOf(value));
    return data;
  }
  if (json.is_array()) {
    Data data(Data::type::list);
    for (const Json& value : json) data.push_back(DataOf(value));
    return data;
  }
  if (json.is_boolean()) return Data(json.get<bool>());
  return Data(TextAt(json, ""));
}

constexpr std::size_t kMostSections = 100;

// How many "{{", blanks apart, have one of `signs` behind them.
std::size_t TagsWith(const std::string& text, std::string_view signs) {
  std::size_t count = 0;
  for (std::size_t open = text.find("{{"); open != std::string::npos;
       open = text.find("{{", open + 1)) {
    const std::size_t sign = text.find_first_not_of(" \t\n\v\f\r", open + 2);
    if (sign != std::string::npos && signs.find(text[sign]) != std::string_view::npos) ++count;
  }
  return count;
}

}  // namespace

std::string FillText(const std::string& text, const Json& values) {
  if (text.find("{{") == std::string::npos) return text;
  kainjow::mustache::mustache pattern(text);
  TELESTRAIN_CHECK(pattern.is_valid(), "an unchecked text: " + text);
  pattern.set_custom_escape([](const std::string& value) { return value; });
  return pattern.render(DataOf(values));
}

std::optional<std::string> TextFault(const std::string& text) {
  if (text.find("{{") == std::string::npos) return {};
  if (text.find("{{/") < text.find("{{#") && text.find("{{/") < text.find("{{^"))
    return "'{{/' closes what no '{{#' or '{{^' opened; an entry is named {{document.number}}";
  if (TagsWith(text, "=") > 0)
    return "'{{=' changes the signs that names stand in, which no template may";
  // The library calls itself for each of them.
  if (TagsWith(text, "#^") > kMostSections)
    return "has more than " + std::to_string(kMostSections) + " of '{{#' and '{{^'; divide it";
  const kainjow::mustache::mustache pattern(text);
  if (pattern.is_valid()) return {};
  return pattern.error_message();
}

std::vector<TextName> PlacesInText(const std::string& text) {
  std::vector<TextName> places;
  std::vector<std::string> open_sections;
  std::set<std::string> guards;
  for (std::size_t open = text.find("{{"); open != std::string::npos;
       open = text.find("{{", open + 2)) {
    const std::string tag = text.substr(open + 2, text.find("}}", open) - open - 2);
    const std::string name = *NamesInText("{{" + tag + "}}").begin();
    const char kind = tag.empty() ? ' ' : tag[0];
    if (kind == '!') continue;
    if (kind == '/') {
      if (!open_sections.empty()) open_sections.pop_back();
      continue;
    }
    bool relative = false;
    for (const std::string& section : open_sections)
      relative = relative || section.find('.') == std::string::npos;
    places.push_back({name, !open_sections.empty(), relative});
    if (kind != '#' && kind != '^') continue;
    open_sections.push_back(name);
    guards.insert(name);
  }
  for (TextName& place : places) place.guarded = place.guarded || guards.count(place.name) > 0;
  return places;
}

std::set<std::string> NamesInText(const std::string& text) {
  std::set<std::string> names;
  for (std::size_t open = text.find("{{"); open != std::string::npos;
       open = text.find("{{", open + 2)) {
    const std::size_t close = text.find("}}", open);
    if (close == std::string::npos) break;
    std::string name = text.substr(open + 2, close - open - 2);
    name.erase(0, name.find_first_not_of("#^/&{ "));
    names.insert(name.substr(0, name.find_last_not_of("} ") + 1));
  }
  return names;
}

}  // namespace telestrain
