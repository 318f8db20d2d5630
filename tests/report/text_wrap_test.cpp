#include "report/text_wrap.h"

#include <gtest/gtest.h>

#include "report/unicode_text.h"

namespace telestrain {
namespace {

class TextWrap : public ::testing::Test {
 protected:
  void SetUp() override {
    auto created = PdfDocument::Create();
    ASSERT_TRUE(created) << created.error().message;
    pdf_ = std::move(created).value();
  }
  std::unique_ptr<PdfDocument> pdf_;
  TextStyle style_{Face::kRegular, 9, {}};
};

std::string Joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line;
  return all;
}

TEST_F(TextWrap, NoLineIsWiderThanAsked) {
  const std::string text =
      "Environment: (23.1 ± 0.2) °C, 44 % RH; calibration/a_very_long_folder_name/image_000123.png "
      "张伟张伟张伟张伟张伟张伟张伟张伟张伟张伟 and µε words";
  for (const double width_pt : {30.0, 55.0, 90.0, 200.0})
    for (const std::string& line : WrapText(*pdf_, style_, text, width_pt))
      EXPECT_LE(pdf_->TextWidth_pt(style_, line.substr(0, line.find_last_not_of(' ') + 1)),
                width_pt + 0.02)
          << line;
}

TEST_F(TextWrap, LosesNothing) {
  const std::string text = "one two three four five six seven eight nine ten";
  EXPECT_EQ(Joined(WrapText(*pdf_, style_, text, 60)), text);
  const std::string word(200, 'x');
  EXPECT_EQ(Joined(WrapText(*pdf_, style_, word, 60)), word);
}

// Whatever the width: no closing punctuation begins a line, no opening one ends it.
TEST_F(TextWrap, ChinesePunctuationStaysWhereItBelongs) {
  const std::string text =
      "应变（轴向，相对参考状态）的测量：“张伟”读出《规程》第3条；误差≤20 µε。温度23 °C、湿度44 "
      "%！";
  for (double width_pt = 40; width_pt < 200; width_pt += 7) {
    const std::vector<std::string> lines = WrapText(*pdf_, style_, text, width_pt);
    EXPECT_EQ(Joined(lines), text);
    for (const std::string& line : lines) {
      const std::vector<char32_t> points = CodePoints(line);
      EXPECT_EQ(std::u32string(U"）：，”》；。、！").find(points.front()), std::u32string::npos)
          << line;
      EXPECT_EQ(std::u32string(U"（“《").find(points.back()), std::u32string::npos) << line;
    }
  }
}

TEST_F(TextWrap, BreaksALongPathBehindItsSlashes) {
  const auto lines = WrapText(*pdf_, style_, "calibration/position/image.png", 60);
  ASSERT_GE(lines.size(), 2u);
  EXPECT_EQ(lines.front().back(), '/');
}

TEST_F(TextWrap, KeepsLineFeedsAndOneLineForNothing) {
  EXPECT_EQ(WrapText(*pdf_, style_, "a\nb", 100).size(), 2u);
  EXPECT_EQ(WrapText(*pdf_, style_, "", 100).size(), 1u);
}

TEST_F(TextWrap, EvenAWidthOfNothingEnds) {
  EXPECT_EQ(WrapText(*pdf_, style_, "abc", 0).size(), 3u);
}

}  // namespace
}  // namespace telestrain
