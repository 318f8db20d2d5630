#include "viz/review/html_text.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace telestrain::viz {
namespace {

TEST(HtmlText, HasNoMarkupLeft) {
  EXPECT_EQ(HtmlText("<b a=\"1\" c='2'>&</b>"),
            "&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;&lt;/b&gt;");
  EXPECT_EQ(HtmlText("20 \u00b0C \u00b5\u03b5"), "20 \u00b0C \u00b5\u03b5");
}

TEST(ScriptText, CannotEndOrCommentOutItsElement) {
  EXPECT_EQ(ScriptText("a='</script>'; b='<!--';"), "a='<\\/script>'; b='<\\!--';");
  EXPECT_EQ(ScriptText("a<b"), "a<b");
}

TEST(JsonInScript, HasNoAngleBracket) {
  EXPECT_EQ(JsonInScript(R"(["</script>"])"), R"(["\u003c/script>"])");
}

// The vectors of RFC 4648, section 10.
TEST(Base64, IsThatOfTheStandard) {
  for (const auto& [bytes, text] : {std::pair{"", ""},
                                    {"f", "Zg=="},
                                    {"fo", "Zm8="},
                                    {"foo", "Zm9v"},
                                    {"foob", "Zm9vYg=="},
                                    {"fooba", "Zm9vYmE="},
                                    {"foobar", "Zm9vYmFy"}})
    EXPECT_EQ(Base64(bytes), text);
  EXPECT_EQ(Base64("\xff\xef\xfe"), "/+/+");
}

// The SHA-256 of "abc" in FIPS 180-4's example, as Base64.
TEST(PolicyHash, IsTheHashOfTheScript) {
  EXPECT_EQ(PolicyHash("abc"), "'sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0='");
}

TEST(Filled, PutsTextsInOnce) {
  EXPECT_EQ(Filled("<{{a}}|{{b}}>", {{"a", "{{b}}"}, {"b", "2"}}), "<{{b}}|2>");
  EXPECT_THROW(Filled("{{c}}", {{"a", ""}}), std::logic_error);
  EXPECT_THROW(Filled("{{a", {{"a", ""}}), std::logic_error);
}

}  // namespace
}  // namespace telestrain::viz
