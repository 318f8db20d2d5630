#include "report/template_list.h"

#include <algorithm>

#include "report/layout_file.h"
#include "report/report_template.h"
#include "report/template_folder.h"

namespace telestrain {
namespace {

Result<Json> ReadJsonOf(const TemplateFolder& folder, const std::string& name) {
  TELESTRAIN_ASSIGN_OR_RETURN(const TemplateFile file, folder.Read(name));
  return ParseTemplate(file);
}

// A file that cannot be read does not hide the others.
std::vector<NamedTemplate> Listed(const TemplateFolder& folder, const std::string& in,
                                  const char* title) {
  std::vector<NamedTemplate> list;
  for (const std::string& name : folder.Names(in)) {
    const auto json = ReadJsonOf(folder, (in.empty() ? "" : in + "/") + name + ".json");
    if (json)
      list.push_back({name, TextAt(*json, title), ""});
    else
      list.push_back({name, "", json.error().message});
  }
  return list;
}

void CollectPictures(const Json& blocks, std::set<std::string>& pictures) {
  if (TextAt(blocks, "/type") == "picture") pictures.insert(TextAt(blocks, "/file"));
  if (!blocks.is_structured()) return;
  for (const Json& block : blocks) CollectPictures(block, pictures);
}

}  // namespace

Result<TemplateList> ListTemplates(const std::filesystem::path& folder) {
  TELESTRAIN_ASSIGN_OR_RETURN(const TemplateFolder templates, TemplateFolder::Open(folder));
  TemplateList list;
  list.layouts = Listed(templates, "", "/title");
  list.languages = Listed(templates, "texts", "/name");
  const auto is_english = [](const NamedTemplate& language) { return language.name == "en"; };
  if (std::none_of(list.languages.begin(), list.languages.end(), is_english))
    list.languages.push_back({"en", "English", ""});
  std::sort(list.languages.begin(), list.languages.end(),
            [](const NamedTemplate& a, const NamedTemplate& b) { return a.name < b.name; });
  return list;
}

Result<LayoutScope> ScopeOfLayout(const ReportOptions& options) {
  TELESTRAIN_ASSIGN_OR_RETURN(
      const ReportTemplate layout,
      ReportTemplate::Load({options.templates, options.name, options.language}));
  LayoutScope found;
  found.scope.name = options.name;
  for (const Json& section : ListAt(layout.json(), "/scope/sections"))
    found.scope.sections.push_back(section.get<std::string>());
  const Json& limits = EntryAt(layout.json(), "/limits");
  if (limits.is_object())
    for (const auto& [key, limit] : limits.items()) found.scope.limits[key] = limit.get<double>();
  found.against_earlier = EntryAt(layout.json(), "/scope/against_earlier") == true;
  CollectPictures(layout.blocks(), found.pictures);
  return found;
}

}  // namespace telestrain
