#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "pdf_tools.h"
#include "report/layout_file.h"
#include "report/report_charts.h"
#include "report/report_template.h"
#include "report/template_list.h"
#include "results_fixture.h"

namespace telestrain {
namespace {

std::set<std::string> WordsOf(const char* definition) {
  const Json& schema = BuiltInSchema("template.schema.json");
  std::set<std::string> words;
  for (const Json& word : ListAt(schema, std::string("/$defs/") + definition + "/enum"))
    words.insert(word.get<std::string>());
  return words;
}

TEST(Layouts, EveryChartOfTheSchemaCanBeDrawnAndNoOther) {
  const auto drawn = ChartNames();
  EXPECT_EQ(WordsOf("chart"), std::set<std::string>(drawn.begin(), drawn.end()));
}

// A name that no source writes could never be drawn.
TEST(Layouts, EveryTableOfTheSchemaIsMadeByTheProgram) {
  std::string sources;
  for (const auto& file :
       std::filesystem::directory_iterator(std::string(TELESTRAIN_SOURCE_DIR) + "/report"))
    if (file.path().extension() == ".cpp") sources += FileBytes(file.path().string());
  const auto names = WordsOf("table");
  EXPECT_GT(names.size(), 40u);
  for (const std::string& name : names)
    EXPECT_NE(sources.find("\"" + name + "\""), std::string::npos) << name;
}

// The other way round: a table that the schema does not know could never be named.
TEST(Layouts, EveryTableOfTheResultsCanBeNamed) {
  const auto folder = TestFolder("every_table");
  WriteResults(PlausibleResults(), folder);
  ASSERT_TRUE(MakeResults(folder));
  const auto names = WordsOf("table");
  const Json results = Json::parse(FileBytes((folder / "results.json").string()));
  ASSERT_FALSE(ListAt(results, "/tables").empty());
  for (const Json& table : ListAt(results, "/tables"))
    EXPECT_TRUE(names.count(TextAt(table, "/id"))) << TextAt(table, "/id");
}

TEST(Layouts, EveryBuiltInOneIsRightAndUsesEverySection) {
  const auto list = ListTemplates({});
  ASSERT_TRUE(list);
  std::vector<std::string> names;
  for (const NamedTemplate& layout : list->layouts) names.push_back(layout.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"acceptance", "calibration", "reverification", "strain"}));
  std::string all;
  for (const std::string& name : names) {
    const auto layout = ReportTemplate::Load({{}, name, "en"});
    ASSERT_TRUE(layout) << layout.error().message;
    all += layout->blocks().dump();
  }
  const auto folder = TemplateFolder::Open({});
  for (const std::string& section : folder->Names("sections")) {
    const Json blocks = Json::parse(TemplateFolder::BuiltIn("sections/" + section + ".json").text);
    for (const Json& block : blocks)
      EXPECT_TRUE(block.contains("include") || all.find(block.dump()) != std::string::npos)
          << section << ": " << block;
  }
}

TEST(Layouts, SayTheirScope) {
  ReportOptions options;
  options.name = "calibration";
  const auto calibration = ScopeOfLayout(options);
  ASSERT_TRUE(calibration);
  EXPECT_EQ(calibration->scope.sections, (std::vector<std::string>{"calibration", "diagnosis"}));
  EXPECT_FALSE(calibration->against_earlier);
  options.name = "reverification";
  const auto reverification = ScopeOfLayout(options);
  ASSERT_TRUE(reverification);
  EXPECT_EQ(reverification->scope.name, "reverification");
  EXPECT_TRUE(reverification->against_earlier);
}

