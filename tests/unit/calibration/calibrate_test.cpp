#include "calibration/calibrate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/rotation.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::MakeSyntheticArray;
using testing_support::MustCalibrate;
using testing_support::SyntheticArray;
using testing_support::SyntheticOptions;

// Relative rotation of two views against the truth: free of the gauge.
double RelativeRotationError_rad(const SyntheticArray& array, const Calibration& calibration,
                                 std::size_t i, std::size_t j) {
  const auto& views = calibration.bundle.state.array.views;
  return AngleBetween_rad(views[j].Rotation() * views[i].Rotation().transpose(),
                          array.views[j].Rotation() * array.views[i].Rotation().transpose());
}

TEST(Calibrate, ExactCornersGiveTheExactInstrument) {
  for (const bool mirrored : {false, true}) {
    SyntheticOptions options;
    options.noise_px = 0;
    options.mirrored = mirrored;
    const SyntheticArray array = MakeSyntheticArray(options);
    const Calibration calibration = MustCalibrate(array);
    EXPECT_LT(calibration.all.max_px, 1e-6);
    EXPECT_NEAR(calibration.bundle.state.array.Magnification_px_per_mm(),
                array.lens.magnification_px_per_mm, 1e-6);
    for (std::size_t i = 1; i < 4; ++i)
      EXPECT_LT(RelativeRotationError_rad(array, calibration, 0, i), 1e-8);
    EXPECT_EQ(calibration.seed.decision.stage_agreeing, calibration.seed.decision.stage_pairs);
    EXPECT_GT(calibration.stage.twin_chi2_ratio, 100);
  }
}

TEST(Calibrate, ResidualsHaveTheSizeThatNoiseAndParametersLeave) {
  SyntheticOptions options;
  options.noise_px = 0.1;
  const SyntheticArray array = MakeSyntheticArray(options);
  const Calibration calibration = MustCalibrate(array);
  const auto& bundle = calibration.bundle;
  const double expected =
      0.1 * std::sqrt(1.0 - static_cast<double>(bundle.parameter_count) / bundle.residual_count);
  // The RMS of n normal residuals scatters by 1/sqrt(2n): 4 sigma for 16848 scalars is 2.2 %.
  EXPECT_NEAR(calibration.all.rms_px, expected, 0.022 * expected);
  EXPECT_NEAR(calibration.sigma0, 1.0, 0.022);
  EXPECT_EQ(calibration.corners_rejected, 0);
  EXPECT_EQ(calibration.all.corners, 72 * 117);
}

TEST(Calibrate, MagnificationLiesWithinItsUncertainty) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SyntheticOptions options;
    options.seed = seed;
    const SyntheticArray array = MakeSyntheticArray(options);
    const Calibration calibration = MustCalibrate(array);
    const auto& found = calibration.bundle.state.array;
    EXPECT_NEAR(found.lenses.front().magnification_px_per_mm, array.lens.magnification_px_per_mm,
                4 * std::sqrt(found.covariance(0, 0)));  // 4 sigma of the predicted marginal
  }
}

TEST(Calibrate, DistortionIsFreedOnlyWhenTheDataWantIt) {
  SyntheticOptions options;
  EXPECT_EQ(ToText(MustCalibrate(MakeSyntheticArray(options)).bundle.state.array.model), "none");
  options.k1_per_mm2 = 1e-5;
  const Calibration distorted = MustCalibrate(MakeSyntheticArray(options));
  EXPECT_EQ(ToText(distorted.bundle.state.array.model), "k1");
  const auto& array = distorted.bundle.state.array;
  EXPECT_NEAR(array.lenses.front().distortion[0], 1e-5, 4 * std::sqrt(array.covariance(1, 1)));
}

