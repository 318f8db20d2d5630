// The manual pages say what the tables say, and roff shows it as it was written.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <set>

#include "app/pages/man_page.h"
#include "app/pages/option_facts.h"
#include "app/pages/roff.h"
#include "app/program.h"
#include "cli/program_run.h"
#include "unit/base/scratch_folder.h"
#include "viz/desk/desk_arguments.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> AllPages() {
  Program program;
  auto pages = ManPages(program.app(), {"2026-01-31", "0.1.0"});
  CLI::App view;
  DeskArguments arguments;
  arguments.AddTo(view);
  pages.merge(ManPages(view, {"2026-01-31", "0.1.0"}));
  return pages;
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string WithoutFonts(std::string text) {
  for (const char* font : {"\\fB", "\\fI", "\\fR"})
    for (std::size_t at; (at = text.find(font)) != std::string::npos;) text.erase(at, 3);
  return text;
}

// The tags of the section OPTIONS.
std::multiset<std::string> TagsOfOptions(const std::string& page) {
  std::multiset<std::string> tags;
  const auto lines = LinesOf(page);
  bool inside = false;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    if (lines[i].starts_with(".SH")) inside = lines[i] == ".SH OPTIONS";
    if (inside && lines[i] == ".TP") tags.insert(WithoutFonts(lines[i + 1]));
  }
  return tags;
}

void AddTags(const CLI::App& app, std::multiset<std::string>* tags) {
  for (const OptionFacts& option : OptionsOf(app)) tags->insert(RoffText(option.Shown()));
}

TEST(Manual, EveryVerbHasAPageAndNothingElseHas) {
  Program program;
  std::set<std::string> wanted = {"telestrain.1", "telestrain-view.1"}, found;
  for (const std::string& verb : program.Verbs()) wanted.insert("telestrain-" + verb + ".1");
  for (const auto& page : AllPages()) found.insert(page.first);
  EXPECT_EQ(found, wanted);
}

TEST(Manual, TheOptionsOfAPageAreThoseOfTheTable) {
  Program program;
  const auto pages = AllPages();
  for (const CLI::App* verb : program.app().get_subcommands({})) {
    std::multiset<std::string> wanted;
    AddTags(*verb, &wanted);
    for (const CLI::App* below : verb->get_subcommands({})) AddTags(*below, &wanted);
    EXPECT_EQ(TagsOfOptions(pages.at("telestrain-" + verb->get_name() + ".1")), wanted);
  }
  std::multiset<std::string> wanted;
  AddTags(program.app(), &wanted);
  EXPECT_EQ(TagsOfOptions(pages.at("telestrain.1")), wanted);
}

TEST(Manual, EveryPageHasItsSectionsInOrder) {
  const std::vector<std::string> order = {"NAME",    "SYNOPSIS",    "DESCRIPTION",
                                          "OPTIONS", "ENVIRONMENT", "EXIT STATUS",
                                          "FILES",   "EXAMPLES",    "SEE ALSO"};
  for (const auto& [name, page] : AllPages()) {
    std::size_t at = 0;
    for (const std::string& section : order) {
      if (section == "EXAMPLES" && name == "telestrain.1") continue;  // they stand with the verbs
      const std::size_t next = page.find(".SH " + section + "\n", at);
      EXPECT_NE(next, std::string::npos) << section << " of " << name;
      at = std::min(next, page.size());
    }
  }
}

TEST(Manual, EveryVariableThatTheSourceReadsIsExplained) {
  std::string manual;
  for (const auto& page : AllPages()) manual += page.second;
  int found = 0;
  for (const char* folder : {"/src", "/report", "/viz"})
    for (const auto& entry :
         fs::recursive_directory_iterator(std::string(TELESTRAIN_SOURCE_DIR) + folder)) {
      if (entry.path().extension() != ".cpp") continue;
      const std::string text = ReadAll(entry.path()), call = "getenv(\"";
      for (std::size_t at = 0; (at = text.find(call, at)) != std::string::npos; ++found) {
        at += call.size();
        const std::string name = text.substr(at, text.find('"', at) - at);
        EXPECT_NE(manual.find("\\fB" + name + "\\fR"), std::string::npos) << name;
      }
    }
  EXPECT_GE(found, 3);
}

TEST(Manual, TextShowsAsItWasWritten) {
  if (std::string(TELESTRAIN_GROFF).empty()) GTEST_SKIP() << "groff is not installed";
  const std::string text = ".so x 'y' \"z\" \\fB -a --b ^~` – µε";
  RoffPage page("x", "2026-01-31", "x");
  page.Section("NAME");
  page.Lines(text);
  const ScratchFolder folder("manual");
  std::ofstream(folder.path() / "text.1") << page.text();
  const ProgramRun run = RunProgram(
      {TELESTRAIN_GROFF, "-man", "-Tutf8", "-P-cbou", "-rLL=120n", "text.1"}, {folder.path(), {}});
  EXPECT_NE(run.out.find(text), std::string::npos) << run.out;
  EXPECT_EQ(run.err, "");
}

TEST(Manual, RoffHasNothingToComplainAbout) {
  const bool has_groff = *TELESTRAIN_GROFF != '\0', has_mandoc = *TELESTRAIN_MANDOC != '\0';
  if (!has_groff && !has_mandoc) GTEST_SKIP() << "neither groff nor mandoc is installed";
  const ScratchFolder folder("manual");
  for (const auto& [name, page] : AllPages()) {
    std::ofstream(folder.path() / name) << page;
    if (has_groff) {
      const ProgramRun run =
          RunProgram({TELESTRAIN_GROFF, "-man", "-Tutf8", "-ww", "-z", name}, {folder.path(), {}});
      EXPECT_EQ(run.out + run.err, "") << name;
    }
    if (has_mandoc) {
      const ProgramRun run =
          RunProgram({TELESTRAIN_MANDOC, "-Tlint", "-Wwarning", name}, {folder.path(), {}});
      EXPECT_EQ(run.out + run.err, "") << name;
    }
  }
}

// SOURCE_DATE_EPOCH and the clock have no part in them.
TEST(Manual, TheBuildWroteTheSamePages) {
  const fs::path folder = std::string(TELESTRAIN_BINARY_DIR) + "/pages/man1";
  if (!fs::exists(folder)) GTEST_SKIP() << "the target telestrain_manual is not built";
  for (const auto& [name, page] : AllPages()) {
    const std::string built = ReadAll(folder / name);
    EXPECT_EQ(built.substr(built.find(".SH")), page.substr(page.find(".SH"))) << name;
  }
}

}  // namespace
}  // namespace telestrain::testing_support
