#include <gtest/gtest.h>

#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

// Shifts at random, not whole, with some strain, noise and a darker image.
void ExpectFound(const PixelRegion& region, int max_shift_px, double spot_px, unsigned seed) {
  const int width = region.x + region.width + 10, height = region.y + region.height + 10;
  const Speckle speckle(seed, width, height, spot_px);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-max_shift_px, max_shift_px);
  GrayImage before = speckle.Render(width, height);
  AddNoise(2, random, before);
  ShapeFunction map;
  map.displacement_px = {shift(random), shift(random)};
  map.gradient << 1e-3, 2e-4, -3e-4, -3e-4;
  GrayImage after = speckle.Render(width, height, map, region.Middle());
  for (float& value : after.pixels) value = 0.7f * value + 10;
  AddNoise(2, random, after);
  const ShiftSearch found = SearchShift(before, after, region, max_shift_px);
  EXPECT_GT(found.zncc, 0.7) << seed;
  // Half a pixel of rounding, a pixel of strain over the region.
  EXPECT_LT((found.shift_px - map.displacement_px).cwiseAbs().maxCoeff(), 1.5) << seed;
}

TEST(SearchShift, FindsShiftsOfTheFullView) {
  ExpectFound({0, 0, 1296, 972}, 60, 1.6, 11);
  ExpectFound({8, 4, 1296, 972}, 60, 3.0, 12);
}

TEST(SearchShift, FindsShiftsOfASmallView) {
  for (unsigned seed = 20; seed < 32; ++seed) ExpectFound({10, 6, 324, 243}, 15, 1.6, seed);
}

TEST(SearchShift, SaysWhenThereIsNothingToFind) {
  const GrayImage flat{324, 243, 255, std::vector<float>(324 * 243, 90.f)};
  EXPECT_EQ(SearchShift(flat, flat, {0, 0, 324, 243}, 15).zncc, 0);
  const GrayImage one = Speckle(1, 324, 243).Render(324, 243);
  const GrayImage two = Speckle(2, 324, 243).Render(324, 243);
  EXPECT_LT(SearchShift(one, two, {0, 0, 324, 243}, 15).zncc, 0.3);
}

}  // namespace
}  // namespace telestrain
