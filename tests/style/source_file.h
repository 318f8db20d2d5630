#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace telestrain::style {

// One text file of the repository: `path` is relative to its root, with '/' between folders.
struct SourceFile {
  std::string path;
  std::string text;
};

// What a rule says about one place, "path:line: what is wrong". No findings means that it holds.
using Findings = std::vector<std::string>;

// The lines of `text` without their line ends.
std::vector<std::string> Lines(std::string_view text);

// `text` with comments and the insides of string and character literals replaced by blanks, and
// preprocessor lines as well. Line ends stay, so that line numbers and columns remain right.
std::string CodeOnly(std::string_view text);

std::string FolderOf(std::string_view path);
std::string NameOf(std::string_view path);
bool IsHeader(std::string_view path);
bool IsCpp(std::string_view path);

// "base" for src/base/…, "viz" for viz/…, "report" for report/…; empty for what is no module.
std::string ModuleOf(std::string_view path);

// "path:line: message".
std::string Finding(const SourceFile& file, std::size_t line, const std::string& message);

}  // namespace telestrain::style
