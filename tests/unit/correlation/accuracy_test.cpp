// Exact images of known maps: what is measured is the matching's own error.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kSide = 260;
const PixelRegion kRegion{0, 0, kSide, kSide};
const Eigen::Vector2d kAbout = kRegion.Middle();

struct MeanError {
  Eigen::Vector2d displacement_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
  double worst_px = 0;
};

MeanError MeasureMap(const Speckle& speckle, const ShapeFunction& map,
                     const CorrelationOptions& options) {
  const CorrelationReference reference(speckle.Render(kSide, kSide), kRegion, options);
  const PreparedImage image(speckle.Render(kSide, kSide, map, kAbout), kRegion, options);
  const auto centers = GridOfCenters(kRegion, 45, 17);
  const auto matches = CorrelatePoints(reference, centers, image, {ShapeFunction()});
  MeanError mean;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    EXPECT_TRUE(matches[i].ok()) << ToText(matches[i].status);
    const ShapeFunction truth = TruthAt(map, kAbout, centers[i]);
    const Eigen::Vector2d error = matches[i].shape.displacement_px - truth.displacement_px;
    mean.displacement_px += error;
    mean.gradient += matches[i].shape.gradient - truth.gradient;
    mean.worst_px = std::max(mean.worst_px, error.norm());
  }
  mean.displacement_px /= static_cast<double>(centers.size());
  mean.gradient /= static_cast<double>(centers.size());
  return mean;
}

TEST(Accuracy, SubpixelShiftsHaveNoBias) {
  const Speckle speckle(1, kSide, kSide);
  for (int tenth = 0; tenth <= 10; ++tenth) {
    ShapeFunction map;
    map.displacement_px = {0.1 * tenth, 1 - 0.1 * tenth};
    const MeanError mean = MeasureMap(speckle, map, {.subset_px = 33});
    EXPECT_LT(mean.displacement_px.cwiseAbs().maxCoeff(), 0.2e-3) << tenth;
    EXPECT_LT(mean.worst_px, 1e-3) << tenth;
  }
}

TEST(Accuracy, ThePrefilterRemovesTheBiasOfSharpSpeckle) {
  const Speckle speckle(2, kSide, kSide, 1.0);
  double worst_raw_px = 0, worst_px = 0;
  for (double shift_px : {0.1, 0.25, 0.4}) {
    ShapeFunction map;
    map.displacement_px = {shift_px, -shift_px};
    const CorrelationOptions raw{.subset_px = 61, .prefilter_sigma_px = 0};
    const MeanError before = MeasureMap(speckle, map, raw);
    const MeanError after = MeasureMap(speckle, map, {.subset_px = 61});
    worst_raw_px = std::max(worst_raw_px, before.displacement_px.cwiseAbs().maxCoeff());
    worst_px = std::max(worst_px, after.displacement_px.cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst_px, 0.4e-3);
  // The quintic spline errs at periods of 2 to 4 px; of their squares the two blurs leave
  // exp(-sigma^2 (2 pi / 4)^2) = 0.41 or less.
  EXPECT_LT(worst_px, worst_raw_px * 0.5);
}

// One microstrain: far below what noise leaves.
TEST(Accuracy, TranslationGivesNoStrain) {
  ShapeFunction map;
  map.displacement_px = {3.37, -2.71};
  const MeanError mean = MeasureMap(Speckle(3, kSide, kSide), map, {});
  EXPECT_LT(mean.gradient.cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT(mean.displacement_px.cwiseAbs().maxCoeff(), 0.2e-3);
}

TEST(Accuracy, RecoversAStretchOf750Microstrain) {
  ShapeFunction map;
  map.displacement_px = {0.4, 0.2};
  map.gradient << 750e-6, 0, 0, -225e-6;
  const MeanError mean = MeasureMap(Speckle(4, kSide, kSide), map, {});
  EXPECT_LT(mean.gradient.cwiseAbs().maxCoeff(), 1.5e-6);  // 0.2 % of the stretch
  EXPECT_LT(mean.displacement_px.cwiseAbs().maxCoeff(), 0.2e-3);
}

TEST(Accuracy, RotationGivesNoStrain) {
  const double angle = std::numbers::pi / 180;
  ShapeFunction map;
  map.gradient << std::cos(angle) - 1, -std::sin(angle), std::sin(angle), std::cos(angle) - 1;
  const MeanError mean = MeasureMap(Speckle(5, kSide, kSide), map, {});
  EXPECT_LT(mean.gradient.cwiseAbs().maxCoeff(), 3e-6);
  EXPECT_LT(mean.worst_px, 1e-3);
}

// Another view of the surface, 0.6 times as wide: without stretching the blur the points scatter by
// some 4 mpx, fixed to the pattern.
TEST(Accuracy, AnotherViewIsMatchedWithoutScatter) {
  const Speckle speckle(7, kSide, kSide);
  ShapeFunction map;
  map.displacement_px = {0.3, 0.1};
  map.gradient << -0.4, 0.05, 0.05, 0;
  const CorrelationOptions options{.subset_px = 41};
  const CorrelationReference reference(speckle.Render(kSide, kSide), kRegion, options);
  const PreparedImage image(speckle.Render(kSide, kSide, map, kAbout), kRegion, options,
                            map.gradient);
  for (const auto& center : GridOfCenters(kRegion, 60, 23)) {
    const ShapeFunction truth = TruthAt(map, kAbout, center);
    const SubsetMatch match = reference.Match(center, image, truth);
    ASSERT_TRUE(match.ok());
    EXPECT_LT((match.shape.displacement_px - truth.displacement_px).norm(), 1e-3);
  }
}

// Brightness and contrast do not count.
TEST(Accuracy, IsBlindToBrightnessAndContrast) {
  const Speckle speckle(6, kSide, kSide);
  ShapeFunction map;
  map.displacement_px = {0.3, 0.6};
  const CorrelationOptions options{.subset_px = 33};
  const CorrelationReference reference(speckle.Render(kSide, kSide), kRegion, options);
  GrayImage dark = speckle.Render(kSide, kSide, map);
  for (float& value : dark.pixels) value = 0.4f * value - 20;
  const SubsetMatch match = reference.Match({130, 130}, {dark, kRegion, options}, {});
  ASSERT_TRUE(match.ok());
  EXPECT_NEAR((match.shape.displacement_px - map.displacement_px).norm(), 0, 1e-3);
  EXPECT_GT(match.zncc, 0.9999);
}

}  // namespace
}  // namespace telestrain