TEST(Calibrate, PoisonedCornersAreNotRead) {
  SyntheticOptions options;
  SyntheticArray array = MakeSyntheticArray(options);
  const Calibration clean = MustCalibrate(array);
  int poisoned = 0;
  for (std::size_t b = 0; b < array.boards.size(); b += 3)
    for (std::size_t c = b % 7; c < 117; c += 40, ++poisoned)
      array.boards[b].corners[c]->pixel += Eigen::Vector2d(5, -8);
  const Calibration calibration = MustCalibrate(array);
  EXPECT_GE(calibration.corners_rejected, poisoned);
  EXPECT_LE(calibration.corners_rejected, poisoned + 20);
  EXPECT_NEAR(calibration.bundle.state.array.Magnification_px_per_mm(),
              clean.bundle.state.array.Magnification_px_per_mm(),
              2 * std::sqrt(clean.bundle.state.array.covariance(0, 0)));
}

TEST(Calibrate, MissingBoardsAreLeftOutAndListed) {
  SyntheticOptions options;
  SyntheticArray array = MakeSyntheticArray(options);
  for (const std::size_t b : {1u, 6u, 8u, 9u, 10u}) {
    array.boards[b].corners.clear();
    array.boards[b].rejected_because = "cut off";
  }
  const Calibration calibration = MustCalibrate(array);
  // Image 2 keeps one view only, so that view is listed too.
  EXPECT_EQ(calibration.data.rejected.size(), 6u);
  EXPECT_EQ(calibration.data.boards.size(), 72u - 6u);
  EXPECT_EQ(calibration.data.images.size(), 17u);
  EXPECT_LT(calibration.all.rms_px, 0.103);
}

TEST(Calibrate, AStageThatMovesTheOtherWayIsAnError) {
  SyntheticOptions options;
  options.stage_sense = -1;
  const SyntheticArray array = MakeSyntheticArray(options);
  const auto result = Calibrate(array.session, array.boards);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kEstimationFailed);
  EXPECT_NE(result.error().message.find("stage"), std::string::npos) << result.error().message;
}

TEST(Calibrate, ATravelThatTheTableStatesWronglyIsAnErrorThatNamesTheRows) {
  SyntheticArray array = MakeSyntheticArray({});
  array.session.calibration_images[3].stage_mm = 2;  // the target moved by 1 mm
  const auto result = Calibrate(array.session, array.boards);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kEstimationFailed);
  EXPECT_NE(result.error().message.find("board_1a.png to board_1b.png"), std::string::npos)
      << result.error().message;
  EXPECT_NE(result.error().message.find("stage_mm says 2.000"), std::string::npos);
}

// Six sigma of the noise, but no mistake: within 0.1 px of the model.
TEST(Calibrate, SmallImperfectionsAreNoOutliersAndMistakesAre) {
  SyntheticOptions options;
  options.noise_px = 0.01;
  SyntheticArray array = MakeSyntheticArray(options);
  for (std::size_t b = 0; b < array.boards.size(); ++b)
    for (std::size_t c = b % 20; c < 117; c += 20) array.boards[b].corners[c]->pixel.y() += 0.06;
  EXPECT_EQ(MustCalibrate(array).corners_rejected, 0);
  for (std::size_t b = 0; b < array.boards.size(); b += 5)
    array.boards[b].corners[7]->pixel.x() += 3;
  EXPECT_EQ(MustCalibrate(array).corners_rejected, 15);
}

TEST(Calibrate, TooFewImagesAreAnErrorThatSaysHowMany) {
  SyntheticArray array = MakeSyntheticArray({});
  array.boards.resize(8);
  const auto result = Calibrate(array.session, array.boards);
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().message.find("at least 3"), std::string::npos);
}

TEST(Calibrate, SameInputGivesTheSameNumbers) {
  const SyntheticArray array = MakeSyntheticArray({});
  const Calibration a = MustCalibrate(array), b = MustCalibrate(array);
  EXPECT_EQ(a.bundle.chi2, b.bundle.chi2);
  EXPECT_EQ(a.bundle.state.array.covariance, b.bundle.state.array.covariance);
}

}  // namespace
}  // namespace telestrain
