#include "target/reduced_region.h"

#include <gtest/gtest.h>

namespace telestrain {
namespace {

// Levels that are a plane over the sensor: the mean over a square is the level at its middle.
TEST(ReduceRegion, APlaneKeepsItsLevelsAtTheSquaresMiddles) {
  GrayImage image;
  image.width = 23;
  image.height = 19;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.pixels.push_back(static_cast<float>(10 + 3 * x + 5 * y));
  const PixelRegion region{4, 2, 17, 14};
  for (const int n : {1, 2, 3, 4}) {
    const GrayImage reduced = ReduceRegion(image, region, n);
    ASSERT_EQ(reduced.width, 17 / n);
    ASSERT_EQ(reduced.height, 14 / n);
    for (int y = 0; y < reduced.height; ++y)
      for (int x = 0; x < reduced.width; ++x) {
        const double middle = 0.5 * (n - 1);
        const double level = 10 + 3 * (4 + n * x + middle) + 5 * (2 + n * y + middle);
        EXPECT_NEAR(static_cast<double>(reduced.At(x, y)), level, 2e-5 * level);  // float rounding
      }
  }
}

TEST(ReduceRegion, ARegionSmallerThanASquareGivesNothing) {
  GrayImage image;
  image.width = image.height = 5;
  image.pixels.assign(25, 1);
  EXPECT_TRUE(ReduceRegion(image, {1, 1, 2, 4}, 3).pixels.empty());
}

}  // namespace
}  // namespace telestrain
