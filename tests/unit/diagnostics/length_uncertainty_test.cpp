#include "diagnostics/length_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/calibration/bundle_scene.h"

namespace telestrain {
namespace {

using testing_support::MakeScene;
using testing_support::MakeSyntheticArray;
using testing_support::Scene;
using testing_support::With;

LengthUncertainty Of(Scene scene, const LensModel& model, const LengthOptions& options = {}) {
  scene.truth.array.model = model;
  const auto covariance = CovarianceWithMeanMotion(scene.data, scene.truth, With(model), 1).value();
  return LengthUncertaintyOf(MakeSyntheticArray({}).session, scene.truth.array, covariance, options)
      .value();
}

Scene Certified() {
  return MakeScene(0, 0.1, [](Scene& s) { s.data.target.sigma_separation_um = 0.25; });
}

const LensModel kDistorted{{true, false, true, true, false}, false, false, false};

TEST(LengthUncertainty, HoldsTheCertifiedDistanceOfTheBoardsOneToOne) {
  const LengthUncertainty u = Of(Certified(), {});
  EXPECT_NEAR(u.length_mm, 27.7, 0.5);  // views are off by 0.1 mm and 0.5 degrees
  const double certificate_um =
      std::sqrt(std::pow(u.length_um.of_everything, 2) - std::pow(u.length_um.of_noise, 2));
  EXPECT_NEAR(certificate_um, 0.25, 0.005 * 0.25);  // tilts of 4 degrees: 1 - cos
}

// The groups are turned against each other by some 1e-5 rad: a shift s across the line feigns s
// times that over the length. Distortion comes on top.
TEST(LengthUncertainty, AShiftFeignsTheTurnOfTheGroupsAgainstEachOther) {
  LengthOptions twice;
  twice.shift_mm *= 2;
  const double plain = Of(Certified(), {}).shift_microstrain.of_noise;
  // Lengths are second order in turns of 1e-5 rad; rounding of 27.7 mm against 1 nm.
  EXPECT_NEAR(Of(Certified(), {}, twice).shift_microstrain.of_noise, 2 * plain, 1e-5 * plain);
  EXPECT_GT(plain, 0.1 / 27.7 * 1e-6 * 1e6);  // turns of 1e-6 rad at least: noise of 4e-4 mm
  EXPECT_LT(plain, 0.1 / 27.7 * 1e-4 * 1e6);
  EXPECT_GT(Of(Certified(), kDistorted).shift_microstrain.of_noise, plain);
}

// The fields' distance is certified and the motions are scaled by the magnification.
TEST(LengthUncertainty, ATrueStrainErrsByTheScaleOfTheMotions) {
  const Scene scene = MakeScene(0, 0.1, [](Scene&) {});
  const auto covariance = CovarianceWithMeanMotion(scene.data, scene.truth, {}, 1).value();
  const double m = scene.truth.array.Magnification_px_per_mm();
  const double relative = std::sqrt(covariance.of_noise(0, 0)) / m;
  const LengthUncertainty u = Of(scene, {});
  // The length itself is known 30 times better than the magnification: it adds little.
  EXPECT_NEAR(u.true_strain_microstrain.of_noise, 1000 * relative, 0.15 * 1000 * relative);
}

TEST(LengthUncertainty, GrowsWithTheMotionAndIsSaidInWords) {
  LengthOptions twice;
  twice.shift_mm *= 2;
  twice.true_strain *= 2;
  const LengthUncertainty one = Of(Certified(), kDistorted);
  const LengthUncertainty two = Of(Certified(), kDistorted, twice);
  // Distortion is cubic in the field of 3 mm: 0.1 mm changes its slope by some per cent.
  EXPECT_NEAR(two.shift_microstrain.of_noise / one.shift_microstrain.of_noise, 2, 0.1);
  EXPECT_NEAR(two.true_strain_microstrain.of_noise / one.true_strain_microstrain.of_noise, 2, 0.01);
  ASSERT_EQ(one.sentences.size(), 4U);
  EXPECT_TRUE(one.sentences[0].starts_with("A length of 27.")) << one.sentences[0];
  EXPECT_NE(one.sentences[0].find(" 0.25 um with the target's certificate"), std::string::npos)
      << one.sentences[0];
  EXPECT_NE(two.sentences[1].find(" 0.2 mm "), std::string::npos) << two.sentences[1];
}

TEST(LengthUncertainty, NeedsTwoGroupsAndSaysSo) {
  const Scene scene = Certified();
  const auto covariance = CovarianceWithMeanMotion(scene.data, scene.truth, {}, 1).value();
  Session session = MakeSyntheticArray({}).session;
  session.views.resize(2);
  const auto result = LengthUncertaintyOf(session, scene.truth.array, covariance);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kEstimationFailed);
  EXPECT_NE(result.error().message.find("two"), std::string::npos);
}

}  // namespace
}  // namespace telestrain
