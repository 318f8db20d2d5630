#include "base/numbers.h"

#include <gtest/gtest.h>

#include <bit>
#include <cfloat>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace telestrain {
namespace {

TEST(FormatShortestTest, EveryDoubleReadsBackToItself) {
  std::mt19937_64 bits(1);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(bits());
    if (!std::isfinite(value) || std::fpclassify(value) == FP_SUBNORMAL) continue;
    const auto again = ParseDouble(FormatShortest(value));
    ASSERT_TRUE(again.has_value()) << FormatShortest(value);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(*again), std::bit_cast<std::uint64_t>(value));
  }
}

TEST(FormatShortestTest, IsShort) {
  EXPECT_EQ(FormatShortest(0.1), "0.1");
  EXPECT_EQ(FormatShortest(-27.6), "-27.6");
  EXPECT_EQ(FormatShortest(1e-7), "1e-07");
  EXPECT_EQ(FormatShortest(3), "3");
}

TEST(FormatFixedTest, RoundsAndHasNoNegativeZero) {
  EXPECT_EQ(FormatFixed(2.345, 1), "2.3");
  EXPECT_EQ(FormatFixed(-0.004, 2), "0.00");
  EXPECT_EQ(FormatFixed(-0.0, 0), "0");
  EXPECT_EQ(FormatFixed(-0.006, 2), "-0.01");
  EXPECT_EQ(FormatFixed(999.96, 1), "1000.0");
  EXPECT_EQ(FormatFixed(-DBL_MAX, 2).size(), 313u);  // sign, 309 digits, point, 2 digits
}

TEST(ParseDoubleTest, TakesTheWholeTextOrNothing) {
  EXPECT_EQ(ParseDouble("+1.5e3"), 1500.0);
  EXPECT_EQ(ParseDouble("-.5"), -0.5);
  EXPECT_EQ(ParseDouble("007"), 7.0);
  for (const char* text : {"", " 1", "1 ", "1,5", "1.5mm", "nan", "inf", "-inf", "1e400", "0x10",
                           "++1", "+-1", "-", "."})
    EXPECT_FALSE(ParseDouble(text).has_value()) << "'" << text << "'";
}

TEST(ParseDoubleTest, DoesNotDependOnTheLocale) {
  const char* comma_locale = std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(ParseDouble("1.5"), 1.5) << (comma_locale ? "with" : "without") << " a comma locale";
  EXPECT_EQ(FormatFixed(1.5, 1), "1.5");
  std::setlocale(LC_ALL, "C");
}

TEST(ParseIntTest, TakesTheWholeTextOrNothing) {
  EXPECT_EQ(ParseInt("-17"), -17);
  for (const char* text : {"", "1.0", "1e3", "2147483648", "7x", " 7"})
    EXPECT_FALSE(ParseInt(text).has_value()) << "'" << text << "'";
}

TEST(EditDistanceTest, IsAMetric) {
  const std::vector<std::string> words{"", "row", "rows", "columns", "colums", "square_mm"};
  for (const auto& a : words) {
    EXPECT_EQ(EditDistance(a, a), 0);
    for (const auto& b : words) {
      EXPECT_EQ(EditDistance(a, b), EditDistance(b, a));
      for (const auto& c : words)
        EXPECT_LE(EditDistance(a, c), EditDistance(a, b) + EditDistance(b, c));
    }
  }
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
  EXPECT_EQ(EditDistance("", "abc"), 3);
}

TEST(NearestWordTest, FindsTheTypingError) {
  const std::vector<std::string> known{"columns", "rows", "square_mm"};
  EXPECT_EQ(NearestWord("colums", known), "columns");
  EXPECT_EQ(NearestWord("square_um", known), "square_mm");
  EXPECT_EQ(NearestWord("x", std::vector<std::string>{}), "");
}

}  // namespace
}  // namespace telestrain