TEST(Layouts, HeadingsThatAreDrawnAreNumbered) {
  const auto layout = ReportTemplate::Load({});
  ASSERT_TRUE(layout);
  const Json none = layout->FillValues({{"measured", Json::object()}});
  EXPECT_EQ(TextAt(none, "/section/summary"), "1");
  EXPECT_EQ(TextAt(none, "/section/calibration"), "3");
  EXPECT_EQ(TextAt(none, "/report/number"), "without number");
  EXPECT_EQ(TextAt(none, "/report/title"), "Acceptance report");
  const auto conditional = ReportTemplate::Parse("t", R"({"schema": "telestrain.template/1",
      "title": "x", "blocks": [
        {"type": "heading", "text": "a", "id": "a", "when": "ruler"},
        {"type": "heading", "text": "b", "id": "b"},
        {"type": "heading", "text": "c", "id": "c", "level": 2}]})");
  ASSERT_TRUE(conditional);
  EXPECT_EQ(TextAt(conditional->FillValues({{"measured", {{"ruler", true}}}}), "/section/b"), "2");
  const Json without = conditional->FillValues({{"measured", {{"ruler", false}}}});
  EXPECT_EQ(TextAt(without, "/section/b"), "1");
  EXPECT_EQ(TextAt(without, "/section/a", "none"), "none");
  EXPECT_EQ(TextAt(without, "/section/c", "none"), "none");
}

class OwnFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = TestFolder("own_folder");
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "sections");
    std::filesystem::create_directories(folder_ / "texts");
  }
  void Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  void WriteLayout(const std::string& name, const std::string& more, const std::string& blocks) {
    Write(name + ".json", R"({"schema": "telestrain.template/1", "title": "Own")" + more +
                              R"(, "blocks": [)" + blocks + "]}");
  }
  Result<ReportTemplate> Load(const std::string& name, const std::string& language = "en") {
    return ReportTemplate::Load({folder_, name, language});
  }
  void ExpectFault(const std::string& name, const std::vector<std::string>& wanted) {
    const auto layout = Load(name);
    ASSERT_FALSE(layout) << name;
    for (const std::string& part : wanted)
      EXPECT_NE(layout.error().message.find(part), std::string::npos) << layout.error().message;
  }

  std::filesystem::path folder_;
};

TEST_F(OwnFolder, AddsLayoutsAndReplacesSectionsTheRestIsBuiltIn) {
  WriteLayout("mine", "", R"({"include": "ruler"}, {"include": "sign-off"})");
  Write("sections/ruler.json", R"([{"type": "text", "text": "my ruler"}])");
  const auto layout = Load("mine");
  ASSERT_TRUE(layout) << layout.error().message;
  EXPECT_EQ(TextAt(layout->blocks(), "/0/text"), "my ruler");
  EXPECT_EQ(TextAt(layout->blocks(), "/2/type"), "signatures");
  const auto acceptance = Load("acceptance");
  ASSERT_TRUE(acceptance);
  EXPECT_NE(acceptance->blocks().dump().find("my ruler"), std::string::npos);
  const auto list = ListTemplates(folder_);
  ASSERT_TRUE(list);
  EXPECT_EQ(list->layouts.size(), 5u);
}

TEST_F(OwnFolder, AListNamesAFileThatCannotBeReadAndTheOthers) {
  WriteLayout("mine", "", R"({"type": "page-break"})");
  Write("broken.json", "{,}");
  const auto list = ListTemplates(folder_);
  ASSERT_TRUE(list) << list.error().message;
  ASSERT_EQ(list->layouts.size(), 6u);
  for (const NamedTemplate& layout : list->layouts)
    EXPECT_EQ(layout.fault.find("broken.json: is not valid JSON") != std::string::npos,
              layout.name == "broken")
        << layout.name << layout.fault;
}

