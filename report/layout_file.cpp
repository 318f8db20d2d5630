#include "report/layout_file.h"

#include <algorithm>
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

// The {{…}} of every text in it.
Status CheckTexts(const std::string& where, const std::string& pointer, const Json& json) {
  if (json.is_string())
    if (const auto fault = TextFault(json.get<std::string>()))
      return BadInput(where + ": " + pointer + ": " + *fault);
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
