#include "base/result.h"

#include <gtest/gtest.h>

#include <memory>

#include "base/gray_image.h"

namespace telestrain {
namespace {

Result<int> Half(int number) {
  if (number % 2 != 0) return BadInput(std::to_string(number) + " is odd");
  return number / 2;
}

Result<int> Quarter(int number) {
  TELESTRAIN_ASSIGN_OR_RETURN(const int half, Half(number));
  return Half(half);
}

Status CheckEven(int number) {
  TELESTRAIN_RETURN_IF_ERROR(Half(number));
  return {};
}

TEST(ResultTest, HoldsAValueOrAnError) {
  EXPECT_TRUE(Half(4).ok());
  EXPECT_EQ(*Half(4), 2);
  EXPECT_FALSE(Half(3).ok());
  EXPECT_EQ(Half(3).error().message, "3 is odd");
  EXPECT_EQ(Half(3).error().kind, ErrorKind::kBadInput);
}

TEST(ResultTest, MacrosPassTheErrorOn) {
  EXPECT_EQ(*Quarter(8), 2);
  EXPECT_EQ(Quarter(6).error().message, "3 is odd");
  EXPECT_TRUE(CheckEven(2).ok());
  EXPECT_EQ(CheckEven(1).error().message, "1 is odd");
}

TEST(ResultTest, WrongAccessIsABrokenContract) {
  EXPECT_THROW(Half(3).value(), std::logic_error);
  EXPECT_THROW(Half(4).error(), std::logic_error);
  EXPECT_THROW(Status().error(), std::logic_error);
}

TEST(ResultTest, BrokenContractNamesPlaceAndCondition) {
  try {
    TELESTRAIN_CHECK(1 == 2, "numbers differ");
    FAIL() << "no exception";
  } catch (const std::logic_error& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("result_test.cpp:"), std::string::npos) << text;
    EXPECT_NE(text.find("1 == 2: numbers differ"), std::string::npos) << text;
  }
}

TEST(ResultTest, CarriesWhatCanOnlyBeMoved) {
  Result<std::unique_ptr<int>> result(std::make_unique<int>(7));
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 7);
}

TEST(ResultTest, KindsAreTheExitCodes) {
  EXPECT_EQ(static_cast<int>(BadInput("").kind), 3);
  EXPECT_EQ(static_cast<int>(EstimationFailed("").kind), 4);
  EXPECT_EQ(static_cast<int>(OutputFailed("").kind), 5);
}

TEST(GrayImageTest, RunsRowByRow) {
  GrayImage image{3, 2, 255, {0, 1, 2, 3, 4, 5}};
  EXPECT_EQ(image.At(2, 0), 2);
  EXPECT_EQ(image.At(0, 1), 3);
  image.At(1, 1) = 9;
  EXPECT_EQ(image.pixels[4], 9);
}

}  // namespace
}  // namespace telestrain
