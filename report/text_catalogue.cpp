#include "report/text_catalogue.h"

#include <cctype>

#include "base/numbers.h"
#include "report/json_schema.h"
#include "report/text_filling.h"

namespace telestrain {
namespace {

std::string NameList(const std::set<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += " {{" + name + "}}";
  return list.empty() ? " none" : list;
}

// Only what holds a letter outside its {{…}} can be translated.
bool HasLetter(const std::string& text) {
  int depth = 0;
  for (const unsigned char c : text) {
    depth += c == '{' ? 1 : c == '}' ? -1 : 0;
    if (depth == 0 && c < 0x80 && std::isalpha(c) != 0) return true;
  }
  return false;
}

}  // namespace

Result<TextCatalogue> TextCatalogue::Load(const TemplateFolder& folder,
                                          const std::string& language) {
  TextCatalogue catalogue;
  catalogue.language_ = language;
  const std::string name = "texts/" + language + ".json";
  TELESTRAIN_ASSIGN_OR_RETURN(const TemplateFile own, folder.ReadOwn(name));
  const TemplateFile built_in = TemplateFolder::BuiltIn(name);
  if (own.where.empty() && built_in.where.empty() && language != "en") {
    std::vector<std::string> known = folder.Names("texts");
    known.push_back("en");
    return Error{ErrorKind::kUsage, "there is no language '" + language + "'; did you mean '" +
                                        NearestWord(language, known) +
                                        "'? 'telestrain report --list' names them"};
  }
  for (const TemplateFile& file : {built_in, own})
    if (!file.where.empty()) TELESTRAIN_RETURN_IF_ERROR(catalogue.Add(file, language));
  return catalogue;
}

Status TextCatalogue::Add(const TemplateFile& file, const std::string& language) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json json, ParseTemplate(file));
  TELESTRAIN_RETURN_IF_ERROR(
      CheckAgainstSchema(BuiltInSchema("texts.schema.json"), "#", file.where, json));
  if (json["language"] != language)
    return BadInput(file.where + ": /language: is '" + TextAt(json, "/language") +
                    "', wanted that of the file's name, '" + language + "'");
  for (const auto& [pattern, entry] : json["texts"].items()) {
    const std::string pointer = ": /texts/" + PointerStep(pattern) + ": ";
    const std::string text = entry.get<std::string>();
    if (const auto fault = TextFault(text)) return BadInput(file.where + pointer + *fault);
    if (NamesInText(text) != NamesInText(pattern))
      return BadInput(file.where + pointer + "holds the names" + NameList(NamesInText(text)) +
                      ", wanted" + NameList(NamesInText(pattern)));
    texts_[pattern] = text;
  }
  between_sentences_ = TextAt(json, "/between_sentences", between_sentences_);
  return {};
}

void TextCatalogue::AddLabels(const Json& labels) {
  if (!labels.is_object()) return;
  for (const auto& [text, wording] : labels.items()) labels_[text] = wording.get<std::string>();
}

std::optional<std::string> TextCatalogue::Find(const std::string& text) const {
  for (const auto* texts : {&labels_, &texts_})
    if (const auto found = texts->find(text); found != texts->end()) return found->second;
  return {};
}

std::string TextCatalogue::Say(const std::string& text) const {
  const auto found = Find(text);
  if (!found && on_untranslated && language_ != "en" && HasLetter(text)) on_untranslated(text);
  return found.value_or(text);
}

std::string TextCatalogue::SayCell(const Json& cell) const {
  if (cell.is_object() && cell.contains("pattern")) return SayPhrase(cell);
  if (EntryAt(cell, "/printed").is_object()) return SayPhrase(cell["printed"]);
  const std::string text = cell.is_object() ? TextAt(cell, "/printed") : TextAt(cell, "");
  return Find(text).value_or(text);
}

std::string TextCatalogue::SayPhrase(const Json& phrase) const {
  if (phrase.is_array()) {
    std::string paragraph;
    for (const Json& sentence : phrase) {
      const std::string said = SayPhrase(sentence);
      if (!said.empty()) paragraph += (paragraph.empty() ? "" : between_sentences_) + said;
    }
    return paragraph;
  }
  if (!phrase.is_object()) return Say(TextAt(phrase, ""));
  if (!phrase.contains("pattern")) return Say(TextAt(phrase, "/printed"));
  Json values = Json::object();
  const Json& given = EntryAt(phrase, "/values");
  if (given.is_object())
    for (const auto& [name, value] : given.items()) values[name] = SayCell(value);
  const std::string text = Say(TextAt(phrase, "/pattern"));
  // A sentence that came from outside may hold braces of its own.
  return TextFault(text) ? TextAt(phrase, "/printed") : FillText(text, values);
}

}  // namespace telestrain
