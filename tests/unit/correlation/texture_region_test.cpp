#include "correlation/texture_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kSide = 420, kSubset_px = 33;

// Signed distance into a disk about the middle without a hole in it.
double Inside(int x, int y) {
  const double disk = 170 - std::hypot(x - 210, y - 210);
  const double hole = std::hypot(x - 250, y - 200) - 45;
  return std::min(disk, hole);
}

GrayImage Scene(double background, double hole_gray, double sigma_gray) {
  GrayImage image = Speckle(81, kSide, kSide).Render(kSide, kSide);
  std::mt19937 random(8);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      if (Inside(x, y) < 0)
        image.At(x, y) =
            static_cast<float>(std::hypot(x - 250, y - 200) < 45 ? hole_gray : background);
  AddNoise(sigma_gray, random, image);
  for (float& value : image.pixels) value = std::clamp(value, 0.f, 255.f);
  return image;
}

// The border is known to a quarter of the subset (the window) and an eighth (the cell); two cells
// more for the grain of the pattern.
TEST(TextureRegion, EndsWhereThePatternEnds) {
  constexpr double kKnown_px = 0.25 * kSubset_px + 0.125 * kSubset_px + 0.25 * kSubset_px;
  for (const auto& [background, hole] : {std::pair(0.0, 255.0), std::pair(128.0, 0.0)})
    for (const double sigma : {0.0, 2.0}) {
      const PixelMask mask = TextureRegion(Scene(background, hole, sigma), kSubset_px);
      ASSERT_EQ(mask.width, kSide);
      ASSERT_EQ(mask.inside.size(), static_cast<std::size_t>(kSide) * kSide);
      int wrong = 0;
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          if (std::abs(Inside(x, y)) < kKnown_px) continue;
          wrong += mask.At(x, y) != (Inside(x, y) > 0);
        }
      EXPECT_EQ(wrong, 0) << background << " " << hole << " " << sigma;
    }
}

TEST(TextureRegion, IsTheWholeImageOfAPattern) {
  const GrayImage image = Speckle(82, kSide, kSide).Render(kSide, kSide);
  const PixelMask mask = TextureRegion(image, kSubset_px);
  EXPECT_EQ(std::count(mask.inside.begin(), mask.inside.end(), 0), 0);
}

TEST(TextureRegion, IsEmptyWithoutTexture) {
  GrayImage flat{kSide, kSide, 255, std::vector<float>(kSide * kSide, 100.f)};
  std::mt19937 random(9);
  AddNoise(3, random, flat);
  const PixelMask noise = TextureRegion(flat, kSubset_px);
  EXPECT_EQ(std::count(noise.inside.begin(), noise.inside.end(), 1), 0);
  for (int y = 0; y < kSide; ++y)  // stripes fix one direction only
    for (int x = 0; x < kSide; ++x)
      flat.At(x, y) = static_cast<float>(100 + 50 * std::sin(0.7 * x));
  const PixelMask stripes = TextureRegion(flat, kSubset_px);
  EXPECT_EQ(std::count(stripes.inside.begin(), stripes.inside.end(), 1), 0);
}

TEST(TextureRegion, LeavesSpecksOut) {
  GrayImage image = Scene(20, 20, 1);
  const GrayImage speckle = Speckle(83, kSide, kSide).Render(kSide, kSide);
  for (int y = 5; y < 35; ++y)
    for (int x = 5; x < 35; ++x) image.At(x, y) = speckle.At(x, y);
  EXPECT_FALSE(TextureRegion(image, kSubset_px).At(20, 20));
  EXPECT_TRUE(TextureRegion(image, kSubset_px).At(100, 210));
}

}  // namespace
}  // namespace telestrain
