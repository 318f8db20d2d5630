#include <algorithm>
#include <cctype>

#include "report/result_cells.h"

namespace telestrain {
namespace {

constexpr const char* kBlanks = " \n\t";

bool HasDigit(const std::string& word) {
  return std::any_of(word.begin(), word.end(),
                     [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

// The part of `word` between the punctuation around it.
std::pair<std::size_t, std::size_t> CoreOf(const std::string& word) {
  const std::size_t begin = word.find_first_not_of("(\"");
  const std::size_t end = word.find_last_not_of(").,;:?!\"");
  return {begin, end + 1 - begin};
}

}  // namespace

std::string PrintedText(const Json& text) {
  if (text.is_object() && text.contains("printed")) return PrintedText(text.at("printed"));
  return text.is_string() ? text.get<std::string>() : "";
}

// The pattern is read once from left to right: a value that looks like a place stays as it is.
Json Phrase(const std::string& pattern, const std::map<std::string, Json>& values) {
  std::string printed;
  std::size_t at = 0;
  while (at < pattern.size()) {
    const std::size_t open = pattern.find("{{", at), close = pattern.find("}}", open);
    if (close == std::string::npos) break;
    printed += pattern.substr(at, open - at);
    const auto value = values.find(pattern.substr(open + 2, close - open - 2));
    printed +=
        value == values.end() ? pattern.substr(open, close + 2 - open) : PrintedText(value->second);
    at = close + 2;
  }
  printed += pattern.substr(at);
  return {{"printed", printed}, {"pattern", pattern}, {"values", values}};
}

Json PhraseOfText(const std::string& text) {
  std::string pattern;
  std::map<std::string, Json> values;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = std::min(text.find_first_not_of(kBlanks, at), text.size());
    const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    pattern += text.substr(at, begin - at);
    std::string word = text.substr(begin, end - begin);
    if (HasDigit(word)) {
      const std::string name = "v" + std::to_string(values.size() + 1);
      const auto [first, length] = CoreOf(word);
      values[name] = word.substr(first, length);
      word.replace(first, length, "{{" + name + "}}");
    }
    pattern += word;
    at = end;
  }
  return values.empty() ? Json(text) : Phrase(pattern, values);
}

Json ModelPhrase(const std::string& model) {
  if (const std::size_t comma = model.find(", "); comma != std::string::npos)
    return JoinPhrases({ModelPhrase(model.substr(0, comma)), ModelPhrase(model.substr(comma + 2))},
                       ", ");
  const std::string first = "aspect ", last = " telecentricity";
  if (model.size() > last.size() && model.ends_with(last))
    return Phrase("{{lens}} telecentricity",
                  {{"lens", ModelPhrase(model.substr(0, model.size() - last.size()))}});
  if (model.size() > first.size() && model.starts_with(first))
    return Phrase("aspect {{lens}}", {{"lens", ModelPhrase(model.substr(first.size()))}});
  return model;
}

Json JoinPhrases(const std::vector<Json>& parts, const std::string& separator) {
  std::string pattern;
  std::map<std::string, Json> values;
  Json last = "";
  for (const Json& part : parts) {
    if (PrintedText(part).empty()) continue;
    const std::string name = "v" + std::to_string(values.size() + 1);
    pattern += (values.empty() ? "" : separator) + "{{" + name + "}}";
    values[name] = last = part;
  }
  return values.size() < 2 ? last : Phrase(pattern, values);
}

}  // namespace telestrain
