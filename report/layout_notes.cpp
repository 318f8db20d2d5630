#include "report/layout_notes.h"

#include <set>

#include "base/numbers.h"
#include "report/built_in_files.h"
#include "report/text_filling.h"

namespace telestrain {
namespace {

// Every text in it except those below the key `without`.
void CollectTexts(const Json& json, const std::string& without, std::set<std::string>& texts) {
  if (json.is_string()) texts.insert(json.get<std::string>());
  if (json.is_array())
    for (const Json& entry : json) CollectTexts(entry, without, texts);
  if (json.is_object())
    for (const auto& [key, entry] : json.items())
      if (key != without) CollectTexts(entry, without, texts);
}

// A built-in section leaves out what the session does not say.
std::set<std::string> BuiltInTexts() {
  std::set<std::string> texts;
  for (const BuiltInFile& file : BuiltInFiles())
    if (file.name.find("texts/") == std::string::npos)
      CollectTexts(Json::parse(file.text), "", texts);
  return texts;
}

// The texts that the program and its layouts print, as a complete language has them.
std::set<std::string> PrintedTexts() {
  std::set<std::string> texts;
  const Json german = Json::parse(TemplateFolder::BuiltIn("texts/de.json").text);
  for (const auto& [text, translation] : german["texts"].items()) texts.insert(text);
  return texts;
}

void NoteLabels(const ReportTemplate& layout, const Json& results,
                std::vector<std::string>& notes) {
  const Json& labels = EntryAt(layout.json(), "/labels");
  if (!labels.is_object()) return;
  std::set<std::string> known = PrintedTexts();
  CollectTexts(layout.json(), "labels", known);
  CollectTexts(results, "", known);
  const std::vector<std::string> words(known.begin(), known.end());
  for (const auto& [text, wording] : labels.items())
    if (known.count(text) == 0)
      notes.push_back("the label '" + text + "' changes no text; did you mean '" +
                      NearestWord(text, words) + "'?");
}

void NoteDocument(const ReportTemplate& layout, const Json& results,
                  std::vector<std::string>& notes) {
  std::set<std::string> texts;
  CollectTexts(layout.json(), "labels", texts);
  for (const std::string& text : BuiltInTexts()) texts.erase(text);
  std::vector<std::string> keys;
  const Json& document = EntryAt(results, "/document");
  if (document.is_object())
    for (const auto& [key, value] : document.items()) keys.push_back(key);
  std::set<std::string> missing;
  const std::string prefix = "document.";
  for (const std::string& text : texts)
    for (const TextName& place : PlacesInText(text))
      if (!place.guarded && place.name.rfind(prefix, 0) == 0)
        missing.insert(place.name.substr(prefix.size()));
  for (const std::string& key : keys) missing.erase(key);
  for (const std::string& key : missing)
    notes.push_back("{{document." + key + "}} is empty: [document] of the session has no '" + key +
                    "'" + (keys.empty() ? "" : "; nearest is '" + NearestWord(key, keys) + "'"));
}

}  // namespace

std::vector<std::string> LayoutNotes(const ReportTemplate& layout, const Json& results) {
  std::vector<std::string> notes;
  NoteLabels(layout, results, notes);
  NoteDocument(layout, results, notes);
  return notes;
}

}  // namespace telestrain
