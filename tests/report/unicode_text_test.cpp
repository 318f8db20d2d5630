#include "report/unicode_text.h"

#include <gtest/gtest.h>

namespace telestrain {
namespace {

TEST(UnicodeText, ReadsAndWritesEveryLength) {
  const std::string text = "aµ张😀";
  const std::vector<char32_t> points = CodePoints(text);
  EXPECT_EQ(points, (std::vector<char32_t>{U'a', 0xB5, 0x5F20, 0x1F600}));
  std::string again;
  for (const char32_t point : points) again += Utf8(point);
  EXPECT_EQ(again, text);
}

TEST(UnicodeText, ReplacesWhatIsIllFormed) {
  EXPECT_EQ(CodePoints("a\xFF"
                       "b"),
            (std::vector<char32_t>{U'a', 0xFFFD, U'b'}));
  EXPECT_EQ(CodePoints("\xC0\x80").front(), char32_t{0xFFFD});                 // overlong
  EXPECT_EQ(CodePoints("\xED\xA0\x80").front(), char32_t{0xFFFD});             // a surrogate
  EXPECT_EQ(CodePoints("\xE5\xBC"), (std::vector<char32_t>{0xFFFD, 0xFFFD}));  // cut off
}

TEST(UnicodeText, NamesACodePoint) {
  EXPECT_EQ(CodePointName(0xB5), "U+00B5");
  EXPECT_EQ(CodePointName(0x1F600), "U+1F600");
}

}  // namespace
}  // namespace telestrain
