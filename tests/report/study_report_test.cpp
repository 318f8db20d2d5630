#include "report/study_report.h"

#include <gtest/gtest.h>

#include <sstream>
#include <tuple>

#include "base/json_file.h"
#include "pdf_tools.h"
#include "report/json_lookup.h"
#include "results_fixture.h"
#include "study_fixture.h"

namespace telestrain {
namespace {

class StudyReport : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = TestFolder(::testing::UnitTest::GetInstance()->current_test_info()->name());
    WritePicture(folder_ / "board.png", 640, 480);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Status Write() {
    EXPECT_TRUE(WriteJson(folder_ / "study.json", study_));
    return WriteStudyReport(folder_ / "study.json", folder_ / "study.pdf");
  }
  void Make() {
    const Status written = Write();
    ASSERT_TRUE(written) << written.error().message;
  }
  std::string Pdf() const { return (folder_ / "study.pdf").string(); }
  std::string TextOfPdf() const {
    return RunTool(std::string(TELESTRAIN_TOOL_PDFTOTEXT) + " -layout -enc UTF-8 '" + Pdf() + "' -")
        .output;
  }

  std::filesystem::path folder_;
  Json study_ = SampleStudy();
};

TEST_F(StudyReport, IsAWellFormedPdf) {
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_QPDF, "qpdf");
  const ToolRun check = RunTool(std::string(TELESTRAIN_TOOL_QPDF) + " --check '" + Pdf() + "'");
  EXPECT_TRUE(check.ok) << check.output;
}

TEST_F(StudyReport, PrintsEveryTextOfTheComparisonAndTheTables) {
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const std::string text = WithoutSpace(TextOfPdf());
  const auto expect = [&](const std::string& wanted) {
    EXPECT_NE(text.find(WithoutSpace(wanted)), std::string::npos) << wanted;
  };
  for (const Json& row : study_["comparison"])
    for (const char* key : {"paper", "limit"}) expect(row[key].get<std::string>());
  for (const char* wanted : {"0.0379", "0.2484", "2.113", "✓ yes", "✗ no", "0.09980", "0.1057",
                             "0.350", "Page 1 of", "working distances"})
    expect(wanted);
  for (const char* key : {"title", "question", "answer"}) expect(study_[key].get<std::string>());
  for (const Json& note : study_["notes"]) expect(note.get<std::string>());
  for (const Json& plot : study_["plots"]) {
    expect(plot["title"].get<std::string>());
    expect(plot["x"]["label"].get<std::string>());
    expect(TextAt(plot, "/caption"));
    for (const Json& series : plot["series"]) expect(series["name"].get<std::string>());
    for (const Json& limit : ListAt(plot, "/limits")) expect(limit["text"].get<std::string>());
  }
}

TEST_F(StudyReport, LogarithmicAxesAreLabelledAtPowersOfTen) {
  study_["plots"] = Json::array({study_["plots"][0]});
  for (const char* key : {"images", "tables", "notes", "settings", "comparison"}) study_.erase(key);
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  std::istringstream words(TextOfPdf());
  std::vector<std::string> all;
  for (std::string word; words >> word;) all.push_back(word);
  for (const char* tick : {"100", "1000", "10000", "0.1", "1"})
    EXPECT_NE(std::find(all.begin(), all.end(), tick), all.end()) << tick;
}

TEST_F(StudyReport, HasABookmarkForEverySectionThatIsThere) {
  study_.erase("notes");
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_QPDF, "qpdf");
  const std::string outlines =
      RunTool(std::string(TELESTRAIN_TOOL_QPDF) + " --json --json-key=outlines '" + Pdf() + "'")
          .output;
  for (const char* title :
       {"Question", "Answer", "Comparison with the paper", "Plots", "Images", "Tables", "Settings"})
    EXPECT_NE(outlines.find(title), std::string::npos) << title;
  EXPECT_EQ(outlines.find("Notes"), std::string::npos);
}

TEST_F(StudyReport, ATitleIsEnough) {
  study_ = {{"schema", "telestrain.study/1"}, {"study", "convergence"}, {"title", "Convergence"}};
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const std::string text = WithoutSpace(TextOfPdf());
  EXPECT_NE(text.find("Page1of1"), std::string::npos) << text;
  EXPECT_NE(text.find("Convergence"), std::string::npos) << text;
}

TEST_F(StudyReport, EmptySeriesAndNoSeriesLeaveAnEmptyChart) {
  study_["plots"][0]["series"] = Json::array();
  study_["plots"][1]["series"][0]["x"] = Json::array();
  study_["plots"][1]["series"][0]["y"] = Json::array();
  Make();
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const std::string text = WithoutSpace(TextOfPdf());
  for (const std::size_t plot : {0, 1})
    EXPECT_NE(text.find(WithoutSpace(study_["plots"][plot]["title"])), std::string::npos) << text;
}

TEST_F(StudyReport, TheSameStudyGivesTheSameBytes) {
  Make();
  const std::string first = FileBytes(Pdf());
  Make();
  EXPECT_EQ(FileBytes(Pdf()), first);
}

TEST_F(StudyReport, WhatIsMalformedIsNamedAndLeavesNoFile) {
  Make();
  const Json good = study_;
  const std::vector<std::tuple<const char*, Json, const char*>> cases = {
      {"/title", nullptr, "/title: is missing"},
      {"/plots/0/series/1/kind", "lines", "did you mean 'line'"},
      {"/plots/0/series/0/y/2", 0, "/plots/0/series/0/y/2: is 0, a logarithmic axis"},
      {"/plots/0/series/0/y/2", "x", "/plots/0/series/0/y/2"},
      {"/plots/0/x/low", -1, "/plots/0/x/low"},
      {"/plots/0/limits/0/y", nullptr, "/plots/0/limits/0/y"},
      {"/plots/1/series/0/x/3", 0.01, "must grow"},
      {"/plots/2/series/2/half_height", Json::array({1}), "/plots/2/series/2: x, y"},
      {"/comparison/0/met", "yes", "/comparison/0/met"},
      {"/comparison/1/paper", 0.25, "/comparison/1/paper"},
      {"/tables/0/rows/3", Json::array({1}), "/tables/0/rows/3: has 1 cells"},
      {"/tables/0/rows/3/1", true, "/tables/0/rows/3/1"},
      {"/settings/0/value", nullptr, "/settings/0/value"},
      {"/images/0/file", "none.png", "/images/0/file"},
      {"/schema", "telestrain.study/9", "telestrain.study/9"}};
  for (const auto& [pointer, value, wanted] : cases) {
    study_ = good;
    study_[Json::json_pointer(pointer)] = value;
    const Status written = Write();
    ASSERT_FALSE(written) << pointer;
    EXPECT_EQ(written.error().kind, ErrorKind::kBadInput);
    EXPECT_NE(written.error().message.find(wanted), std::string::npos) << written.error().message;
    EXPECT_FALSE(std::filesystem::exists(Pdf())) << pointer;
  }
}

}  // namespace
}  // namespace telestrain
