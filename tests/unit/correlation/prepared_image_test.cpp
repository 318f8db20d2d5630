#include <gtest/gtest.h>

#include "correlation/image_filters.h"
#include "correlation/spline.h"
#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kSide = 80;
const CorrelationOptions kRaw{.prefilter_sigma_px = 0};

TEST(PreparedImage, InterpolatesThePixelsAndTheFormulaBetween) {
  const Speckle speckle(1, kSide, kSide, 2.0);
  const GrayImage image = speckle.Render(kSide, kSide);
  const PreparedImage prepared(image, {10, 5, 60, 70}, kRaw);
  for (int k = 0; k < 200; ++k) {
    const int x = 14 + (k * 7) % 50, y = 9 + (k * 11) % 60;
    EXPECT_NEAR(prepared.Sample(x, y), image.At(x, y), 2e-3);
    if (x < 20 || y < 15 || x > 60 || y > 65) continue;  // the mirrored border reaches in
    const Eigen::Vector2d between(x + 0.37, y + 0.61);
    EXPECT_NEAR(prepared.Sample(between.x(), between.y()), speckle.At(between), 0.1);
  }
}

TEST(PreparedImage, KeepsAConstantUpToTheBorder) {
  GrayImage image{20, 16, 255, std::vector<float>(320, 77.f)};
  const PreparedImage prepared(image, {0, 0, 20, 16}, {});
  for (double x : {3.0, 7.3, 16.0})
    for (double y : {3.0, 8.8, 12.0}) EXPECT_NEAR(prepared.Sample(x, y), 77, 1e-3);
}

TEST(PreparedImage, RefusesPositionsOutside) {
  GrayImage image{20, 16, 255, std::vector<float>(320, 77.f)};
  const PreparedImage prepared(image, {0, 0, 20, 16}, {});
  EXPECT_THROW(prepared.Sample(2.9, 8), std::logic_error);
  EXPECT_THROW(prepared.Sample(8, 12.1), std::logic_error);
  EXPECT_THROW(prepared.Sample(std::nan(""), 8), std::logic_error);
}

TEST(PreparedImage, RefusesARegionBeyondTheImage) {
  GrayImage image{20, 16, 255, std::vector<float>(320, 77.f)};
  EXPECT_THROW(PreparedImage(image, {4, 0, 20, 16}, {}), std::logic_error);
  EXPECT_THROW(PreparedImage(image, {-1, 0, 10, 10}, {}), std::logic_error);
}

// A Gaussian spot blurred by a Gaussian is a Gaussian: widths add in squares.
TEST(PreparedImage, BlursByTheGivenSigma) {
  GrayImage image{41, 41, 255, std::vector<float>(41 * 41)};
  for (int y = 0; y < 41; ++y)
    for (int x = 0; x < 41; ++x)
      image.At(x, y) = static_cast<float>(
          100 * std::exp(-0.5 * ((x - 20) * (x - 20) + (y - 20) * (y - 20)) / 4.0));
  const PreparedImage prepared(image, {0, 0, 41, 41}, {.prefilter_sigma_px = 0.7});
  EXPECT_NEAR(prepared.Sample(20, 20), 100 * 4.0 / (4.0 + 0.49), 0.05);
}

template <int kDegree>
void ExpectWeightsOfTheMeanPlace() {
  const auto fma = [](float a, float b, float c) { return a * b + c; };
  const auto spread = [](float value) { return value; };
  float weight[kDegree + 1];
  for (float fraction : {0.f, 0.1f, 0.5f, 0.9f, 0.999f}) {
    correlation::SplineWeights<kDegree>(fraction, fma, spread, weight);
    float sum = 0, place = 0;
    for (int k = 0; k <= kDegree; ++k) {
      sum += weight[k];
      place += static_cast<float>(k - kDegree / 2) * weight[k];
    }
    EXPECT_NEAR(sum, 1, 1e-6);
    EXPECT_NEAR(place, fraction, 1e-6);
  }
  correlation::SplineWeights<kDegree>(0.f, fma, spread, weight);
  const std::vector<float> at_nodes =
      kDegree == 3
          ? std::vector<float>{1.f / 6, 4.f / 6, 1.f / 6, 0}
          : std::vector<float>{1.f / 120, 26.f / 120, 66.f / 120, 26.f / 120, 1.f / 120, 0};
  for (int k = 0; k <= kDegree; ++k) EXPECT_NEAR(weight[k], at_nodes[k], 1e-7);
}

TEST(Spline, WeightsSumToOneAndKeepTheirMeanPlace) {
  ExpectWeightsOfTheMeanPlace<3>();
  ExpectWeightsOfTheMeanPlace<5>();
}

// Filters of finite length: a part that is prepared with 23 px more on every side is the whole.
TEST(PreparedImage, APartHasTheBitsOfTheWhole) {
  constexpr int kWidth = 300, kHeight = 120, kMargin = 23;
  const GrayImage image = Speckle(5, kWidth, kHeight).Render(kWidth, kHeight);
  for (const Interpolation interpolation : {Interpolation::kCubic, Interpolation::kQuintic}) {
    const CorrelationOptions options{.interpolation = interpolation};
    const PreparedImage whole(image, {0, 0, kWidth, kHeight}, options);
    const PreparedImage part(image, {107, 11, 90, 80}, options);
    for (int y = 11 + kMargin; y < 11 + 80 - kMargin; ++y)
      for (int x = 107 + kMargin; x < 107 + 90 - kMargin; ++x)
        ASSERT_EQ(whole.Sample(x + 0.25, y + 0.75), part.Sample(x + 0.25, y + 0.75));
  }
}

TEST(PreparedImage, HoldsLittleMoreThanAFloatAPixel) {
  constexpr int kWidth = 1000, kHeight = 900;
  const GrayImage image{kWidth, kHeight, 255, std::vector<float>(kWidth * kHeight, 255.f)};
  const PreparedImage prepared(image, {0, 0, kWidth, kHeight}, {});
  EXPECT_LT(static_cast<double>(prepared.bytes()) / (kWidth * kHeight), 4.8);
}

TEST(ImageFilters, MirrorAboutTheOutermostPixels) {
  EXPECT_EQ(correlation::MirroredIndex(-1, 5), 1);
  EXPECT_EQ(correlation::MirroredIndex(5, 5), 3);
  EXPECT_EQ(correlation::MirroredIndex(8, 5), 0);
  EXPECT_EQ(correlation::MirroredIndex(-24, 8), 4);
}

}  // namespace
}  // namespace telestrain
