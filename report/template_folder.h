#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "report/json_lookup.h"

namespace telestrain {

// A file of a template folder: where errors say it lies, and its text.
struct TemplateFile {
  std::string where;
  std::string text;
};

// The templates that a report is made of: the files of the user's own folder, and for those it
// lacks the built-in ones.
class TemplateFolder {
 public:
  // `own` empty: built-in ones only. Fails (kBadInput) when it is no folder.
  static Result<TemplateFolder> Open(const std::filesystem::path& own);

  // The user's file `name` ("sections/ruler.json"), else the built-in one. Fails (kBadInput) when
  // there is neither, or when the user's cannot be read.
  Result<TemplateFile> Read(const std::string& name) const;
  // The same for each place apart; no file is an empty `where`.
  Result<TemplateFile> ReadOwn(const std::string& name) const;
  static TemplateFile BuiltIn(const std::string& name);

  // The names without .json of the files directly in `folder` ("", "texts", "sections"),
  // sorted; built-in ones and the user's.
  std::vector<std::string> Names(const std::string& folder) const;
  const std::filesystem::path& own() const { return own_; }

 private:
  std::filesystem::path own_;
};

// The JSON in it. Fails (kBadInput) with its place and where the syntax is wrong, or with the JSON
// pointer of a key that an object holds twice.
Result<Json> ParseTemplate(const TemplateFile& file);

// A schema of templates/ by its file name; it is built in and right.
const Json& BuiltInSchema(const std::string& name);

}  // namespace telestrain
