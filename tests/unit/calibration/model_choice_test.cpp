#include "calibration/model_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/calibrate.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::MakeSyntheticArray;
using testing_support::MustCalibrate;
using testing_support::ObserveAgain;
using testing_support::SyntheticArray;
using testing_support::SyntheticOptions;

constexpr double kNoise_px = 0.02;

SyntheticArray Start() {
  SyntheticOptions options;
  options.noise_px = kNoise_px;
  options.poses = 12;
  return MakeSyntheticArray(options);
}

bool Accepted(const Calibration& calibration, const std::string& step) {
  for (const ModelTest& test : calibration.model_tests)
    if (test.added == step) return test.accepted;
  ADD_FAILURE() << step << " was not tested";
  return false;
}

// Upper tails of chi-square, Abramowitz and Stegun table 26.8.
TEST(ModelChoice, ChiSquareTailEqualsTheTable) {
  EXPECT_NEAR(ChiSquareTail(3.84146, 1), 0.05, 1e-6);
  EXPECT_NEAR(ChiSquareTail(10.828, 1), 0.001, 1e-6);
  EXPECT_NEAR(ChiSquareTail(5.99146, 2), 0.05, 1e-6);
  EXPECT_NEAR(ChiSquareTail(7.81473, 3), 0.05, 1e-6);
  EXPECT_NEAR(ChiSquareTail(9.48773, 4), 0.05, 1e-6);
  EXPECT_EQ(ChiSquareTail(0, 3), 1);
}

TEST(ModelChoice, EveryStepIsOfferedAndAPerfectLensNeedsNone) {
  const Calibration calibration = MustCalibrate(Start());
  EXPECT_EQ(ToText(calibration.bundle.state.array.model), "none");
  ASSERT_EQ(calibration.model_tests.size(), 9u);
  for (const char* step : {"k1", "p1 p2", "k2", "k3", "telecentricity", "bow of the boards",
                           "aspect", "a lens per view"})
    EXPECT_FALSE(Accepted(calibration, step)) << step;
}

// 0.02 % per mm over +-1 mm of depth moves a point at 3.5 mm from the axis by 0.16 px: 8 sigma.
TEST(ModelChoice, LeaningRaysAreFoundWithTheirUncertainty) {
  SyntheticArray array = Start();
  array.lens.telecentricity_per_mm = 2e-4;
  ObserveAgain(array, kNoise_px, 5);
  const Calibration calibration = MustCalibrate(array);
  const ArrayCalibration& found = calibration.bundle.state.array;
  EXPECT_EQ(ToText(found.model), "telecentricity");
  EXPECT_NEAR(found.lenses[0].telecentricity_per_mm, 2e-4, 4 * std::sqrt(found.covariance(1, 1)));
  EXPECT_LT(std::sqrt(found.covariance(1, 1)), 2e-5);
}

TEST(ModelChoice, ABentBoardIsFound) {
  SyntheticArray array = Start();
  array.shape.boards.resize(2);
  array.shape.boards[1].bow_x_mm = 0.002;
  ObserveAgain(array, kNoise_px, 6);
  const Calibration calibration = MustCalibrate(array);
  EXPECT_TRUE(Accepted(calibration, "bow of the boards"));
  // A bow of 2 um moves corners by 2 um sin(30 deg) = 0.23 px; 24 images of 117 corners with
  // 0.02 px give it to about 0.02 um. 0.1 um is 5 sigma.
  EXPECT_NEAR(calibration.bundle.state.target.boards[1].bow_x_mm, 0.002, 1e-4);
  EXPECT_EQ(ToText(calibration.bundle.state.array.model), "none");
}

TEST(ModelChoice, ViewsOfDifferentScaleGetALensEach) {
  SyntheticArray array = Start();
  array.lens_of_view.assign(4, array.lens);
  array.lens_of_view[2].magnification_px_per_mm *= 1.0005;
  ObserveAgain(array, kNoise_px, 7);
  const Calibration calibration = MustCalibrate(array);
  const ArrayCalibration& found = calibration.bundle.state.array;
  EXPECT_TRUE(found.model.per_view);
  ASSERT_EQ(found.lenses.size(), 4u);
  const int step = found.model.Count();
  for (int v = 0; v < 4; ++v)
    EXPECT_NEAR(found.lenses[static_cast<std::size_t>(v)].magnification_px_per_mm,
                array.lens_of_view[static_cast<std::size_t>(v)].magnification_px_per_mm,
                4 * std::sqrt(found.covariance(v * step, v * step)));
}

TEST(ModelChoice, AStretchedPixelIsFound) {
  SyntheticArray array = Start();
  array.lens.aspect = 1.003;
  ObserveAgain(array, kNoise_px, 8);
  const Calibration calibration = MustCalibrate(array);
  EXPECT_TRUE(calibration.bundle.state.array.model.aspect);
  EXPECT_NEAR(calibration.bundle.state.array.lenses[0].aspect, 1.003,
              4 * std::sqrt(calibration.bundle.state.array.covariance(1, 1)));
}

// The lens that undistorts what this one distorts, to second order: k1' = -k1, k2' = 3 k1^2. At
// 0.1 % the difference is told by k2.
TEST(ModelChoice, DistortionOfTheOtherDirectionIsFittedToTheNoise) {
  SyntheticArray array = Start();
  const double k1 = 1e-3 / 64;  // 0.1 % at 8 mm
  for (const double sign : {-1.0, 1.0}) {
    // Observed -> ideal by sign k1 is ideal -> observed by the inverse series.
    array.lens.distortion = {-sign * k1, 3 * k1 * k1, 0, 0, -sign * 12 * k1 * k1 * k1};
    ObserveAgain(array, kNoise_px, 9);
    const Calibration calibration = MustCalibrate(array);
    const double freedom = 1.0 - static_cast<double>(calibration.bundle.parameter_count) /
                                     calibration.bundle.residual_count;
    // RMS = sigma sqrt(1 - npar / nobs), 4 sigma of the RMS of 22464 scalars: 1.9 %.
    EXPECT_NEAR(calibration.all.rms_px, kNoise_px * std::sqrt(freedom), 0.019 * kNoise_px);
  }
}

}  // namespace
}  // namespace telestrain
