#include "report/report_template.h"

#include <gtest/gtest.h>

#include "report/layout_notes.h"

namespace telestrain {
namespace {

std::string Layout(const std::string& blocks) {
  return R"({"schema": "telestrain.template/1", "title": "t", "blocks": [)" + blocks + "]}";
}

TEST(ReportTemplate, TheBuiltInOneIsValid) {
  const auto layout = ReportTemplate::Load({});
  ASSERT_TRUE(layout) << layout.error().message;
  EXPECT_GT(layout->blocks().size(), 20u);
}

// A layout and what the error about it names.
struct Case {
  std::string text;
  std::vector<std::string> wanted;
};

void ExpectErrors(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    const auto layout = ReportTemplate::Parse("layout.json", c.text);
    ASSERT_FALSE(layout) << c.text;
    EXPECT_EQ(layout.error().kind, ErrorKind::kBadInput);
    for (const std::string& wanted : c.wanted)
      EXPECT_NE(layout.error().message.find(wanted), std::string::npos) << layout.error().message;
  }
}

TEST(ReportTemplate, ErrorsNameThePointerAndTheRemedy) {
  ExpectErrors({
      {"{", {"layout.json", "not valid JSON"}},
      {"[]", {"layout.json: /: is a list, must be an object"}},
      {R"({"schema": "x", "title": "t", "blocks": [{"type": "page-break"}]})",
       {"/schema", "telestrain.template/1"}},
      {R"({"schema": "telestrain.template/1", "title": "t"})", {"/: ", "'blocks'"}},
      {R"({"schema": "telestrain.template/1", "title": "t", "blocks": []})", {"/blocks"}},
      {R"({"schema": "telestrain.template/1", "title": "t", "blocks": [{"type": "page-break"}],
           "labls": {}})",
       {"/labls", "did you mean 'labels'"}},
      {Layout("7"), {"/blocks/0", "object"}},
      {Layout(R"({"text": "x"})"), {"/blocks/0", "type"}},
      {Layout(R"({"type": "heading", "text": "x"}, {"type": "tabel"})"),
       {"/blocks/1/type", "did you mean 'table'"}},
      {Layout(R"({"type": "heading"})"), {"/blocks/0", "'text'"}},
      {Layout(R"({"type": "heading", "text": 3})"), {"/blocks/0/text", "must be a text"}},
      {Layout(R"({"type": "heading", "text": "x", "levle": 1})"), {"/blocks/0/levle", "'level'"}},
      {Layout(R"({"type": "heading", "text": "x", "level": 9})"), {"/blocks/0/level", "1 to 2"}},
      {Layout(R"({"type": "table", "table": "sumary"})"), {"/blocks/0/table", "'summary'"}},
      {Layout(R"({"type": "table", "table": "summary", "when": "rular"})"),
       {"/blocks/0/when", "'ruler'"}},
      {Layout(R"({"type": "chart", "charts": ["ruler-eror"], "height_mm": 50})"),
       {"/blocks/0/charts/0", "'ruler-errors'"}},
      {Layout(R"({"type": "chart", "charts": "x", "height_mm": 50})"), {"/blocks/0/charts"}},
      {Layout(R"({"type": "chart", "charts": ["ruler-errors"], "height_mm": 900})"),
       {"/blocks/0/height_mm", "20 to 240"}},
  });
}

TEST(ReportTemplate, UnknownNamesAndRepeatedKeysAreErrors) {
  ExpectErrors({
      {Layout(R"({"type": "text", "text": "{{docment.customer}}"})"),
       {"/blocks/0/text", "{{docment.customer}}", "'document'"}},
      {Layout(R"({"type": "text", "text": "{{page}}"})"), {"/blocks/0/text", "header"}},
      {Layout(R"({"type": "text", "text": "{{report.numbr}}"})"), {"/blocks/0/text", "'number'"}},
      {R"({"schema": "telestrain.template/1", "title": "t", "blocks": [{"type": "page-break"}],
           "footer": {"left": "{{pag}}"}})",
       {"/footer/left", "{{pag}}", "'page'"}},
      {R"({"schema": "telestrain.template/1", "title": "t", "blocks": [{"type": "page-break"}],
           "labels": {"Page {{page}}": "Sheet {{pag}}"}})",
       {"/labels/Page {{page}}", "{{pag}}"}},
      {R"({"schema": "telestrain.template/1", "title": "t",
           "blocks": [{"type": "page-break"}, {"type": "text", "text": "a", "text": "b"}]})",
       {"layout.json: /blocks/1/text", "twice"}},
  });
}

TEST(ReportTemplate, FillsTextsAndSaysLabelsInItsOwnWording) {
  const auto layout =
      ReportTemplate::Parse("t", R"({"schema": "telestrain.template/1", "title": "t",
              "labels": {"Limit": "Tolerance", "Page {{page}}": "Sheet {{page}}"},
              "blocks": [{"type": "page-break"}]})");
  ASSERT_TRUE(layout) << layout.error().message;
  EXPECT_EQ(layout->Say("Limit"), "Tolerance");
  EXPECT_EQ(layout->Say("Unit"), "Unit");
  EXPECT_EQ(layout->Fill("Page {{page}}", {{"page", 3}}), "Sheet 3");
}

