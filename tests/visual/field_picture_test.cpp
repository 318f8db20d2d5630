#include "viz/field_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace telestrain::viz {
namespace {

constexpr int kWidth = 200, kHeight = 120, kStep = 20, kColumns = 8, kRows = 4;

// One grey level: colours are those of the map, without texture.
ImageBackdrop Flat() {
  return {GrayImage{kWidth, kHeight, 255, std::vector<float>(kWidth * kHeight, 90.0F)},
          kFieldImageWidth_px, kFieldImageHeight_px};
}

// The value rises by 1 with every column; one point failed.
FieldScene Ramp() {
  FieldScene scene;
  scene.title = "ramp";
  scene.facts = {"32 points"};
  scene.value_name = "displacement / px";
  scene.columns = kColumns;
  scene.rows = kRows;
  scene.step_px = kStep;
  scene.subset_px = 31;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      scene.samples.push_back({{30.0 + kStep * column, 30.0 + kStep * row},
                               {2.0, 0.0},
                               static_cast<double>(column),
                               true,
                               false});
  FieldSample& failed = scene.samples[2 * kColumns + 3];
  failed.failed = true;
  failed.value = std::numeric_limits<double>::quiet_NaN();
  return scene;
}

std::array<int, 3> ColorAt(const Picture& picture, double x_px, double y_px) {
  const Eigen::Vector2d pixel = picture.panels.at(0).PixelOf({x_px, y_px, 0});
  const auto at = static_cast<std::size_t>(std::lround(pixel.y())) *
                      static_cast<std::size_t>(picture.image.width_px) +
                  static_cast<std::size_t>(std::lround(pixel.x()));
  const std::uint8_t* rgb = &picture.image.rgb.at(3 * at);
  return {rgb[0], rgb[1], rgb[2]};
}

void ExpectColor(const std::array<int, 3>& found, const Rgb& wanted) {
  const auto bytes = BytesOf(wanted);
  // One entry of the map's 256 is up to 3 levels of a channel, by the steepest of its ninths.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], bytes[i], 4) << i;
}

TEST(DrawField, ShowsTheValuesInTheColoursOfItsBarAndNothingWhereAPointFailed) {
  const FieldScene scene = Ramp();
  const auto picture = DrawField(Flat(), scene);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  const ColorScale scale = FieldScale(scene);
  const ColorMap colors = ColorMap::Viridis(scale.low, scale.high);
  ExpectColor(ColorAt(*picture, 70, 30), colors.At(2));
  ExpectColor(ColorAt(*picture, 155, 55), colors.At(6.25));
  // Beside the cross of the failed point (90, 70): the grey of the image.
  const auto failed = ColorAt(*picture, 93, 76);
  EXPECT_EQ(failed[0], failed[1]);
  EXPECT_EQ(failed[0], failed[2]);
  // Beyond half a step from the last point there is no value.
  const auto beyond = ColorAt(*picture, 190, 110);
  EXPECT_EQ(beyond[0], beyond[2]);
}

TEST(DrawField, ArrowsPointWhereTheDisplacementGoesWithAStatedRoundFactor) {
  FieldScene scene = Ramp();
  scene.arrows = true;
  const auto picture = DrawField(Flat(), scene);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  // Arrows of 2 px stand 20 px apart: drawn 5 times enlarged they reach half way to the next.
  const auto ink = ColorAt(*picture, 55, 50);
  EXPECT_LT(std::max({ink[0], ink[1], ink[2]}), 90);
  const auto& texts = picture->texts;
  const auto has = [&](const std::string& part) {
    return std::any_of(texts.begin(), texts.end(), [&](const PlacedText& text) {
      return text.text.find(part) != std::string::npos;
    });
  };
  EXPECT_TRUE(has("5 \u00d7 enlarged"));
  EXPECT_TRUE(has("displacement / px"));
  EXPECT_TRUE(has("subset 31 \u00d7 31 px"));
  EXPECT_TRUE(has("1 point without result"));
}

TEST(DrawField, KeepsAllTextsOnThePaperAndApart) {
  FieldScene scene = Ramp();
  scene.arrows = true;
  scene.title = std::string(300, 'w');
  scene.notes = {"one", "two"};
  scene.inside = [](int x, int) { return x > 40; };
  const auto picture = DrawField(Flat(), scene);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  const auto& texts = picture->texts;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const PixelBox& box = texts[i].box;
    EXPECT_GE(box.left, 0) << texts[i].text;
    EXPECT_GE(box.bottom, 0) << texts[i].text;
    EXPECT_LE(box.Right(), picture->image.width_px) << texts[i].text;
    EXPECT_LE(box.Top(), picture->image.height_px) << texts[i].text;
    for (std::size_t j = 0; j < i; ++j) {
      const PixelBox& other = texts[j].box;
      const bool apart = box.left >= other.Right() || other.left >= box.Right() ||
                         box.bottom >= other.Top() || other.bottom >= box.Top();
      EXPECT_TRUE(apart) << texts[i].text << " covers " << texts[j].text;
    }
  }
}

TEST(ImageBackdrop, ShowsMeansWhereSmallerAndPixelsWhereLarger) {
  GrayImage image{40, 20, 255, {}};
  for (int i = 0; i < 800; ++i) image.pixels.push_back(i % 2 == 0 ? 0.0F : 200.0F);
  const ImageBackdrop half(image, 20, 20);
  ASSERT_EQ(half.width(), 20);
  ASSERT_EQ(half.height(), 10);
  EXPECT_FLOAT_EQ(half.Gray(3, 4), half.Gray(8, 9));  // every mean is the same
  const ImageBackdrop twice(image, 80, 80);
  ASSERT_EQ(twice.width(), 80);
  EXPECT_EQ(twice.Gray(0, 0), 0.0F);
  EXPECT_EQ(twice.Gray(1, 1), 0.0F);
  EXPECT_EQ(twice.Gray(2, 0), 1.0F);
  EXPECT_NEAR(twice.ImagePlace(0, 0).x(), -0.25, 1e-12);
}

}  // namespace
}  // namespace telestrain::viz
