// The rules of CONTRIBUTING.md applied to the whole repository.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "style/include_rules.h"
#include "style/size_rules.h"
#include "style/text_rules.h"

namespace telestrain::style {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = TELESTRAIN_SOURCE_DIR;

bool IsText(const fs::path& path) {
  constexpr std::array kExtensions = {".h",  ".cpp", ".cmake", ".in",
                                      ".md", ".txt", ".json",  ".toml"};
  constexpr std::array kNames = {"bootstrap", "run", "LICENSE"};
  const std::string name = path.filename().string();
  return std::find(kExtensions.begin(), kExtensions.end(), path.extension().string()) !=
             kExtensions.end() ||
         std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

std::string ReadAll(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Every file below the root but those of git and of builds; the walk enters no build folder.
std::vector<fs::path> AllFiles() {
  std::vector<fs::path> files;
  for (auto entry = fs::recursive_directory_iterator(kRoot); entry != fs::end(entry); ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry.depth() == 0 && (name == ".git" || name == "build"))
      entry.disable_recursion_pending();
    else if (entry->is_regular_file())
      files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

const std::vector<SourceFile>& TextFiles() {
  static const std::vector<SourceFile> files = [] {
    std::vector<SourceFile> texts;
    for (const fs::path& path : AllFiles())
      if (IsText(path) && path != kRoot / ".git")
        texts.push_back({fs::relative(path, kRoot).generic_string(), ReadAll(path)});
    return texts;
  }();
  return files;
}

void ExpectNone(const Findings& findings) {
  for (const std::string& finding : findings) ADD_FAILURE() << finding;
}

template <typename Rule>
void ExpectHolds(Rule rule) {
  for (const SourceFile& file : TextFiles()) ExpectNone(rule(file));
}

TEST(Style, TheWalkSeesTheRepository) {
  const auto& files = TextFiles();
  const auto has = [&](std::string_view path) {
    return std::any_of(files.begin(), files.end(),
                       [&](const SourceFile& f) { return f.path == path; });
  };
  EXPECT_TRUE(has("CMakeLists.txt"));
  EXPECT_TRUE(has("bootstrap"));
  EXPECT_TRUE(has(".ci/run"));
  EXPECT_TRUE(has("src/base/files.h"));
  EXPECT_TRUE(has("tests/style/style_test.cpp"));
}

TEST(Style, IncludesPointDownwards) { ExpectHolds(CheckIncludeDirection); }
TEST(Style, HeavyHeadersStayInFewSources) { ExpectHolds(CheckHeavyHeaders); }
TEST(Style, FilesAreShort) { ExpectHolds(CheckFileSize); }
TEST(Style, FunctionsAreShortAndFlat) { ExpectHolds(CheckFunctions); }
TEST(Style, NoTabsOrTrailingBlanks) { ExpectHolds(CheckBlanks); }
TEST(Style, NoNotesOfUnfinishedWork) { ExpectHolds(CheckBannedWords); }
TEST(Style, NoMachinePaths) { ExpectHolds(CheckMachinePaths); }
TEST(Style, HeadersExplainThemselves) { ExpectHolds(CheckHeaderComment); }
TEST(Style, EverySourceIsListed) { ExpectNone(CheckListedInCMake(TextFiles())); }

TEST(Style, FileNamesSayWhatIsInside) {
  for (const fs::path& path : AllFiles())
    ExpectNone(CheckFileName(fs::relative(path, kRoot).generic_string()));
}

TEST(Style, TopLevelIsClosed) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kRoot)) names.push_back(entry.path().filename());
  std::erase(names, "build");
  ExpectNone(CheckTopLevel(names));
}

TEST(Style, DataIsSmall) {
  std::vector<FileSize> sizes;
  for (const fs::path& path : AllFiles()) {
    const std::string relative = fs::relative(path, kRoot).generic_string();
    if (relative.starts_with("data/")) sizes.push_back({relative, fs::file_size(path)});
  }
  ExpectNone(CheckDataSize(sizes));
}

// Places above the wanted size are exceptions. Their number may only go down: lower it with them.
TEST(Style, FewPlacesAreAboveTheWantedSize) {
  constexpr std::size_t kAllowed = 12;
  Findings all;
  for (const SourceFile& file : TextFiles())
    for (const std::string& warning : SizeWarnings(file)) all.push_back(warning);
  EXPECT_LE(all.size(), kAllowed);
  for (const std::string& warning : all) std::cout << "long: " << warning << '\n';
}

}  // namespace
}  // namespace telestrain::style
