#include <gtest/gtest.h>

#include <sstream>

#include "pdf_tools.h"
#include "report_reading.h"
#include "results_fixture.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

std::string RunOn(const char* tool, const std::string& before, const fs::path& pdf,
                  const std::string& after = "") {
  const ToolRun run =
      RunTool(std::string(tool) + " " + before + " '" + pdf.string() + "' " + after);
  EXPECT_TRUE(run.ok) << tool << ": " << run.output;
  return run.output;
}

std::vector<std::string> Pages(const fs::path& pdf) {
  std::istringstream text(RunOn(TELESTRAIN_TOOL_PDFTOTEXT, "-layout -enc UTF-8", pdf, "-"));
  std::vector<std::string> pages;
  for (std::string page; std::getline(text, page, '\f');)
    if (!WithoutSpace(page).empty()) pages.push_back(WithoutSpace(page));
  return pages;
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

// Every layout in every language, in the level of which free validators exist.
class ReportFormats : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = TestFolder(::testing::UnitTest::GetInstance()->current_test_info()->name());
    ResultsFixture fixture = PlausibleResults();
    WriteResults(fixture, folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path Pdf() const { return folder_ / "report.pdf"; }

  void ExpectWellFormed() const { RunOn(TELESTRAIN_TOOL_QPDF, "--check", Pdf()); }
  void ExpectFontsEmbedded() const;
  void ExpectPagesCounted(const ReportTemplate& layout) const;
  void ExpectBookmarks(const ReportTemplate& layout) const;
  void ExpectSameBytes(const ReportCase& report) const;

  fs::path folder_;
};

void ReportFormats::ExpectFontsEmbedded() const {
  std::istringstream lines(RunOn(TELESTRAIN_TOOL_PDFFONTS, "", Pdf()));
  std::string line;
  std::getline(lines, line);  // the heading
  std::getline(lines, line);
  int fonts = 0;
  for (; std::getline(lines, line); ++fonts)
    EXPECT_NE(line.find("yes yes yes"), std::string::npos) << line;  // embedded, subset, unicode
  EXPECT_GE(fonts, 2);
}

void ReportFormats::ExpectPagesCounted(const ReportTemplate& layout) const {
  const std::string pattern = layout.texts().Say("Page {{page}} of {{pages}}");
  const auto pages = Pages(Pdf());
  EXPECT_GE(pages.size(), 4u);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const std::string count = Replaced(Replaced(pattern, "{{page}}", std::to_string(i + 1)),
                                       "{{pages}}", std::to_string(pages.size()));
    EXPECT_NE(pages[i].find(WithoutSpace(count)), std::string::npos) << count;
  }
}

// One bookmark per heading of the first level that is drawn, with a page.
void ReportFormats::ExpectBookmarks(const ReportTemplate& layout) const {
  const Json outlines =
      Json::parse(RunOn(TELESTRAIN_TOOL_QPDF, "--json --json-key=outlines", Pdf()))["outlines"];
  const Json results = ReadResults(folder_);
  std::size_t headings = 0;
  for (const Json& block : layout.blocks())
    if (TextAt(block, "/type") == "heading" && IsWanted(results, block) &&
        NumberAt(block, "/level").value_or(1) == 1)
      ++headings;
  EXPECT_GE(headings, 4u);
  EXPECT_EQ(outlines.size(), headings);
  for (const Json& bookmark : outlines) {
    EXPECT_FALSE(TextAt(bookmark, "/title").empty());
    EXPECT_GE(NumberAt(bookmark, "/destpageposfrom1").value_or(0), 1) << bookmark.dump();
  }
}

void ReportFormats::ExpectSameBytes(const ReportCase& report) const {
  const std::string first = FileBytes(Pdf()), certificate = FileBytes(folder_ / "dcc.xml");
  MakeReport(folder_, report, ArchiveLevel::k1b);
  EXPECT_TRUE(FileBytes(Pdf()) == first);
  EXPECT_TRUE(FileBytes(folder_ / "dcc.xml") == certificate);
}

TEST_F(ReportFormats, AreSoundInEveryLayoutAndLanguage) {
  NEEDS_TOOL(TELESTRAIN_TOOL_QPDF, "qpdf");
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFFONTS, "pdffonts");
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const auto cases = AllReportCases();
  EXPECT_EQ(cases.size(), 4u * 3u);
  for (const ReportCase& report : cases) {
    SCOPED_TRACE(NameOf(report));
    MakeReport(folder_, report, ArchiveLevel::k1b);
    const ReportTemplate layout = TemplateOf(report);
    ExpectWellFormed();
    ExpectFontsEmbedded();
    ExpectPagesCounted(layout);
    ExpectBookmarks(layout);
    ExpectSameBytes(report);
  }
}

}  // namespace
}  // namespace telestrain
