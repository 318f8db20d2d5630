#include "report/acceptance_report.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "base/json_file.h"
#include "pdf_tools.h"
#include "report/json_lookup.h"
#include "results_fixture.h"

namespace telestrain {
namespace {

ReportOptions OptionsOf(const std::filesystem::path& templates) {
  ReportOptions options;
  options.templates = templates;
  return options;
}

class AcceptanceReport : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = TestFolder(::testing::UnitTest::GetInstance()->current_test_info()->name());
    fixture_ = PlausibleResults();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void Make() {
    WriteResults(fixture_, folder_);
    const auto verdict = MakeResults(folder_);
    ASSERT_TRUE(verdict) << verdict.error().message;
    const Status written = WriteReport(folder_);
    ASSERT_TRUE(written) << written.error().message;
  }
  std::string Pdf() const { return (folder_ / "report.pdf").string(); }
  std::string TextOfPdf() const {
    return RunTool(std::string(TELESTRAIN_TOOL_PDFTOTEXT) + " -layout -enc UTF-8 '" + Pdf() + "' -")
        .output;
  }
  void ExpectFailure(const Status& status, ErrorKind kind, const std::string& wanted) {
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().kind, kind);
    EXPECT_NE(status.error().message.find(wanted), std::string::npos) << status.error().message;
    EXPECT_FALSE(std::filesystem::exists(Pdf()));
  }

  std::filesystem::path folder_;
  ResultsFixture fixture_;
};

TEST_F(AcceptanceReport, IsAWellFormedPdf) {
  Make();
  EXPECT_LT(std::filesystem::file_size(Pdf()), 8u << 20);
  NEEDS_TOOL(TELESTRAIN_TOOL_QPDF, "qpdf");
  const ToolRun check = RunTool(std::string(TELESTRAIN_TOOL_QPDF) + " --check '" + Pdf() + "'");
  EXPECT_TRUE(check.ok) << check.output;
}

TEST_F(AcceptanceReport, EmbedsEveryFont) {
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFFONTS, "pdffonts");
  std::istringstream lines(
      RunTool(std::string(TELESTRAIN_TOOL_PDFFONTS) + " '" + Pdf() + "'").output);
  std::string line;
  int fonts = 0;
  for (int i = 0; std::getline(lines, line); ++i) {
    if (i < 2) continue;                                             // the heading
    EXPECT_NE(line.find("yes yes yes"), std::string::npos) << line;  // embedded, subset, unicode
    ++fonts;
  }
  EXPECT_GE(fonts, 4);
}

TEST_F(AcceptanceReport, PrintsEveryNumberOfTheResults) {
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const std::string text = WithoutSpace(TextOfPdf());
  auto results = ReadJson(folder_ / "results.json", "telestrain.results/1", "test");
  ASSERT_TRUE(results);
  const auto expect = [&](const Json& entry, const char* key) {
    if (!entry.is_object() || !entry.contains(key) || !entry[key].is_string()) return;
    if (entry.contains("pattern")) {  // a sentence, which may be broken over lines
      std::istringstream words(entry[key].get<std::string>());
      for (std::string word; words >> word;)
        EXPECT_NE(text.find(word), std::string::npos) << word << " of " << entry.dump();
      return;
    }
    EXPECT_NE(text.find(WithoutSpace(entry[key].get<std::string>())), std::string::npos)
        << entry.dump();
  };
  for (const Json& quantity : ListAt(*results, "/quantities"))
    for (const char* key : {"printed", "printed_uncertainty", "printed_limit"})
      expect(quantity, key);
  for (const Json& table : ListAt(*results, "/tables"))
    for (const Json& row : ListAt(table, "/rows"))
      for (const Json& cell : row) expect(cell, "printed");
  for (const Json& file : ListAt(*results, "/inputs/files"))
    EXPECT_NE(text.find(TextAt(file, "/sha256")), std::string::npos) << TextAt(file, "/path");
}

TEST_F(AcceptanceReport, EveryPageHasNumberRevisionAndPageCount) {
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  std::istringstream pages(TextOfPdf());
  std::string page;
  std::vector<std::string> texts;
  while (std::getline(pages, page, '\f'))
    if (!WithoutSpace(page).empty()) texts.push_back(page);
  ASSERT_GT(texts.size(), 5u);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_NE(texts[i].find("AR-2026-0042"), std::string::npos);
    EXPECT_NE(texts[i].find("Revision 1"), std::string::npos);
    const std::string number =
        "Page " + std::to_string(i + 1) + " of " + std::to_string(texts.size());
    EXPECT_NE(texts[i].find(number), std::string::npos) << number;
  }
  EXPECT_NE(texts.back().find("End of the report"), std::string::npos);
  EXPECT_NE(texts.front().find("PASS"), std::string::npos);
}

