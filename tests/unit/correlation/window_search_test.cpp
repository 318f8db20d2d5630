#include "correlation/window_search.h"

#include <gtest/gtest.h>

#include "tests/unit/correlation/speckle.h"

namespace telestrain::correlation {
namespace {

double DirectZncc(const GrayImage& block, const GrayImage& image, int left, int top) {
  double f = 0, t = 0, ff = 0, tt = 0, ft = 0;
  for (int y = 0; y < block.height; ++y)
    for (int x = 0; x < block.width; ++x) {
      const double a = block.At(x, y), b = image.At(left + x, top + y);
      f += a;
      t += b;
      ff += a * a;
      tt += b * b;
      ft += a * b;
    }
  const double n = block.width * block.height;
  return (ft - f * t / n) / std::sqrt((ff - f * f / n) * (tt - t * t / n));
}

// The transform's rounding, 1e-7 of the window's energy, against that of a block: 1e-5 at most.
TEST(WindowSearch, IsTheCorrelationOfTheDefinition) {
  const GrayImage image = Speckle(3, 131, 97).Render(131, 97);
  const GrayImage one = TurnedBlock(image, {40, 50}, 20, 0),
                  two = TurnedBlock(image, {90, 33}, 20, 0.3);
  const GrayImage three = TurnedBlock(image, {70, 60}, 20, -0.2);
  const auto found = WindowSearch(image).Correlate({one, two, three});
  ASSERT_EQ(found.size(), 3u);
  const std::vector<GrayImage> blocks = {one, two, three};
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_EQ(found[k].width, 112);
    ASSERT_EQ(found[k].height, 78);
    for (int y = 0; y < found[k].height; y += 7)
      for (int x = 0; x < found[k].width; x += 5)
        EXPECT_NEAR(found[k].At(x, y), DirectZncc(blocks[k], image, x, y), 1e-5);
  }
}

TEST(WindowSearch, FlatPlacesNeverWin) {
  GrayImage image = Speckle(4, 120, 120).Render(120, 120);
  const GrayImage block = TurnedBlock(image, {29.5, 29.5}, 20, 0);
  for (int y = 60; y < 120; ++y)
    for (int x = 0; x < 120; ++x) image.At(x, y) = 10 + 1e-3f * static_cast<float>(x % 7);
  const GrayImage found = WindowSearch(image).Correlate({block}).front();
  const CorrelationPeak peak = FindPeak(found, 2);
  EXPECT_EQ(peak.at, Eigen::Vector2i(20, 20));
  EXPECT_NEAR(peak.zncc, 1, 1e-5);
  EXPECT_EQ(found.At(40, 80), 0);
}

TEST(WindowSearch, ATurnedBlockIsFoundInATurnedImage) {
  const int side = 160;
  const Speckle speckle(5, side, side, 2.5);
  const Eigen::Vector2d about(80, 80);
  ShapeFunction turn;
  const double angle = 0.15;
  turn.gradient << std::cos(angle) - 1, -std::sin(angle), std::sin(angle), std::cos(angle) - 1;
  const GrayImage before = speckle.Render(side, side),
                  after = speckle.Render(side, side, turn, about);
  const WindowSearch window(after);
  const auto found =
      window.Correlate({TurnedBlock(before, about, 41, angle), TurnedBlock(before, about, 41, 0)});
  const CorrelationPeak turned = FindPeak(found[0], 2), straight = FindPeak(found[1], 2);
  EXPECT_EQ(turned.at, Eigen::Vector2i(60, 60));
  EXPECT_GT(turned.zncc, 0.98);  // linear interpolation of speckles of 8 px
  EXPECT_LT(straight.zncc, turned.zncc);
}

}  // namespace
}  // namespace telestrain::correlation
