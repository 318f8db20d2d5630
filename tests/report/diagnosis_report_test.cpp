#include <gtest/gtest.h>

#include "pdf_tools.h"
#include "report/acceptance_report.h"
#include "results_fixture.h"

namespace telestrain {
namespace {

class DiagnosisReport : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = TestFolder(::testing::UnitTest::GetInstance()->current_test_info()->name());
    fixture_ = PlausibleResults();
    fixture_.pictures = false;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // What the report of the fixture says, without spaces.
  std::string TextOfReport() {
    WriteResults(fixture_, folder_);
    const auto made = MakeResults(folder_);
    EXPECT_TRUE(made) << made.error().message;
    ReportOptions options;
    options.name = "calibration";  // the report that shows the diagnosis and no strain
    const Status written = WriteReport(folder_, options);
    EXPECT_TRUE(written) << written.error().message;
    return WithoutSpace(RunTool(std::string(TELESTRAIN_TOOL_PDFTOTEXT) + " -layout -enc UTF-8 '" +
                                (folder_ / "report.pdf").string() + "' -")
                            .output);
  }
  // Its section of the diagnosis; others say "not measured" of what nobody measures.
  static std::string DiagnosisPart(const std::string& text) {
    const std::size_t begin = text.rfind("4Diagnosisofthecalibration");
    const std::size_t end = text.find("5Scene", begin);
    EXPECT_NE(begin, std::string::npos);
    EXPECT_NE(end, std::string::npos);
    return begin < end ? text.substr(begin, end - begin) : "";
  }
  static int Count(const std::string& text, const std::string& wanted) {
    int count = 0;
    for (std::size_t at = text.find(wanted); at != std::string::npos;
         at = text.find(wanted, at + 1))
      ++count;
    return count;
  }
  std::filesystem::path folder_;
  ResultsFixture fixture_;
};

TEST_F(DiagnosisReport, ShowsEveryChart) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const std::string text = TextOfReport();
  for (const char* wanted :
       {"4 Diagnosis of the calibration", "Residual of one coordinate / px", "Gaussian",
        "Length of a corner's residual / px", "Rayleigh", "± 3 σ", "Working distance D / m",
        "telecentric", "mrcal agrees.", "The residuals are noise.",
        "How well the views know where they project", "View U2", "Standard uncertainty / µm"})
    EXPECT_NE(text.find(WithoutSpace(wanted)), std::string::npos) << wanted;
  EXPECT_EQ(Count(DiagnosisPart(text), "notmeasured"), 0);
}

TEST_F(DiagnosisReport, DrawsEveryViewTwiceHoweverManyThereAre) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const nlohmann::ordered_json view = fixture_.diagnosis["residuals"]["views"][0];
  for (const int count : {1, 2, 8}) {
    auto& views = fixture_.diagnosis["residuals"]["views"];
    views = nlohmann::ordered_json::array();
    for (int i = 0; i < count; ++i) {
      views.push_back(view);
      views.back()["view"] = "Q" + std::to_string(i);
    }
    const std::string text = TextOfReport();
    for (int i = 0; i < count; ++i) EXPECT_EQ(Count(text, "ViewQ" + std::to_string(i)), 2) << i;
  }
}

TEST_F(DiagnosisReport, SaysThatNothingWasDiagnosed) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  fixture_.diagnosis = nullptr;
  const std::string text = TextOfReport();
  EXPECT_NE(text.find("notdiagnosed"), std::string::npos);
  EXPECT_EQ(text.find("Rayleigh"), std::string::npos);
}

TEST_F(DiagnosisReport, ShowsADisagreementOnTheFirstPage) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  fixture_.diagnosis["independent_optimum"]["agrees"] = false;
  const std::string text = TextOfReport();
  const std::string first = text.substr(0, text.find('\f'));
  EXPECT_NE(first.find("FAIL"), std::string::npos);
  EXPECT_NE(first.find("DISAGREE"), std::string::npos);
}

TEST_F(DiagnosisReport, BrokenPartsAreDrawnAsMissing) {
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  auto& residuals = fixture_.diagnosis["residuals"];
  residuals["histogram"]["gaussian"] = 3;
  residuals["histogram"]["bin_px"] = 0;
  residuals["directions"]["counts"] = "many";
  for (auto& view : residuals["views"]) view["regional"]["mean_px"] = {1, 2, 3};
  for (auto& view : residuals["views"]) view["regional"]["step_x_px"] = -1;
  fixture_.diagnosis["uncertainty"]["maps"] = {{{"view", "U1"}, {"columns", -1}}};
  EXPECT_EQ(Count(DiagnosisPart(TextOfReport()), "notmeasured"), 7);
}

}  // namespace
}  // namespace telestrain