TEST_F(AcceptanceReport, PrintsPicturesAt300Dpi) {
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFIMAGES, "pdfimages");
  std::istringstream lines(
      RunTool(std::string(TELESTRAIN_TOOL_PDFIMAGES) + " -list '" + Pdf() + "'").output);
  std::string line;
  int pictures = 0;
  for (int i = 0; std::getline(lines, line); ++i) {
    if (i < 2) continue;
    std::istringstream words(line);
    std::vector<std::string> cells{std::istream_iterator<std::string>(words), {}};
    ASSERT_GT(cells.size(), 13u) << line;
    EXPECT_NEAR(std::stod(cells[12]), 300, 1) << line;
    EXPECT_NEAR(std::stod(cells[13]), 300, 1) << line;
    ++pictures;
  }
  EXPECT_EQ(pictures, 3);
}

TEST_F(AcceptanceReport, TheSameResultsGiveTheSameBytes) {
  Make();
  const std::string first = FileBytes(Pdf());
  Make();
  EXPECT_EQ(FileBytes(Pdf()), first);
}

TEST_F(AcceptanceReport, TakesItsDateFromTheResultsNeverFromTheClock) {
  Make();
  EXPECT_NE(FileBytes(Pdf()).find("D:20260131000000Z"), std::string::npos);
  fixture_.inputs["document"].erase("date");
  ::setenv("SOURCE_DATE_EPOCH", "1767225600", 1);
  Make();
  EXPECT_NE(FileBytes(Pdf()).find("D:20260101000000Z"), std::string::npos);
  ::unsetenv("SOURCE_DATE_EPOCH");
  Make();
  EXPECT_EQ(FileBytes(Pdf()).find("CreationDate"), std::string::npos);
}

TEST_F(AcceptanceReport, ShowsGreekAndChineseAndNamesWhatNoFontHas) {
  fixture_.inputs["document"]["customer"] = "Ωμέγα 测量实验室 Łódź 😀";
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const std::string text = TextOfPdf();
  EXPECT_NE(text.find("Ωμέγα"), std::string::npos);
  EXPECT_NE(text.find("Łódź"), std::string::npos);
  EXPECT_NE(text.find("[U+1F600]"), std::string::npos);
  EXPECT_NE(text.find("µε"), std::string::npos);
  const bool has_chinese = std::filesystem::exists("/usr/share/fonts/truetype/wqy/wqy-zenhei.ttc");
  EXPECT_NE(text.find(has_chinese ? "测量实验室" : "[U+6D4B]"), std::string::npos);
}

TEST_F(AcceptanceReport, LongTextsWrapAndNothingIsLost) {
  std::string story;
  for (int i = 0; i < 900; ++i) story += "word" + std::to_string(i) + " ";  // more than a page
  fixture_.inputs["document"]["remarks"] = story;
  fixture_.inputs["title"] = story.substr(0, 600);
  fixture_.inputs["document"]["number"] = "AR-" + std::string(150, '7');
  fixture_.detection["boards"][3]["found"] = false;
  fixture_.detection["boards"][3]["rejected_because"] = story;
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const std::string text = TextOfPdf();
  for (int i = 0; i < 900; ++i) {
    const std::string word = "word" + std::to_string(i);
    const std::size_t first = text.find(word);
    ASSERT_NE(first, std::string::npos) << word;
    EXPECT_NE(text.find(word, first + 1), std::string::npos) << word;  // remarks and reason
  }
}

TEST_F(AcceptanceReport, WorksWithEveryPartMissing) {
  fixture_.ruler = fixture_.strain = fixture_.calibration = fixture_.detection = nullptr;
  fixture_.pictures = false;
  fixture_.inputs.erase("document");
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const std::string text = TextOfPdf();
  EXPECT_NE(text.find("Ruler: not measured"), std::string::npos);
  EXPECT_NE(text.find("Strain: not measured"), std::string::npos);
  EXPECT_NE(text.find("Calibration: not measured"), std::string::npos);
  EXPECT_NE(text.find("NOT DECIDED"), std::string::npos);
}

TEST_F(AcceptanceReport, ShowsTheOtherVerdicts) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  fixture_.pictures = false;
  fixture_.ruler["images"][3]["error_um"] = 9.5;
  Make();
  EXPECT_NE(TextOfPdf().find("IN DOUBT"), std::string::npos);
  fixture_.ruler["images"][3]["error_um"] = -19.5;
  Make();
  EXPECT_NE(TextOfPdf().find("FAIL"), std::string::npos);
}

