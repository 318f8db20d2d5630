#include <gtest/gtest.h>

#include "report/result_cells.h"

namespace telestrain {
namespace {

TEST(Phrase, PrintsItsPatternWithTheValues) {
  const Json phrase = Phrase("U (k = {{k}}) of {{name}}", {{"k", "2"}, {"name", "E"}});
  EXPECT_EQ(TextAt(phrase, "/printed"), "U (k = 2) of E");
  EXPECT_EQ(TextAt(phrase, "/pattern"), "U (k = {{k}}) of {{name}}");
  EXPECT_EQ(TextAt(phrase, "/values/name"), "E");
}

// A name of a file may look like a place of the pattern, and must stay what it is.
TEST(Phrase, AValueIsNeverReadAsAPattern) {
  const Json phrase = Phrase("{{a}} and {{b}}", {{"a", "{{b}}"}, {"b", "{{a}}"}});
  EXPECT_EQ(TextAt(phrase, "/printed"), "{{b}} and {{a}}");
}

TEST(Phrase, APhraseInAPhraseIsPrinted) {
  const Json reason = Phrase("{{count}} corners found", {{"count", "61"}});
  const Json phrase = Phrase("detection: {{reason}}", {{"reason", reason}});
  EXPECT_EQ(TextAt(phrase, "/printed"), "detection: 61 corners found");
  EXPECT_EQ(TextAt(phrase, "/values/reason/pattern"), "{{count}} corners found");
}

TEST(Phrase, AFinishedSentenceGivesUpItsNumbersAndNames) {
  const std::string text = "view B2: 61 of 117 corners (2.5 %), see pipe/pipe_000.png.";
  const Json phrase = PhraseOfText(text);
  EXPECT_EQ(TextAt(phrase, "/printed"), text);
  EXPECT_EQ(TextAt(phrase, "/pattern"),
            "view {{v1}}: {{v2}} of {{v3}} corners ({{v4}} %), see {{v5}}.");
  EXPECT_EQ(TextAt(phrase, "/values/v1"), "B2");
  EXPECT_EQ(TextAt(phrase, "/values/v5"), "pipe/pipe_000.png");
  EXPECT_EQ(PhraseOfText("No drift is resolved."), Json("No drift is resolved."));
}

TEST(Phrase, ALensModelIsSaidByItsParts) {
  const std::string text = "aspect k1 p1 p2 telecentricity, bow of the boards, a lens per view";
  const Json model = ModelPhrase(text);
  EXPECT_EQ(TextAt(model, "/printed"), text);
  EXPECT_EQ(TextAt(model, "/values/v1/pattern"), "{{lens}} telecentricity");
  EXPECT_EQ(TextAt(model, "/values/v1/values/lens/values/lens"), "k1 p1 p2");
  EXPECT_EQ(TextAt(model, "/values/v2/values/v2"), "a lens per view");
  EXPECT_EQ(ModelPhrase("k1"), Json("k1"));
}

TEST(Phrase, JoinedPhrasesKeepTheirPatterns) {
  EXPECT_EQ(JoinPhrases({"", ""}), Json(""));
  EXPECT_EQ(JoinPhrases({"", "alone"}), Json("alone"));
  const Json both = JoinPhrases({"One.", Phrase("{{n}} more.", {{"n", "2"}})});
  EXPECT_EQ(TextAt(both, "/printed"), "One. 2 more.");
  EXPECT_EQ(TextAt(both, "/values/v2/pattern"), "{{n}} more.");
}

}  // namespace
}  // namespace telestrain
