// What is wrong with a subset is what its status says.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kSide = 200;
const PixelRegion kRegion{0, 0, kSide, kSide};
const Eigen::Vector2i kCenter{100, 100};
const CorrelationOptions kOptions{.subset_px = 41};

class Status : public testing::Test {
 protected:
  static GrayImage Clipped(GrayImage image) {
    for (float& value : image.pixels) value = std::clamp(value, 0.f, 255.f);
    return image;
  }
  static GrayImage Filled(GrayImage image, const PixelRegion& part, float gray) {
    for (int y = part.y; y < part.y + part.height; ++y)
      for (int x = part.x; x < part.x + part.width; ++x) image.At(x, y) = gray;
    return image;
  }
  MatchStatus StatusOf(const GrayImage& before, const GrayImage& after) const {
    return CorrelationReference(before, kRegion, kOptions)
        .Match(kCenter, {after, kRegion, kOptions}, {})
        .status;
  }

  const GrayImage image_ = Clipped(Speckle(21, kSide, kSide, 2.0).Render(kSide, kSide));
  const PixelRegion whole_subset_{75, 75, 51, 51};
  const PixelRegion two_thirds_{75, 75, 51, 33};  // 28 of 41 rows
  const PixelRegion a_third_{75, 75, 51, 18};     // 13 of 41 rows
};

TEST_F(Status, BlackHasNoContrast) {
  EXPECT_EQ(StatusOf(Filled(image_, whole_subset_, 0), image_), MatchStatus::kLowContrast);
}

TEST_F(Status, WhiteIsSaturated) {
  EXPECT_EQ(StatusOf(Filled(image_, whole_subset_, 255), image_), MatchStatus::kSaturated);
}

TEST_F(Status, MoreThanHalfAtAnEndIsSaturatedInEitherImage) {
  for (float end : {0.f, 255.f}) {
    const GrayImage mostly = Filled(image_, two_thirds_, end);
    EXPECT_EQ(StatusOf(mostly, mostly), MatchStatus::kSaturated);
    EXPECT_EQ(StatusOf(image_, Filled(image_, whole_subset_, end)), MatchStatus::kSaturated);
    const GrayImage partly = Filled(image_, a_third_, end);
    EXPECT_EQ(StatusOf(partly, partly), MatchStatus::kConverged);
  }
}

TEST_F(Status, AnOccludedOrOtherPatternHasLowCorrelation) {
  const GrayImage other = Clipped(Speckle(22, kSide, kSide, 2.0).Render(kSide, kSide));
  const MatchStatus decorrelated = StatusOf(image_, other);
  EXPECT_TRUE(decorrelated == MatchStatus::kLowCorrelation ||
              decorrelated == MatchStatus::kNotConverged)
      << ToText(decorrelated);
  EXPECT_EQ(StatusOf(image_, Filled(image_, whole_subset_, 90)), MatchStatus::kLowCorrelation);
}

TEST_F(Status, EveryStatusHasItsText) {
  EXPECT_EQ(ToText(MatchStatus::kSaturated), "saturated");
  EXPECT_EQ(ToText(MatchStatus::kMasked), "masked");
}

class Masked : public Status {
 protected:
  // Inside: columns from `first` on.
  static PixelMask From(int first) {
    PixelMask mask{kSide, kSide, std::vector<unsigned char>(kSide * kSide)};
    for (int y = 0; y < kSide; ++y)
      for (int x = first; x < kSide; ++x) mask.inside[y * kSide + x] = 1;
    return mask;
  }
};

TEST_F(Masked, LessThanHalfInsideIsMasked) {
  for (const auto& [first, status] :
       {std::pair(101, MatchStatus::kMasked), std::pair(100, MatchStatus::kConverged)}) {
    const PixelMask mask = From(first);
    const CorrelationReference reference(image_, kRegion, kOptions, &mask);
    EXPECT_EQ(reference.Match(kCenter, {image_, kRegion, kOptions}, {}).status, status) << first;
  }
}

// The surroundings, from 8 px beyond the mask's edge on, are another pattern with the other sign in
// the second image. They stay finite: the blur and the spline of pixels at the edge still see them.
TEST_F(Masked, PixelsOutsideNeverCount) {
  const Speckle speckle(23, kSide, kSide, 2.0), other(24, kSide, kSide, 2.0);
  ShapeFunction map;
  map.displacement_px = {0.3, -0.2};
  GrayImage before = speckle.Render(kSide, kSide), after = speckle.Render(kSide, kSide, map);
  const PixelMask mask = From(96);
  const CorrelationReference clean(before, kRegion, kOptions, &mask);
  const SubsetMatch expected = clean.Match(kCenter, {after, kRegion, kOptions}, {});
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < 88; ++x) {
      before.At(x, y) = static_cast<float>(other.At({x, y}));
      after.At(x, y) = 255 - before.At(x, y);
    }
  const CorrelationReference spoilt(before, kRegion, kOptions, &mask);
  const SubsetMatch match = spoilt.Match(kCenter, {after, kRegion, kOptions}, {});
  ASSERT_TRUE(expected.ok());
  ASSERT_TRUE(match.ok());
  EXPECT_LT((expected.shape.displacement_px - map.displacement_px).norm(), 1e-3);
  // What is left is the reach of the filters across 8 px: 0.43^8 = 1e-3 of a grey level's jump.
  EXPECT_LT((match.shape.displacement_px - expected.shape.displacement_px).norm(), 1e-3);
  const CorrelationReference without(before, kRegion, kOptions);
  const SubsetMatch wrong = without.Match(kCenter, {after, kRegion, kOptions}, {});
  EXPECT_FALSE(wrong.ok() && (wrong.shape.displacement_px - map.displacement_px).norm() < 1e-3);
}

TEST_F(Masked, AMaskOfOnesChangesNoBit) {
  const PixelMask mask = From(0);
  const PreparedImage image(image_, kRegion, kOptions);
  const SubsetMatch a = CorrelationReference(image_, kRegion, kOptions).Match(kCenter, image, {});
  const SubsetMatch b =
      CorrelationReference(image_, kRegion, kOptions, &mask).Match(kCenter, image, {});
  EXPECT_EQ(a.zncc, b.zncc);
  EXPECT_EQ(a.covariance, b.covariance);
}

TEST_F(Masked, AMaskOfAnotherSizeIsRefused) {
  const PixelMask mask{10, 10, std::vector<unsigned char>(100, 1)};
  EXPECT_THROW(CorrelationReference(image_, kRegion, kOptions, &mask), std::logic_error);
}

}  // namespace
}  // namespace telestrain
