#include "docs/document.h"

#include <gtest/gtest.h>

#include <fstream>

#include "unit/base/scratch_folder.h"

namespace telestrain {
namespace {

using namespace testing_support;

Document Read(const std::string& text) {
  const ScratchFolder folder("telestrain_document_");
  std::ofstream(folder.path() / "page.md") << text;
  return ReadDocument(folder.path() / "page.md");
}

TEST(Document, FindsCommandsAndTheirOutput) {
  const Document page = Read(
      "# A page\n\n    telestrain run a --out b   # exit code 3\n\n    telestrain run: "
      "refused\n\ntext\n\n"
      "```\ntelestrain simulate \\\n  --out c\n```\n\n```toml\nkey = 1\n```\n");
  ASSERT_EQ(page.commands.size(), 2U);
  EXPECT_EQ(page.commands[0].command, "telestrain run a --out b");
  EXPECT_EQ(page.commands[0].exit_code, 3);
  ASSERT_EQ(page.commands[0].output.size(), 1U);
  EXPECT_EQ(page.commands[1].command, "telestrain simulate  --out c");
  EXPECT_EQ(page.anchors, std::vector<std::string>{"a-page"});
}

TEST(Document, TellsHiddenFromUntestedCommands) {
  const Document page = Read(
      "<!-- run:\ncp a b\n-->\n\n<!-- not run: needs a bare machine -->\n\n    bash bootstrap "
      "demo\n"
      "\n    telestrain-view results\n");
  ASSERT_EQ(page.commands.size(), 1U);
  EXPECT_EQ(page.commands[0].command, "cp a b");
  EXPECT_FALSE(page.commands[0].shown);
  ASSERT_EQ(page.untested.size(), 1U);
  EXPECT_EQ(page.untested[0].reason, "needs a bare machine");
  EXPECT_EQ(page.untested[0].commands.size(), 2U);
}

TEST(Document, FindsTablesWithTheSourceOfTheirFiguresAndLinks) {
  const Document page = Read(
      "<!-- figures: tests/robustness/documents -->\n\n| a | b |\n|---|---|\n| [x](y.md) | 1.5 |\n"
      "\n| c |\n|---|\n");
  ASSERT_EQ(page.tables.size(), 2U);
  EXPECT_EQ(page.tables[0].source, "tests/robustness/documents");
  EXPECT_EQ(page.tables[1].source, "");
  ASSERT_EQ(page.links.size(), 1U);
  EXPECT_EQ(page.links[0].target, "y.md");
}

TEST(DescribesOutput, TakesDotsForAnythingAndNothingElse) {
  EXPECT_TRUE(DescribesOutput({"a … c", "…", "end"}, "a b c\n\nx\ny\nend\n"));
  EXPECT_TRUE(DescribesOutput({"…/report.pdf"}, "/some/place/report.pdf\n"));
  EXPECT_FALSE(DescribesOutput({"a 1.25"}, "a 1.26\n"));
  EXPECT_FALSE(DescribesOutput({"a"}, "a\nb\n"));
  EXPECT_FALSE(DescribesOutput({"a", "b"}, "a\n"));
  EXPECT_FALSE(DescribesOutput({"a …"}, "b a 1\n"));
}

}  // namespace
}  // namespace telestrain
