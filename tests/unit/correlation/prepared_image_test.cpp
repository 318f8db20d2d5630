#include <gtest/gtest.h>

#include "correlation/image_filters.h"
#include "correlation/quintic_spline.h"
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

TEST(QuinticSpline, WeightsSumToOneAndKeepTheirMeanPlace) {
  for (float fraction : {0.f, 0.1f, 0.5f, 0.9f, 0.999f}) {
    float weight[6];
    correlation::QuinticWeights(fraction, weight);
    float sum = 0, place = 0;
    for (int k = 0; k < 6; ++k) {
      sum += weight[k];
      place += static_cast<float>(k - 2) * weight[k];
    }
    EXPECT_NEAR(sum, 1, 1e-6);
    EXPECT_NEAR(place, fraction, 1e-6);
  }
  float weight[6];
  correlation::QuinticWeights(0.f, weight);
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(weight[k], (std::array{1.f, 26.f, 66.f, 26.f, 1.f, 0.f}[k]) / 120, 1e-7);
}

TEST(ImageFilters, MirrorAboutTheOutermostPixels) {
  EXPECT_EQ(correlation::MirroredIndex(-1, 5), 1);
  EXPECT_EQ(correlation::MirroredIndex(5, 5), 3);
  EXPECT_EQ(correlation::MirroredIndex(8, 5), 0);
  EXPECT_EQ(correlation::MirroredIndex(-24, 8), 4);
}

}  // namespace
}  // namespace telestrain
