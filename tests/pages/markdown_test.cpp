// The pages of the verbs in src/app/pages tell the options that the program has.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "app/pages/options_markdown.h"
#include "app/program.h"
#include "cli/program_run.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

fs::path PageOf(const std::string& verb) {
  return std::string(TELESTRAIN_SOURCE_DIR) + "/src/app/pages/" + verb + ".md";
}

TEST(Markdown, ARowStandsForEveryOption) {
  Program program;
  const std::string text = OptionsMarkdown(*program.app().get_subcommand("calibrate"));
  EXPECT_NE(text.find("\n| `--outliers median\\|mrcal\\|weigh` | `median` |"), std::string::npos);
  EXPECT_NE(text.find("\n| `SESSION` | required |"), std::string::npos);
  EXPECT_TRUE(text.ends_with(" |\n"));
}

TEST(Markdown, OptionsReplaceWhatStandsBetweenTheMarks) {
  Program program;
  const CLI::App& verb = *program.app().get_subcommand("detect");
  const std::string begin = std::string("a\n") + kOptionsBegin + "\n",
                    end = std::string(kOptionsEnd) + "\nb\n";
  EXPECT_EQ(WithOptions(begin + "old\n" + end, verb), begin + OptionsMarkdown(verb) + end);
  EXPECT_EQ(WithOptions("a\nb\n", verb), "");
}

TEST(Markdown, ThePagesOfTheVerbsAreUpToDate) {
  Program program;
  if (!fs::exists(PageOf("run"))) GTEST_SKIP() << "there are no pages yet";
  for (const CLI::App* verb : program.app().get_subcommands({})) {
    const std::string page = ReadAll(PageOf(verb->get_name()));
    EXPECT_EQ(WithOptions(page, *verb), page)
        << "run build/release/telestrain_pages --markdown src/app/pages";
  }
}

}  // namespace
}  // namespace telestrain::testing_support
