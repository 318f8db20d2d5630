#include "style/text_rules.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace telestrain::style {
namespace {

constexpr std::uintmax_t kMaxDataBytes = 20'000'000;
constexpr std::uintmax_t kMaxDataFileBytes = 5'000'000;

constexpr std::array<std::string_view, 13> kTopLevel = {
    "CMakeLists.txt",  "src",       "viz",
    "report",          "tests",     "data",
    "templates",       "README.md", "CHANGELOG.md",
    "CONTRIBUTING.md", "LICENSE",   "CMakePresets.json",
    "bootstrap"};

// Written in halves so that this file keeps its own rules.
const std::array<std::string, 3> kBannedWords = {
    std::string("TO") + "DO", std::string("FIX") + "ME", std::string("XX") + "X"};
const std::array<std::string, 5> kMachineRoots = {
    std::string("/ho") + "me/", std::string("/ro") + "ot/", std::string("/tm") + "p/",
    std::string("/wo") + "rk/", std::string("/Us") + "ers/"};
constexpr std::array<std::string_view, 5> kBannedNameParts = {"utils", "helpers", "manager", "misc",
                                                              "common"};

bool IsWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

bool HasWholeWord(std::string_view line, std::string_view word) {
  for (std::size_t at = line.find(word); at != std::string_view::npos;
       at = line.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !IsWordCharacter(line[at - 1]);
    if (begins && (end == line.size() || !IsWordCharacter(line[end]))) return true;
  }
  return false;
}

// True when `root` stands at the start of a path: build/work/ and ${x}/tmp/ are relative.
bool HasAbsolutePath(std::string_view line, std::string_view root) {
  for (std::size_t at = line.find(root); at != std::string_view::npos;
       at = line.find(root, at + 1)) {
    const char before = at == 0 ? ' ' : line[at - 1];
    if (!IsWordCharacter(before) &&
        std::string_view("./}>)-*~").find(before) == std::string_view::npos)
      return true;
  }
  return false;
}

// True when `text` names `path` as a whole word of a CMake list.
bool Lists(std::string_view text, std::string_view path) {
  for (std::size_t at = text.find(path); at != std::string_view::npos;
       at = text.find(path, at + 1)) {
    const std::size_t end = at + path.size();
    const bool begins =
        at == 0 || std::string_view(" \n(\"").find(text[at - 1]) != std::string_view::npos;
    const bool ends =
        end == text.size() || std::string_view(" \n)\"").find(text[end]) != std::string_view::npos;
    if (begins && ends) return true;
  }
  return false;
}

const SourceFile* Find(const std::vector<SourceFile>& files, const std::string& path) {
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const SourceFile& f) { return f.path == path; });
  return found == files.end() ? nullptr : &*found;
}

bool MustBeListed(const SourceFile& file) {
  return file.path.ends_with("_test.cpp") || (IsCpp(file.path) && !ModuleOf(file.path).empty());
}

bool IsListed(const std::vector<SourceFile>& files, const std::string& path) {
  for (std::string folder = FolderOf(path); !folder.empty(); folder = FolderOf(folder)) {
    const SourceFile* list = Find(files, folder + "/CMakeLists.txt");
    if (list != nullptr) return Lists(list->text, path.substr(folder.size() + 1));
  }
  return false;
}

}  // namespace

Findings CheckBlanks(const SourceFile& file) {
  Findings findings;
  const auto lines = Lines(file.text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].find('\t') != std::string::npos) findings.push_back(Finding(file, i + 1, "tab"));
    if (lines[i].find('\r') != std::string::npos)
      findings.push_back(Finding(file, i + 1, "carriage return"));
    if (lines[i].ends_with(' ')) findings.push_back(Finding(file, i + 1, "trailing blank"));
  }
  if (!file.text.empty() && (!file.text.ends_with('\n') || file.text.ends_with("\n\n")))
    findings.push_back(Finding(file, lines.size(), "must end with one line end"));
  return findings;
}

Findings CheckBannedWords(const SourceFile& file) {
  Findings findings;
  const auto lines = Lines(file.text);
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const std::string& word : kBannedWords)
      if (HasWholeWord(lines[i], word)) findings.push_back(Finding(file, i + 1, "says " + word));
  return findings;
}

Findings CheckMachinePaths(const SourceFile& file) {
  Findings findings;
  const auto lines = Lines(file.text);
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const std::string& root : kMachineRoots)
      if (HasAbsolutePath(lines[i], root))
        findings.push_back(Finding(file, i + 1, "absolute path below " + root));
  return findings;
}

Findings CheckHeaderComment(const SourceFile& file) {
  if (!IsHeader(file.path)) return {};
  Findings findings;
  const auto lines = Lines(file.text);
  const auto explains = [](const std::string& line) {
    const std::size_t first = line.find_first_not_of(' ');
    return first != std::string::npos && line.compare(first, 3, "// ") == 0;
  };
  if (std::find(lines.begin(), lines.end(), "#pragma once") == lines.end())
    findings.push_back(Finding(file, 1, "lacks #pragma once"));
  if (std::none_of(lines.begin(), lines.end(), explains))
    findings.push_back(Finding(file, 1, "a header without a comment"));
  return findings;
}

Findings CheckFileName(std::string_view path) {
  const std::string name = NameOf(path);
  for (const std::string_view part : kBannedNameParts)
    if (name.find(part) != std::string::npos)
      return {std::string(path) + ": the name says \"" + std::string(part) + "\""};
  return {};
}

Findings CheckListedInCMake(const std::vector<SourceFile>& files) {
  Findings findings;
  for (const SourceFile& file : files)
    if (MustBeListed(file) && !IsListed(files, file.path))
      findings.push_back(file.path + ": no CMakeLists.txt names it");
  return findings;
}

Findings CheckTopLevel(const std::vector<std::string>& names) {
  Findings findings;
  for (const std::string& name : names)
    if (!name.starts_with('.') &&
        std::find(kTopLevel.begin(), kTopLevel.end(), name) == kTopLevel.end())
      findings.push_back(name + ": does not belong at the top level");
  return findings;
}

Findings CheckDataSize(const std::vector<FileSize>& files) {
  Findings findings;
  std::uintmax_t total = 0;
  for (const FileSize& file : files) {
    total += file.bytes;
    if (file.bytes >= kMaxDataFileBytes)
      findings.push_back(file.path + ": " + std::to_string(file.bytes) +
                         " bytes, 5 MB are too many");
  }
  if (total >= kMaxDataBytes)
    findings.push_back("data: " + std::to_string(total) + " bytes, 20 MB are too many");
  return findings;
}

}  // namespace telestrain::style
