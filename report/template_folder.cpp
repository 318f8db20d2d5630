#include "report/template_folder.h"

#include <map>
#include <set>

#include "base/check.h"
#include "base/files.h"
#include "base/json_file.h"
#include "report/built_in_files.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSuffix = ".json";
constexpr const char* kSchemaSuffix = ".schema.json";

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// "texts/de.json" in "texts" is "de"; what is no template of that folder is empty.
std::string NameIn(const std::string& folder, const std::string& file) {
  const std::string begin = folder.empty() ? "" : folder + "/";
  if (file.compare(0, begin.size(), begin) != 0) return "";
  if (!EndsWith(file, kSuffix) || EndsWith(file, kSchemaSuffix)) return "";
  const std::string name =
      file.substr(begin.size(), file.size() - begin.size() - std::string(kSuffix).size());
  return name.find('/') == std::string::npos ? name : "";
}

}  // namespace

Result<TemplateFolder> TemplateFolder::Open(const fs::path& own) {
  std::error_code code;
  if (!own.empty() && !fs::is_directory(own, code))
    return BadInput(own.string() +
                    ": is no folder; name one with your own NAME.json, sections/ or texts/");
  TemplateFolder folder;
  folder.own_ = own;
  return folder;
}

TemplateFile TemplateFolder::BuiltIn(const std::string& name) {
  for (const BuiltInFile& file : BuiltInFiles())
    if (file.name == name) return {"built-in " + name, std::string(file.text)};
  return {};
}

Result<TemplateFile> TemplateFolder::ReadOwn(const std::string& name) const {
  std::error_code code;
  if (own_.empty() || !fs::exists(own_ / name, code)) return TemplateFile{};
  TELESTRAIN_ASSIGN_OR_RETURN(std::string text, ReadFile(own_ / name));
  return TemplateFile{(own_ / name).string(), std::move(text)};
}

Result<TemplateFile> TemplateFolder::Read(const std::string& name) const {
  TELESTRAIN_ASSIGN_OR_RETURN(TemplateFile file, ReadOwn(name));
  if (file.where.empty()) file = BuiltIn(name);
  if (file.where.empty())
    return BadInput(name + ": is not built in" +
                    (own_.empty() ? "" : " and does not exist in " + own_.string()));
  return file;
}

std::vector<std::string> TemplateFolder::Names(const std::string& folder) const {
  std::set<std::string> names;
  for (const BuiltInFile& file : BuiltInFiles())
    names.insert(NameIn(folder, std::string(file.name)));
  std::error_code code;
  if (!own_.empty())
    for (fs::directory_iterator at(own_ / folder, code), end; !code && at != end;
         at.increment(code))
      names.insert(NameIn("", at->path().filename().string()));
  names.erase("");
  return {names.begin(), names.end()};
}

Result<Json> ParseTemplate(const TemplateFile& file) {
  if (IsJsonDeeper(file.text))
    return BadInput(file.where + ": is nested deeper than " + std::to_string(kDeepestJson) +
                    " brackets");
  try {
    return Json::parse(file.text);
  } catch (const nlohmann::json::exception& e) {
    return BadInput(file.where + ": is not valid JSON: " + e.what());
  }
}

const Json& BuiltInSchema(const std::string& name) {
  static const std::map<std::string, Json> kSchemas = [] {
    std::map<std::string, Json> schemas;
    for (const BuiltInFile& file : BuiltInFiles())
      if (EndsWith(std::string(file.name), kSchemaSuffix))
        schemas[std::string(file.name)] = Json::parse(file.text);
    return schemas;
  }();
  const auto found = kSchemas.find(name);
  TELESTRAIN_CHECK(found != kSchemas.end(), "no such schema is built in: " + name);
  return found->second;
}

}  // namespace telestrain
