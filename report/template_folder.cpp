#include "report/template_folder.h"

#include <map>
#include <set>

#include "base/check.h"
#include "base/files.h"
#include "base/json_file.h"
#include "report/built_in_files.h"
#include "report/json_schema.h"

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

// Finds the first key that an object holds twice: a parser keeps the last one silently.
class RepeatedKey {
 public:
  void Read(Json::parse_event_t event, const Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::key) {
      const std::string key = parsed.get<std::string>();
      open_.back().step = key;
      if (!open_.back().keys.insert(key).second && pointer_.empty()) pointer_ = Here();
      return;
    }
    if (event == Event::object_end || event == Event::array_end) open_.pop_back();
    if (event == Event::object_start || event == Event::array_start)
      open_.push_back({event == Event::array_start, 0, "0", {}});
    else if (!open_.empty() && open_.back().is_list)
      open_.back().step = std::to_string(++open_.back().index);
  }
  const std::string& pointer() const { return pointer_; }  // empty: there is none

 private:
  struct Level {
    bool is_list = false;
    std::size_t index = 0;
    std::string step;
    std::set<std::string> keys;
  };
  std::string Here() const {
    std::string pointer;
    for (const Level& level : open_) pointer += "/" + PointerStep(level.step);
    return pointer;
  }

  std::vector<Level> open_;
  std::string pointer_;
};

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
  TELESTRAIN_ASSIGN_OR_RETURN(std::string text, ReadFile(own_ / name, kMostTextBytes));
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
  if (const auto text = CheckJsonText(file.text); !text)
    return BadInput(file.where + ": " + text.error().message + "; mend the file");
  try {
    RepeatedKey repeated;
    Json json = Json::parse(file.text, [&](int, Json::parse_event_t event, const Json& parsed) {
      repeated.Read(event, parsed);
      return true;
    });
    if (!repeated.pointer().empty())
      return BadInput(file.where + ": " + repeated.pointer() +
                      ": the key stands there twice; remove one of them");
    return json;
  } catch (const nlohmann::json::exception& e) {
    return BadInput(file.where + ": is not valid JSON: " + JsonProblem(e));
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
