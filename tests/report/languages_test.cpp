#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>

#include "pdf_tools.h"
#include "report/report_template.h"
#include "report/template_list.h"
#include "results_fixture.h"

namespace telestrain {
namespace {

// Texts of the session: they are printed as they were given.
std::set<std::string> GivenTexts(const Json& json) {
  std::set<std::string> texts;
  const auto walk = [&](const auto& self, const Json& entry) -> void {
    if (entry.is_string()) texts.insert(entry.get<std::string>());
    if (entry.is_object())
      for (const auto& [key, value] : entry.items()) texts.insert(key), self(self, value);
    if (entry.is_array())
      for (const Json& value : entry) self(self, value);
  };
  walk(walk, json);
  return texts;
}

// Numbers, units, names of files, views, parameters and hashes are the same in every language.
bool IsSameInEveryLanguage(const std::string& text) {
  static const std::regex kNumbers(
      R"([-+±≤ ()0-9.e/⁻⁹·<|]*(px|mm|µm|µε|m|rad|s|min|ppm|%|°)?[0-9² ()]*)");
  static const std::regex kUnits(
      R"((10⁻⁶ |10⁻⁹ |n|µ|m|p)?(px|mm|m|rad|ppm|g)?[²³⁴]?(/(px|mm|µm|°|h|m)[²⁴⁶]?)?)");
  static const std::regex kNames(
      R"(([ABU]?[0-9]|[a-zA-Z0-9_]+/[^ ]*|[^ ]+\.[a-z]{2,5}|[pP][0-9]+|[0-9a-f]{64}|[kpuvxytAB][0-9]?(,? [kpAB][0-9])*))");
  static const std::regex kPrograms(R"(telestrain|mrcal|ZNSSD|SHA-256|µm|RMS|JCGM 100)");
  return std::regex_match(text, kNumbers) || std::regex_match(text, kUnits) ||
         std::regex_match(text, kNames) || std::regex_match(text, kPrograms);
}

// Sentences that the fixture invents in the place of the program's own.
const std::set<std::string>& Invented() {
  static const std::set<std::string> kTexts = {
      "ZNCC below {{v1}}",
      "correlation noise",
      "epipolar",
      "gauge_3_microstrain",
      "No drift is resolved.",
      "the array frame is fixed by the mean of the nominal view axes",
      "the origin is the mean of the views' centres",
      "the board is cut off by the edge of the region: {{v1}} of {{v2}} corners found, at least "
      "{{v3}} are needed",
      "the board is cut off by the edge of the region",
      "{{v1}} corners farther than {{v2}} sigma from the model",
      "view {{v1}}: no cross found",
      "{{v1}} values of one length; {{v2}} more are wanted."};
  return kTexts;
}

bool HasLatinLetter(const std::string& text) {
  return std::any_of(text.begin(), text.end(),
                     [](unsigned char c) { return c < 0x80 && std::isalpha(c) != 0; });
}

// Every text cell of the tables and every value of a phrase in them.
void CollectCells(const Json& entry, std::set<std::string>& texts) {
  if (entry.is_string()) texts.insert(entry.get<std::string>());
  if (entry.is_object() && entry.contains("pattern")) {
    for (const Json& value : entry["values"]) CollectCells(value, texts);
  } else if (entry.is_object() && entry.contains("printed")) {
    CollectCells(entry["printed"], texts);
  }
}

struct Case {
  std::string layout, language;
};

class Languages : public ::testing::TestWithParam<Case> {
 protected:
  static void TearDownTestSuite() { std::filesystem::remove_all(TestFolder("languages")); }

