#include "report/layout_file.h"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "base/numbers.h"
#include "report/json_schema.h"
#include "report/text_filling.h"

namespace telestrain {
namespace {

const Json& LayoutSchema() { return BuiltInSchema("template.schema.json"); }

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string Unknown(const std::string& name, const std::string& word,
                    const std::vector<std::string>& known) {
  return "there is no {{" + name + "}}; did you mean '" + NearestWord(word, known) + "'?";
}

// What is wrong with a name that nothing fills. Entries of [document] are the user's own, and what
// other parts hold depends on what was measured.
std::optional<std::string> NameFault(const std::string& name, bool in_frame) {
  static const std::map<std::string, std::vector<std::string>> kEntries = {
      {"report", {"title", "number", "revision"}}, {"file", {"results_sha256"}}};
  static const std::vector<std::string> kWords = {
      "page",      "pages", "report", "section", "document", "decision", "sentences", "measured",
      "diagnosis", "file",  "title",  "verdict", "schema",   "study"};  // of a study's report
  const std::size_t dot = name.find('.');
  const std::string word = name.substr(0, dot);
  if (!Contains(kWords, word)) return Unknown(name, word, kWords);
  if ((word == "page" || word == "pages") && !in_frame)
    return "{{" + name + "}} is known in the header and the footer only";
  const auto entries = kEntries.find(word);
  if (entries == kEntries.end() || dot == std::string::npos) return {};
  const std::string entry = name.substr(dot + 1);
  if (Contains(entries->second, entry)) return {};
  return Unknown(name, entry, entries->second);
}

std::optional<std::string> NamesFault(const std::string& text, const std::string& pointer) {
  const bool in_frame = pointer.rfind("/header", 0) == 0 || pointer.rfind("/footer", 0) == 0;
  for (const TextName& place : PlacesInText(text))
    if (!place.relative)
      if (auto fault = NameFault(place.name, in_frame)) return fault;
  return {};
}

// A label may name what its text names, and nothing else.
Status CheckLabels(const std::string& where, const Json& labels) {
  if (!labels.is_object()) return {};
  for (const auto& [text, wording] : labels.items()) {
    const std::set<std::string> names = NamesInText(text);
    for (const std::string& name : NamesInText(wording.get<std::string>()))
      if (names.count(name) == 0)
        return BadInput(where + ": /labels/" + PointerStep(text) + ": names {{" + name +
                        "}}, which its text does not");
  }
  return {};
}

// The {{…}} of every text in it.
Status CheckTexts(const std::string& where, const std::string& pointer, const Json& json) {
  if (json.is_string()) {
    auto fault = TextFault(json.get<std::string>());
    if (!fault && pointer.rfind("/labels/", 0) != 0)
      fault = NamesFault(json.get<std::string>(), pointer);
    if (fault) return BadInput(where + ": " + pointer + ": " + *fault);
  }
  if (json.is_object())
    for (const auto& [key, value] : json.items())
      TELESTRAIN_RETURN_IF_ERROR(CheckTexts(where, pointer + "/" + PointerStep(key), value));
  if (json.is_array())
    for (std::size_t i = 0; i < json.size(); ++i)
      TELESTRAIN_RETURN_IF_ERROR(CheckTexts(where, pointer + "/" + std::to_string(i), json[i]));
  return {};
}

// Puts the sections in the place of their includes.
class Includer {
 public:
  explicit Includer(const TemplateFolder& folder) : folder_(folder) {}

  // `pointer` is that of the list `blocks` in the file `where`.
  Result<Json> Expand(const std::string& where, const std::string& pointer, const Json& blocks) {
    Json expanded = Json::array();
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (!blocks[i].contains("include")) {
        expanded.push_back(blocks[i]);
        continue;
      }
      const std::string place = where + ": " + pointer + "/" + std::to_string(i) + "/include: ";
      TELESTRAIN_ASSIGN_OR_RETURN(const Json section,
                                  Section(place, blocks[i]["include"].get<std::string>()));
      for (const Json& block : section) expanded.push_back(block);
    }
    return expanded;
  }

 private:
  Result<Json> Section(const std::string& place, const std::string& name) {
    const std::vector<std::string> known = folder_.Names("sections");
    if (!Contains(known, name))
      return BadInput(place + "there is no sections/" + name + ".json; did you mean '" +
                      NearestWord(name, known) + "'?");
    if (Contains(open_, name)) return BadInput(place + "'" + name + "' includes itself");
    TELESTRAIN_ASSIGN_OR_RETURN(const TemplateFile file,
                                folder_.Read("sections/" + name + ".json"));
    TELESTRAIN_ASSIGN_OR_RETURN(const Json blocks, ParseTemplate(file));
    TELESTRAIN_RETURN_IF_ERROR(
        CheckAgainstSchema(LayoutSchema(), "#/$defs/blocks", file.where, blocks));
    TELESTRAIN_RETURN_IF_ERROR(CheckTexts(file.where, "", blocks));
    open_.push_back(name);
    auto expanded = Expand(file.where, "", blocks);
    open_.pop_back();
    return expanded;
  }

  const TemplateFolder& folder_;
  std::vector<std::string> open_;  // the sections around the present one
};

}  // namespace

Result<Json> ReadLayout(const TemplateFolder& folder, const TemplateFile& file) {
  TELESTRAIN_ASSIGN_OR_RETURN(Json layout, ParseTemplate(file));
  TELESTRAIN_RETURN_IF_ERROR(CheckAgainstSchema(LayoutSchema(), "#", file.where, layout));
  TELESTRAIN_RETURN_IF_ERROR(CheckTexts(file.where, "", layout));
  TELESTRAIN_RETURN_IF_ERROR(CheckLabels(file.where, EntryAt(layout, "/labels")));
  TELESTRAIN_ASSIGN_OR_RETURN(Json blocks,
                              Includer(folder).Expand(file.where, "/blocks", layout["blocks"]));
  layout["blocks"] = std::move(blocks);
  return layout;
}

Result<Json> ReadNamedLayout(const TemplateFolder& folder, const std::string& name) {
  const std::vector<std::string> known = folder.Names("");
  if (!Contains(known, name))
    return Error{ErrorKind::kUsage, "there is no layout '" + name + "'; did you mean '" +
                                        NearestWord(name, known) +
                                        "'? 'telestrain report --list' names them"};
  TELESTRAIN_ASSIGN_OR_RETURN(const TemplateFile file, folder.Read(name + ".json"));
  return ReadLayout(folder, file);
}

}  // namespace telestrain
