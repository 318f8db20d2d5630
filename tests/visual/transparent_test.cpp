#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "visual/results_fixture.h"
#include "viz/matte.h"
#include "viz/pictures.h"
#include "viz/scene_from_results.h"

namespace telestrain::viz {
namespace {

RgbImage OnPixel(std::array<std::uint8_t, 3> rgb) {
  return {1, 1, 300, {rgb[0], rgb[1], rgb[2]}, {}};
}

TEST(Matte, GivesPaperInkAndWhatIsBetween) {
  const RgbImage paper = Matte(OnPixel({255, 255, 255}), OnPixel({0, 0, 0}));
  EXPECT_EQ(paper.alpha, std::vector<std::uint8_t>{0});
  const RgbImage ink = Matte(OnPixel({10, 200, 30}), OnPixel({10, 200, 30}));
  EXPECT_EQ(ink.alpha, std::vector<std::uint8_t>{255});
  EXPECT_EQ(ink.rgb, (std::vector<std::uint8_t>{10, 200, 30}));
  // 40 % of (200, 100, 0): 102 of alpha; on white 0.6 * 255 more than on black.
  const RgbImage glass = Matte(OnPixel({233, 193, 153}), OnPixel({80, 40, 0}));
  EXPECT_EQ(glass.alpha, std::vector<std::uint8_t>{102});
  EXPECT_EQ(glass.rgb, (std::vector<std::uint8_t>{200, 100, 0}));
}

struct Pair {
  Picture opaque, transparent;
};

// The array: translucent volumes and boards behind one another, smoothed edges, lines and texts.
const Pair& Pictures() {
  static const Pair pair = [] {
    const auto folder = visual_test::FreshFolder("Transparent");
    visual_test::WriteResults(folder);
    const auto scene = SceneFromResults(folder);
    RenderOptions options{1200, 740};
    const auto opaque = DrawArray(*scene, options);
    options.transparent = true;
    return Pair{*opaque, *DrawArray(*scene, options)};
  }();
  return pair;
}

TEST(Transparent, OnWhitePaperIsTheOpaquePicture) {
  const auto& [opaque, transparent] = Pictures();
  const RgbImage& image = transparent.image;
  ASSERT_EQ(image.rgb.size(), opaque.image.rgb.size());
  ASSERT_EQ(3 * image.alpha.size(), image.rgb.size());
  EXPECT_TRUE(opaque.image.alpha.empty());
  int largest = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const double mixed = 255 + (image.rgb[i] - 255.0) * image.alpha[i / 3] / 255;
    largest =
        std::max(largest, static_cast<int>(std::lround(std::abs(mixed - opaque.image.rgb[i]))));
  }
  // Colour and alpha are bytes: each rounds by half a level at the most, and so does their mix.
  EXPECT_LE(largest, 1);
}

// Whether the picture is white at a pixel and at all its neighbours.
bool IsBlankAround(const RgbImage& image, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(image.width_px);
  const std::size_t x = pixel % width, y = pixel / width;
  const auto height = static_cast<std::size_t>(image.height_px);
  for (std::size_t row = y - std::min<std::size_t>(y, 1); row <= std::min(y + 1, height - 1); ++row)
    for (std::size_t column = x - std::min<std::size_t>(x, 1); column <= std::min(x + 1, width - 1);
         ++column)
      for (std::size_t c = 0; c < 3; ++c)
        if (image.rgb[3 * (row * width + column) + c] != 255) return false;
  return true;
}

TEST(Transparent, HasPaperGlassAndInk) {
  const auto& [opaque, transparent] = Pictures();
  std::size_t paper = 0, glass = 0, ink = 0, stained = 0;
  for (std::size_t i = 0; i < transparent.image.alpha.size(); ++i) {
    const std::uint8_t alpha = transparent.image.alpha[i];
    // Smoothing blends an edge with the pixel beside it, and light edges more on dark paper.
    stained += alpha != 0 && IsBlankAround(opaque.image, i);
    paper += alpha == 0;
    glass += alpha > 0 && alpha < 255;
    ink += alpha == 255;
  }
  const std::size_t all = transparent.image.alpha.size();
  EXPECT_EQ(stained, 0u);
  EXPECT_GT(paper, all / 3);   // the picture has wide margins
  EXPECT_GT(glass, all / 50);  // four view volumes and two dozen boards
  EXPECT_GT(ink, all / 1000);  // lines and letters
}

}  // namespace
}  // namespace telestrain::viz