  void SetUp() override {
    options_.name = GetParam().layout;
    options_.language = GetParam().language;
    options_.on_untranslated = [this](const std::string& text) { missing_.insert(text); };
    WriteResults(PlausibleResults(), Results());
    auto scope = ScopeOfLayout(options_);
    ASSERT_TRUE(scope) << scope.error().message;
    if (scope->against_earlier) {
      ResultsFixture earlier = PlausibleResults();  // other measurements
      earlier.ruler["images"][0]["error_um"] = 1.5;
      WriteResults(earlier, Earlier());
      ASSERT_TRUE(MakeResults(Earlier()));
      scope->scope.earlier = Earlier();
    }
    const auto outcome = MakeResults(Results(), scope->scope);
    ASSERT_TRUE(outcome) << outcome.error().message;
  }
  std::filesystem::path Results() const { return TestFolder("languages") / "now"; }
  std::filesystem::path Earlier() const { return TestFolder("languages") / "earlier"; }

  // What reaches the page as a cell and has no translation.
  void CollectMissingCells() {
    const auto layout = ReportTemplate::Load({{}, options_.name, options_.language});
    ASSERT_TRUE(layout) << layout.error().message;
    const Json results = Json::parse(FileBytes((Results() / "results.json").string()));
    std::set<std::string> cells;
    for (const Json& table : ListAt(results, "/tables")) {
      for (const Json& column : ListAt(table, "/columns"))
        for (const char* key : {"name", "unit"})
          if (column.contains(key)) CollectCells(column[key], cells);
      for (const Json& row : ListAt(table, "/rows"))
        for (const Json& cell : row) CollectCells(cell, cells);
    }
    const std::set<std::string> given = GivenTexts(EntryAt(results, "/inputs"));
    for (const std::string& text : cells)
      if (HasLatinLetter(text) && !layout->texts().Find(text) && !given.count(text))
        missing_.insert(text);
  }

  ReportOptions options_;
  std::set<std::string> missing_;
};

TEST_P(Languages, EveryTextThatReachesThePageIsTranslated) {
  const Status written = WriteReport(Results(), options_);
  ASSERT_TRUE(written) << written.error().message;
  CollectMissingCells();
  std::string list;
  for (const std::string& text : missing_)
    if (!IsSameInEveryLanguage(text) && !Invented().count(text)) list += "\n  " + text;
  EXPECT_EQ(list, "") << "without translation in templates/texts/" << options_.language << ".json";
}

TEST_P(Languages, TheDocumentSaysItsLanguageAndKeepsItsNumbers) {
  ASSERT_TRUE(WriteReport(Results(), options_));
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFTOTEXT, "pdftotext");
  const std::string pdf = (Results() / "report.pdf").string();
  const std::string text = WithoutSpace(
      RunTool(std::string(TELESTRAIN_TOOL_PDFTOTEXT) + " -layout -enc UTF-8 '" + pdf + "' -")
          .output);
  const Json results = Json::parse(FileBytes((Results() / "results.json").string()));
  const Json& summary = FindBy(ListAt(results, "/tables"), "id", "summary");
  ASSERT_FALSE(ListAt(summary, "/rows").empty());
  for (const Json& row : ListAt(summary, "/rows"))
    for (const char* number : {"/1/printed", "/2/printed", "/3/printed"})
      EXPECT_NE(text.find(WithoutSpace(TextAt(row, number))), std::string::npos) << row.dump();
  const char* title = options_.language == "de" ? "ericht" : "报告";
  EXPECT_NE(text.find(title), std::string::npos);
  NEEDS_TOOL(TELESTRAIN_TOOL_QPDF, "qpdf");
  const std::string catalog =
      RunTool(std::string(TELESTRAIN_TOOL_QPDF) + " --qdf --object-streams=disable '" + pdf + "' -")
          .output;
  EXPECT_NE(catalog.find("/Lang (" + options_.language + ")"), std::string::npos);
}

std::vector<Case> Cases() {
  std::vector<Case> cases;
  for (const char* layout : {"acceptance", "calibration", "reverification", "strain"})
    for (const char* language : {"de", "zh"}) cases.push_back({layout, language});
  return cases;
}

INSTANTIATE_TEST_SUITE_P(All, Languages, ::testing::ValuesIn(Cases()), [](const auto& test) {
  return test.param.layout + "_" + test.param.language;
});

}  // namespace
}  // namespace telestrain
