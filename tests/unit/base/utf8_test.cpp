#include "base/utf8.h"

#include <gtest/gtest.h>

#include <string>

namespace telestrain {
namespace {

// RFC 3629, section 3, bit by bit: the opposite direction of what the check does.
std::string Encoded(unsigned code_point) {
  const auto tail = [code_point](int shift) {
    return static_cast<char>(0x80 | ((code_point >> shift) & 0x3F));
  };
  if (code_point < 0x80) return {static_cast<char>(code_point)};
  if (code_point < 0x800) return {static_cast<char>(0xC0 | (code_point >> 6)), tail(0)};
  if (code_point < 0x10000) return {static_cast<char>(0xE0 | (code_point >> 12)), tail(6), tail(0)};
  return {static_cast<char>(0xF0 | (code_point >> 18)), tail(12), tail(6), tail(0)};
}

TEST(Utf8Test, EveryCodePointIsValidButSurrogatesAndWhatIsAboveTheLast) {
  for (unsigned code_point = 0; code_point <= 0x13FFFF; ++code_point) {
    const bool wanted = code_point <= 0x10FFFF && (code_point < 0xD800 || code_point > 0xDFFF);
    ASSERT_EQ(IsValidUtf8("a" + Encoded(code_point) + "b"), wanted) << std::hex << code_point;
  }
}

TEST(Utf8Test, CutSequencesAreInvalid) {
  for (const unsigned code_point : {0xE4u, 0x20ACu, 0x1F600u}) {
    const std::string whole = Encoded(code_point);
    for (std::size_t length = 1; length < whole.size(); ++length) {
      EXPECT_FALSE(IsValidUtf8(whole.substr(0, length)));
      EXPECT_FALSE(IsValidUtf8(whole.substr(0, length) + "abc"));
      EXPECT_FALSE(IsValidUtf8(whole.substr(length)));
    }
  }
}

TEST(Utf8Test, OverlongFormsAndOtherEncodingsAreInvalid) {
  for (const char* text : {"\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xF0\x8F\xBF\xBF", "\xF5\x80",
                           "\xF8\x88\x80\x80\x80", "\xFF\xFE", "R\xF6hre", "\xB5m"})
    EXPECT_FALSE(IsValidUtf8(text)) << text;
}

TEST(Utf8Test, WhatWouldMoveTheTextIsPrintedAsItsBytes) {
  EXPECT_EQ(PrintableText("Zhang Wei, 张伟, \u00e9, \U0001F600"),
            "Zhang Wei, 张伟, \u00e9, \U0001F600");
  EXPECT_EQ(PrintableText(std::string("a\0b\x1b[2J\r\nPASS\x7f", 14)),
            "a\\x00b\\x1b[2J\\x0d\\x0aPASS\\x7f");
  EXPECT_EQ(PrintableText("\u009b1m \u202e \u2028 \u2069"),
            "\\xc2\\x9b1m \\xe2\\x80\\xae \\xe2\\x80\\xa8 \\xe2\\x81\\xa9");
  EXPECT_EQ(PrintableText("R\xF6hre \xE4\xBC"), "R\\xf6hre \\xe4\\xbc");
}

TEST(Utf8Test, EmptyTextAndZeroBytesAreValid) {
  EXPECT_TRUE(IsValidUtf8(""));
  EXPECT_TRUE(IsValidUtf8(std::string("a\0b", 3)));
}

TEST(Utf8Test, FirstCharactersAreWhole) {
  const std::string text =
      "a" + Encoded(0xE4) + Encoded(0x20AC) + Encoded(0x1F600);  // 1+2+3+4 bytes
  const std::size_t ends[] = {0, 1, 1, 3, 3, 3, 6, 6, 6, 6, 10, 10};
  for (std::size_t most_bytes = 0; most_bytes < std::size(ends); ++most_bytes)
    EXPECT_EQ(FirstCharacters(text, most_bytes), text.substr(0, ends[most_bytes])) << most_bytes;
}

}  // namespace
}  // namespace telestrain
