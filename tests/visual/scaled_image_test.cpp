#include "viz/scaled_image.h"

#include <gtest/gtest.h>

namespace telestrain::viz {
namespace {

TEST(Reduced, IsTheMeanOfTheAreaUnderEachPixel) {
  const RgbImage four{4, 1, 300, {0, 0, 0, 100, 0, 0, 200, 0, 0, 100, 0, 0}, {}};
  EXPECT_EQ(Reduced(four, 2, 1).rgb, (std::vector<std::uint8_t>{50, 0, 0, 150, 0, 0}));
  // Three pixels of four thirds each: (0 + 100/3) / (4/3) = 25, (200/3 + 400/3) / (4/3) = 150, …
  EXPECT_EQ(Reduced(four, 3, 1).rgb, (std::vector<std::uint8_t>{25, 0, 0, 150, 0, 0, 125, 0, 0}));
  const RgbImage tall{1, 2, 300, {10, 20, 30, 30, 40, 50}, {}};
  EXPECT_EQ(Reduced(tall, 1, 1).rgb, (std::vector<std::uint8_t>{20, 30, 40}));
}

TEST(Reduced, PutsTransparentPicturesOnWhite) {
  const RgbImage image{2, 1, 300, {0, 0, 0, 0, 0, 0}, {0, 255}};
  EXPECT_EQ(Reduced(image, 2, 1).rgb, (std::vector<std::uint8_t>{255, 255, 255, 0, 0, 0}));
}

TEST(Reduced, KeepsAPictureOfTheSameSize) {
  const RgbImage image{2, 1, 300, {1, 2, 3, 4, 5, 6}, {}};
  EXPECT_EQ(Reduced(image, 2, 1).rgb, image.rgb);
}

}  // namespace
}  // namespace telestrain::viz
