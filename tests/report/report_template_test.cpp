#include "report/report_template.h"

#include <gtest/gtest.h>

namespace telestrain {
namespace {

std::string Layout(const std::string& blocks) {
  return R"({"schema": "telestrain.template/1", "blocks": [)" + blocks + "]}";
}

TEST(ReportTemplate, TheBuiltInOneIsValid) {
  const auto layout = ReportTemplate::BuiltIn();
  ASSERT_TRUE(layout) << layout.error().message;
  EXPECT_GT(layout->blocks().size(), 20u);
}

TEST(ReportTemplate, ErrorsNameThePointerAndTheRemedy) {
  struct Case {
    std::string text;
    std::vector<std::string> wanted;
  };
  const Case cases[] = {
      {"{", {"layout.json", "not valid JSON"}},
      {"[]", {"layout.json: /: must be an object"}},
      {R"({"schema": "x", "blocks": [{"type": "page-break"}]})",
       {"/schema", "telestrain.template/1"}},
      {R"({"schema": "telestrain.template/1"})", {"/blocks"}},
      {R"({"schema": "telestrain.template/1", "block": []})", {"/block", "did you mean 'blocks'"}},
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
  };
  for (const Case& c : cases) {
    const auto layout = ReportTemplate::Parse("layout.json", c.text);
    ASSERT_FALSE(layout) << c.text;
    EXPECT_EQ(layout.error().kind, ErrorKind::kBadInput);
    for (const std::string& wanted : c.wanted)
      EXPECT_NE(layout.error().message.find(wanted), std::string::npos) << layout.error().message;
  }
}

TEST(ReportTemplate, FillsInTheFirstValueThatExists) {
  const Json values = {{"a", {{"b", "text"}}}, {"n", 3}};
  EXPECT_EQ(FillIn("x {{/a/b}} y {{/n}}", values), "x text y 3");
  EXPECT_EQ(FillIn("{{/no|/a/b}}", values), "text");
  EXPECT_EQ(FillIn("{{/no|/neither|else}}", values), "else");
  EXPECT_EQ(FillIn("{{/no}}", values), "");
  EXPECT_EQ(FillIn("open {{ stays", values), "open {{ stays");
}

TEST(ReportTemplate, TranslatesKnownTextsOnly) {
  const auto layout = ReportTemplate::Parse(
      "t", R"({"schema": "telestrain.template/1", "labels": {"Limit": "Grenzwert"},
              "blocks": [{"type": "page-break"}]})");
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->Translate("Limit"), "Grenzwert");
  EXPECT_EQ(layout->Translate("Unit"), "Unit");
}

}  // namespace
}  // namespace telestrain
