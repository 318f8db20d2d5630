#include "viz/color_bar.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace telestrain::viz {
namespace {

constexpr double kLeft_px = 100, kWidth_px = 600;

// A bar from 0 to 2 with these marks, alone on its paper.
Picture DrawBar(const std::vector<ColorBarMark>& marks, double* lower_edge = nullptr) {
  auto canvas = Canvas::Create({1200, 740});
  EXPECT_TRUE(canvas.ok()) << (canvas.ok() ? "" : canvas.error().message);
  const ColorScale scale = ScaleFor({0, 2}, 0);
  const double bottom = AddColorBar(canvas->get(), ColorMap::Plasma(scale.low, scale.high), scale,
                                    "residual / px", {kLeft_px, 300, kWidth_px, 200}, marks);
  if (lower_edge != nullptr) *lower_edge = bottom;
  return *(*canvas)->Finish();
}

const PlacedText* Find(const Picture& picture, const std::string& text) {
  const auto found = std::find_if(picture.texts.begin(), picture.texts.end(),
                                  [&](const PlacedText& placed) { return placed.text == text; });
  return found == picture.texts.end() ? nullptr : &*found;
}

// Black pixels of the row `y` from below.
std::vector<int> BlackIn(const RgbImage& image, int y) {
  std::vector<int> found;
  const int row = image.height_px - 1 - y;
  for (int x = 0; x < image.width_px; ++x) {
    const std::uint8_t* rgb = &image.rgb[static_cast<std::size_t>(3 * (row * image.width_px + x))];
    if (rgb[0] < 60 && rgb[1] < 60 && rgb[2] < 60) found.push_back(x);
  }
  return found;
}

TEST(ColorBar, PointsAtALimitInsideItsRange) {
  double lower_edge = 0;
  const Picture picture = DrawBar({{0.5, "limit 0.5 px"}}, &lower_edge);
  const PlacedText* text = Find(picture, "limit 0.5 px");
  ASSERT_NE(text, nullptr);
  const double place = kLeft_px + 0.25 * kWidth_px;
  // Text boxes are whole pixels.
  EXPECT_NEAR(text->box.left + 0.5 * text->box.width, place, 1);
  // Below the text there is a triangle and nothing else that is black: wide above, narrow below,
  // its middle at the limit's place.
  const auto wide = BlackIn(picture.image, static_cast<int>(text->box.bottom) - 9);
  const auto narrow = BlackIn(picture.image, static_cast<int>(text->box.bottom) - 14);
  ASSERT_FALSE(wide.empty());
  ASSERT_FALSE(narrow.empty());
  EXPECT_GT(wide.size(), narrow.size() + 1);
  EXPECT_NEAR(0.5 * (wide.front() + wide.back()), place - 0.5, 1);
  EXPECT_NEAR(0.5 * (narrow.front() + narrow.back()), place - 0.5, 1);
  double plain_edge = 0;
  DrawBar({}, &plain_edge);
  EXPECT_LT(lower_edge, plain_edge);
}

TEST(ColorBar, SaysWhenALimitLiesBeyond) {
  const Picture picture = DrawBar({{3, "limit 3 px"}});
  EXPECT_EQ(Find(picture, "limit 3 px"), nullptr);
  EXPECT_NE(Find(picture, "limit 3 px lies beyond"), nullptr);
}

TEST(ColorBar, MarksDoNotOverlapEachOtherOrTheTicks) {
  const Picture picture =
      DrawBar({{0.50, "limit 0.5 px"}, {0.52, "limit 0.52 px"}, {2, "limit 2 px"}, {9, "far"}});
  for (std::size_t i = 0; i < picture.texts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const PixelBox &a = picture.texts[i].box, &b = picture.texts[j].box;
      EXPECT_TRUE(a.left >= b.Right() || b.left >= a.Right() || a.bottom >= b.Top() ||
                  b.bottom >= a.Top())
          << picture.texts[i].text << " over " << picture.texts[j].text;
    }
  EXPECT_LE(Find(picture, "limit 2 px")->box.Right(), kLeft_px + kWidth_px + 1);
}

TEST(ColorBar, HasTheEndsOfAChosenRange) {
  const ColorScale scale = ScaleOfRange({-13.5, 871}, {0, 100});
  EXPECT_EQ(scale.ticks.front(), -13.5);
  EXPECT_EQ(scale.ticks.back(), 871);
  EXPECT_EQ(NumberText(scale.ticks.front(), scale.decimals), "\u221213.5");
  EXPECT_FALSE(scale.clipped);
  EXPECT_TRUE(std::is_sorted(scale.ticks.begin(), scale.ticks.end()));
  EXPECT_GE(scale.ticks.size(), 4u);
  EXPECT_TRUE(ScaleOfRange({0, 50}, {0, 100}).clipped);
}

}  // namespace
}  // namespace telestrain::viz
