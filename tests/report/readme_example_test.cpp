#include <gtest/gtest.h>

#include <fstream>

#include "pdf_tools.h"
#include "report/json_lookup.h"
#include "report/template_list.h"
#include "results_fixture.h"

namespace telestrain {
namespace {

// The example of templates/README.md, word for word.
std::string ExampleOfTheReadme() {
  const std::string readme = FileBytes(std::string(TELESTRAIN_SOURCE_DIR) + "/templates/README.md");
  const std::string open = "```json\n";
  const std::size_t begin = readme.find(open), end = readme.find("```\n", begin + open.size());
  return readme.substr(begin + open.size(), end - begin - open.size());
}

class ReadmeExample : public ::testing::Test {
 protected:
  void SetUp() override {
    results_ = TestFolder("readme") / "results";
    templates_ = TestFolder("readme") / "templates";
    WriteResults(PlausibleResults(), results_);
    std::filesystem::create_directories(templates_);
    std::ofstream(templates_ / "incoming.json") << ExampleOfTheReadme();
    WritePicture(templates_ / "logo.png", 120, 60);
    options_.templates = templates_;
    options_.name = "incoming";
  }
  void TearDown() override { std::filesystem::remove_all(TestFolder("readme")); }
  void Make() {
    const auto scope = ScopeOfLayout(options_);
    ASSERT_TRUE(scope) << scope.error().message;
    const auto outcome = MakeResults(results_, scope->scope);
    ASSERT_TRUE(outcome) << outcome.error().message;
    const Status written = WriteReport(results_, options_);
    ASSERT_TRUE(written) << written.error().message;
  }
  std::string Pdf() const { return (results_ / "report.pdf").string(); }

  std::filesystem::path results_, templates_;
  ReportOptions options_;
};

TEST_F(ReadmeExample, ChangesTheLimitTheTextsAndTheLogo) {
  Make();
  const Json results = Json::parse(FileBytes((results_ / "results.json").string()));
  const Json& error = FindBy(ListAt(results, "/quantities"), "id", "ruler_error");
  EXPECT_EQ(NumberAt(error, "/limit"), 5);
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const std::string text =
      RunTool(std::string(TELESTRAIN_TOOL_PDFTOTEXT) + " -layout -enc UTF-8 '" + Pdf() + "' -")
          .output;
  EXPECT_NE(text.find("Incoming inspection"), std::string::npos);
  EXPECT_NE(text.find("Tolerance"), std::string::npos);
  EXPECT_NE(text.find("± 5"), std::string::npos);
  EXPECT_NE(text.find("Inspected for Müller Rohrwerke GmbH, Köln."), std::string::npos);
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFIMAGES, "pdfimages");
  const std::string images =
      RunTool(std::string(TELESTRAIN_TOOL_PDFIMAGES) + " -list '" + Pdf() + "'").output;
  EXPECT_NE(images.find("120    60"), std::string::npos) << images;
}

}  // namespace
}  // namespace telestrain
