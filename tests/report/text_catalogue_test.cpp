#include "report/text_catalogue.h"

#include <gtest/gtest.h>

#include "report/result_cells.h"
#include "report/text_filling.h"

namespace telestrain {
namespace {

TextCatalogue German() {
  const auto folder = TemplateFolder::Open({});
  auto catalogue = TextCatalogue::Load(*folder, "de");
  EXPECT_TRUE(catalogue) << catalogue.error().message;
  return *catalogue;
}

TEST(TextFilling, FillsNamesAndSections) {
  const Json values = {{"a", {{"b", "<&>"}}}, {"n", 3}, {"empty", ""}, {"null", nullptr}};
  EXPECT_EQ(FillText("x {{a.b}} y {{n}}", values), "x <&> y 3");  // nothing is escaped
  EXPECT_EQ(FillText("{{#a.b}}has {{a.b}}{{/a.b}}", values), "has <&>");
  EXPECT_EQ(FillText("{{#empty}}has{{/empty}}{{^empty}}none{{/empty}}", values), "none");
  EXPECT_EQ(FillText("{{^null}}none{{/null}}{{no}}", values), "none");
  EXPECT_FALSE(TextFault("{{a}} {{#b}}{{/b}}"));
  EXPECT_TRUE(TextFault("{{#b}}"));
  EXPECT_TRUE(TextFault("{{a"));
  EXPECT_TRUE(TextFault("{{/a/b}}"));
  EXPECT_EQ(NamesInText("{{#a.b}}{{a.b}}{{/a.b}} {{ c }}"), (std::set<std::string>{"a.b", "c"}));
}

TEST(TextCatalogue, SaysTextsCellsAndPhrases) {
  const TextCatalogue german = German();
  EXPECT_EQ(german.Say("Limit"), "Grenzwert");
  EXPECT_EQ(german.SayCell(VerdictCell(Verdict::kPass)), "✓ erfüllt");
  EXPECT_EQ(german.SayCell(FixedCell(1.25, 2)), "1.25");  // numbers stay
  EXPECT_EQ(german.SayCell("calibration/pose_001.png"), "calibration/pose_001.png");
  EXPECT_EQ(german.SayPhrase(Phrase("{{wrong}} of {{starts}}", {{"wrong", "1"}, {"starts", "9"}})),
            "1 von 9");
  // Values are said in their turn, and a phrase may stand in a phrase.
  const Json inner = Phrase("D = {{distance}}", {{"distance", "2 m"}});
  EXPECT_EQ(german.SayPhrase(Phrase("Repeatability: {{method}}.", {{"method", inner}})),
            "Wiederholpräzision: D = 2 m.");
  EXPECT_EQ(german.SayPhrase(JoinPhrases({"mrcal agrees.", "The residuals are noise."})),
            "mrcal stimmt überein. Die Residuen sind Rauschen.");
  // A sentence from outside with braces of its own is printed as it is.
  EXPECT_EQ(german.SayPhrase({{"printed", "a {{ b"}, {"pattern", "a {{ b"}}), "a {{ b");
}

TEST(TextCatalogue, NamesWhatItCannotTranslate) {
  TextCatalogue german = German();
  std::set<std::string> missing;
  german.on_untranslated = [&](const std::string& text) { missing.insert(text); };
  EXPECT_EQ(german.Say("No such wording"), "No such wording");
  german.Say("12.5 ± 0.3");
  german.SayPhrase(Phrase("{{a}} ({{b}})", {{"a", "x"}, {"b", "y"}}));
  german.SayCell("ruler_003.png");
  EXPECT_EQ(missing, (std::set<std::string>{"No such wording"}));
  TextCatalogue english;
  english.on_untranslated = german.on_untranslated;
  english.Say("Another one");
  EXPECT_EQ(missing.size(), 1u);
}

}  // namespace
}  // namespace telestrain