TEST_F(OwnFolder, ErrorsNameFilePointerAndTheNearestWord) {
  WriteLayout("mine", "", R"({"include": "rular"})");
  ExpectFault("mine", {"mine.json: /blocks/0/include", "did you mean 'ruler'"});
  ExpectFault("mein", {"no layout 'mein'", "did you mean 'mine'", "--list"});
  WriteLayout("mine", "", R"({"include": "loop"})");
  Write("sections/loop.json", R"([{"include": "loop"}])");
  ExpectFault("mine", {"loop.json: /0/include", "includes itself"});
  Write("sections/loop.json", R"([{"type": "table", "table": "sumary"}])");
  ExpectFault("mine", {"loop.json: /0/table", "did you mean 'summary'"});
  Write("sections/loop.json", R"([{"type": "text", "text": "{{#a}} never closed"}])");
  ExpectFault("mine", {"loop.json: /0/text", "Unclosed section"});
  Write("sections/loop.json", R"([{"type": "text", "text": "{{/document/number}}"}])");
  ExpectFault("mine", {"loop.json: /0/text", "{{document.number}}"});
  Write("mine.json", "{");
  ExpectFault("mine", {"mine.json", "not valid JSON"});
}

TEST_F(OwnFolder, LooksAndLimitsAreCheckedAndTaken) {
  WriteLayout("mine", R"(, "look": {"accent": "#FF8000", "base_size_pt": 10},
                          "limits": {"ruler_mpe_um": 5})",
              R"({"type": "page-break"})");
  const auto layout = Load("mine");
  ASSERT_TRUE(layout) << layout.error().message;
  EXPECT_DOUBLE_EQ(layout->look().accent.red, 1);
  EXPECT_DOUBLE_EQ(layout->look().accent.green, 128 / 255.0);
  EXPECT_DOUBLE_EQ(layout->look().Body().size_pt, 10);
  ReportOptions options;
  options.templates = folder_;
  options.name = "mine";
  const auto scope = ScopeOfLayout(options);
  ASSERT_TRUE(scope);
  EXPECT_EQ(scope->scope.limits.at("ruler_mpe_um"), 5);
  for (const auto& [more, wanted] : std::vector<std::pair<std::string, std::string>>{
           {R"("look": {"accent": "red"})", "/look/accent"},
           {R"("look": {"base_size_pt": 30})", "/look/base_size_pt: is 30, allowed are 7 to 11"},
           {R"("look": {"logo": "../logo.png"})", "/look/logo"},
           {R"("look": {"logo": "none.png"})", "none.png"},
           {R"("limits": {"ruler_mpe": 5})", "did you mean 'ruler_mpe_um'"},
           {R"("limits": {"ruler_mpe_um": 0})", "/limits/ruler_mpe_um: is 0"},
           {R"("scope": {"sections": ["rular"]})", "did you mean 'ruler'"}}) {
    WriteLayout("mine", ", " + more, R"({"type": "page-break"})");
    ExpectFault("mine", {wanted});
  }
  Write("bad.png", "no picture");
  WriteLayout("mine", R"(, "look": {"logo": "bad.png"})", R"({"type": "page-break"})");
  ExpectFault("mine", {"/look/logo", "bad.png"});
}

TEST_F(OwnFolder, ANewLanguageAndSingleWordingsOfABuiltInOne) {
  WriteLayout("mine", R"(, "labels": {"Limit": "Toleranz"})", R"({"type": "page-break"})");
  Write("texts/de.json", R"({"schema": "telestrain.texts/1", "language": "de", "name": "Deutsch",
                             "texts": {"Verdict": "Bewertung", "Limit": "Schranke"}})");
  Write("texts/fr.json", R"({"schema": "telestrain.texts/1", "language": "fr", "name": "Français",
                             "texts": {"Verdict": "Verdict"}})");
  const auto german = Load("mine", "de");
  ASSERT_TRUE(german) << german.error().message;
  EXPECT_EQ(german->Say("Verdict"), "Bewertung");
  EXPECT_EQ(german->Say("Limit"), "Toleranz");  // the layout's label goes first
  EXPECT_EQ(german->Say("Quantity"), "Messgröße");
  EXPECT_TRUE(Load("mine", "fr"));
  const auto list = ListTemplates(folder_);
  ASSERT_TRUE(list);
  std::string languages;
  for (const NamedTemplate& language : list->languages)
    languages += language.name + " " + language.title + ";";
  EXPECT_EQ(languages, "de Deutsch;en English;fr Français;zh 中文;");
  const auto unknown = Load("mine", "dee");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().kind, ErrorKind::kUsage);
  EXPECT_NE(unknown.error().message.find("'de'"), std::string::npos) << unknown.error().message;
}

TEST_F(OwnFolder, ATranslationThatLosesAValueIsRejected) {
  Write("texts/fr.json", R"({"schema": "telestrain.texts/1", "language": "fr", "name": "Français",
                             "texts": {"{{a}} of {{b}}": "{{a}} de {{c}}"}})");
  const auto layout = Load("acceptance", "fr");
  ASSERT_FALSE(layout);
  for (const char* wanted : {"fr.json: /texts/{{a}} of {{b}}", "{{c}}", "wanted {{a}} {{b}}"})
    EXPECT_NE(layout.error().message.find(wanted), std::string::npos) << layout.error().message;
}

}  // namespace
}  // namespace telestrain