TEST(ReportTemplate, TakesEntriesOfADocumentInItsOwnSection) {
  const auto layout = ReportTemplate::Parse(
      "t", Layout(R"({"type": "text", "text": "{{#document}}for {{customer}}{{/document}}"})"));
  ASSERT_TRUE(layout) << layout.error().message;
  EXPECT_EQ(layout->Fill("{{#document}}for {{customer}}{{/document}}",
                         {{"document", {{"customer", "C"}}}}),
            "for C");
}

TEST(ReportTemplate, NotesWhatALayoutAsksForInVain) {
  const auto layout =
      ReportTemplate::Parse("t", R"({"schema": "telestrain.template/1", "title": "t",
               "labels": {"Limmit": "Tolerance", "Limit": "Tolerance"}, "blocks": [
        {"type": "text", "text": "for {{document.custumer}}"},
        {"type": "text", "text": "{{#document.item}}of {{document.item}}{{/document.item}}"}]})");
  ASSERT_TRUE(layout) << layout.error().message;
  const auto notes = LayoutNotes(*layout, {{"document", {{"customer", "C"}}}});
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].find("'Limmit'"), std::string::npos) << notes[0];
  EXPECT_NE(notes[0].find("did you mean 'Limit'"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("document.custumer"), std::string::npos) << notes[1];
  EXPECT_NE(notes[1].find("nearest is 'customer'"), std::string::npos) << notes[1];
  for (const char* name : {"acceptance", "calibration", "reverification", "strain"})
    EXPECT_TRUE(LayoutNotes(*ReportTemplate::Load({{}, name, "en"}), Json::object()).empty());
}

TEST(ReportTemplate, TablesThatCannotBeDrawnAreNamed) {
  const auto layout = ReportTemplate::Load({{}, "acceptance", "en"});
  ASSERT_TRUE(layout) << layout.error().message;
  const auto with = [](const Json& columns, const Json& rows) {
    return Json{
        {"tables", Json::array({{{"id", "boards"}, {"columns", columns}, {"rows", rows}}})}};
  };
  const Json column = Json::array({{{"name", "View"}}});
  EXPECT_TRUE(layout->SayTables(with(column, nullptr)));
  EXPECT_TRUE(layout->SayTables(with(column, Json::array({Json::array({"A1"})}))));
  for (const Json& damaged :
       {with(column, Json::array({"A1"})), with(column, Json::array({Json::array({"A1", "A2"})})),
        with(column, Json::array({Json::array()})), with(Json::array({"View"}), nullptr),
        with(column, "A1"), with("View", nullptr)}) {
    const auto said = layout->SayTables(damaged);
    ASSERT_FALSE(said) << damaged.dump();
    EXPECT_EQ(said.error().kind, ErrorKind::kBadInput);
    EXPECT_NE(said.error().message.find("the table 'boards'"), std::string::npos);
  }
}

// Names that the session gave are never taken for wordings.
TEST(ReportTemplate, SaysTablesAndSentencesNotWhatTheSessionNamed) {
  const auto layout = ReportTemplate::Load({{}, "acceptance", "de"});
  ASSERT_TRUE(layout) << layout.error().message;
  const Json results = Json::parse(R"({
    "title": "Limit", "document": {"customer": "Limit"}, "measured": {"ruler": true},
    "decision": {"printed": "Limit", "coverage_factor": 2},
    "tables": [
      {"id": "a", "title": "Limit", "columns": [{"name": "Limit", "unit": "bytes"}],
       "rows": [["Limit"], [{"value": 1, "printed": "1.0"}], [{"verdict": "pass", "printed": "✓ pass"}]]},
      {"id": "b", "title": "Limit",
       "columns": [{"name": "Name"}, {"name": "Value"}, {"name": "Unit"}],
       "rows": [["Limit", "yes", "mm"]]}]})");
  const Json said = layout->SayTables(results).value();
  EXPECT_EQ(TextAt(said, "/tables/0/title"), "Grenzwert");
  EXPECT_EQ(TextAt(said, "/tables/0/columns/0/name"), "Grenzwert");
  EXPECT_EQ(TextAt(said, "/tables/0/columns/0/unit"), "Byte");
  EXPECT_EQ(TextAt(said, "/tables/0/rows/0/0"), "Grenzwert");
  EXPECT_EQ(TextAt(said, "/tables/0/rows/1/0/printed"), "1.0");
  EXPECT_EQ(NumberAt(said, "/tables/0/rows/1/0/value"), 1);
  EXPECT_EQ(TextAt(said, "/tables/0/rows/2/0/printed"), "✓ erfüllt");
  EXPECT_EQ(TextAt(said, "/tables/0/rows/2/0/verdict"), "pass");
  EXPECT_EQ(TextAt(said, "/tables/1/rows/0/0"), "Grenzwert");
  EXPECT_EQ(TextAt(said, "/tables/1/rows/0/1"), "ja");
  const Json values = layout->FillValues(results);
  EXPECT_EQ(TextAt(values, "/title"), "Limit");
  EXPECT_EQ(TextAt(values, "/document/customer"), "Limit");
  EXPECT_EQ(TextAt(values, "/decision/printed"), "Grenzwert");
  EXPECT_EQ(NumberAt(values, "/decision/coverage_factor"), 2);
  EXPECT_EQ(TextAt(values, "/report/title"), "Abnahmebericht");
}

}  // namespace
}  // namespace telestrain