// A state has no half: with few of them the ticks stay at 0, 1, 2.
TEST_F(AcceptanceReport, TicksStandAtWholeStatesAndImages) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  for (const std::size_t states : {6, 3, 2}) {
    auto& list = fixture_.strain["states"];
    while (list.size() > states) list.erase(list.size() - 1);
    while (fixture_.ruler["images"].size() > states) fixture_.ruler["images"].erase(0);
    fixture_.pictures = false;
    Make();
    std::istringstream lines(TextOfPdf());
    std::string line, ticks;
    int axes = 0;
    while (std::getline(lines, line)) {
      if (line.find("State, 0 is the reference") != std::string::npos ||
          line.find("Ruler image, row of the table") != std::string::npos) {
        EXPECT_EQ(ticks.find('.'), std::string::npos) << states << " states: " << ticks;
        ++axes;
      }
      if (!WithoutSpace(line).empty()) ticks = line;
    }
    EXPECT_GE(axes, 2) << states;
  }
}

TEST_F(AcceptanceReport, SaysWhatTheUncertaintiesHoldAndWhatWasLost) {
  fixture_.pictures = false;
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const std::string text = WithoutSpace(TextOfPdf());
  for (const char* wanted :
       {"the gauges' own uncertainty is not included", "Gauges, change", "Corners not used",
        "no partner in the second view", "reference image", "pitch", "(U of the fit)"})
    EXPECT_NE(text.find(WithoutSpace(wanted)), std::string::npos) << wanted;
}

TEST_F(AcceptanceReport, HasBookmarks) {
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_QPDF, "qpdf");
  const std::string objects =
      RunTool(std::string(TELESTRAIN_TOOL_QPDF) + " --json --json-key=outlines '" + Pdf() + "'")
          .output;
  for (const char* title : {"Summary of results", "Calibration", "Length acceptance", "Scene"})
    EXPECT_NE(objects.find(title), std::string::npos) << title;
}

TEST_F(AcceptanceReport, AnotherTemplateChangesTheReport) {
  Make();
  const auto templates = folder_ / "templates";
  std::filesystem::create_directories(templates);
  std::ofstream(templates / "acceptance.json")
      << R"({"schema": "telestrain.template/1", "title": "Abnahme",
             "labels": {"Limit": "Grenzwert"}, "blocks": [
             {"type": "heading", "text": "Abnahme {{document.number}}"},
             {"type": "table", "table": "summary"}]})";
  ASSERT_TRUE(WriteReport(folder_, OptionsOf(templates)));
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  EXPECT_NE(TextOfPdf().find("Abnahme AR-2026-0042"), std::string::npos);
  EXPECT_NE(TextOfPdf().find("Grenzwert"), std::string::npos);
}

TEST_F(AcceptanceReport, ErrorsLeaveNoFile) {
  Make();
  const auto templates = folder_ / "templates";
  ExpectFailure(WriteReport(folder_, OptionsOf(templates)), ErrorKind::kBadInput, "is no folder");
  std::filesystem::create_directories(templates);
  std::ofstream(templates / "acceptance.json")
      << R"({"schema": "telestrain.template/1", "title": "t", "blocks": [{"type": "picture"}]})";
  ExpectFailure(WriteReport(folder_, OptionsOf(templates)), ErrorKind::kBadInput, "/blocks/0");

  std::ofstream(folder_ / "pictures" / "array.png", std::ios::trunc) << "no picture";
  ExpectFailure(WriteReport(folder_), ErrorKind::kBadInput, "array.png");
  std::filesystem::remove(folder_ / "pictures" / "array.png");

  std::ofstream(folder_ / "residuals.csv", std::ios::trunc)
      << "image,view,column,row,u_px,v_px,du_px,dv_px\na,A1,0,0,1,2,x,4\n";
  ExpectFailure(WriteReport(folder_), ErrorKind::kBadInput, "residuals.csv:2");

  std::filesystem::remove(folder_ / "results.json");
  ExpectFailure(WriteReport(folder_), ErrorKind::kBadInput, "results.json");
}

TEST_F(AcceptanceReport, AFolderThatCannotBeWrittenIsAnOutputError) {
  Make();
  std::filesystem::remove(Pdf());
  std::filesystem::create_directories(folder_ / "report.pdf" / "occupied");
  const Status status = WriteReport(folder_);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::kOutputFailed);
}

}  // namespace
}  // namespace telestrain
