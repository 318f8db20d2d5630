#include "calibration/planar_view.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr double kMagnification = 227.27;

AffineHomography HomographyOf(const Eigen::Matrix3d& camera_from_target) {
  return {kMagnification * camera_from_target.topLeftCorner<2, 2>(), {640, 480}};
}

TEST(PlanarView, HomographyOfExactPointsIsExact) {
  Eigen::Matrix2d linear;
  linear << 210, -13, 8, 190;
  const Eigen::Vector2d offset(12.5, -7);
  Eigen::Matrix2Xd target(2, 5);
  target << 0, 1, 0, 2, -1, 0, 0, 1, 3, 2;
  const Eigen::Matrix2Xd pixels = (linear * target).colwise() + offset;
  const auto fit = FitAffineHomography(target, pixels);
  ASSERT_TRUE(fit.ok());
  EXPECT_LT((fit->px_per_mm - linear).norm(), 1e-10);
  EXPECT_LT((fit->offset_px - offset).norm(), 1e-10);
}

TEST(PlanarView, CollinearPointsAreRefused) {
  Eigen::Matrix2Xd target(2, 4);
  target << 0, 1, 2, 3, 0, 2, 4, 6;
  const auto fit = FitAffineHomography(target, target);
  ASSERT_FALSE(fit.ok());
  EXPECT_EQ(fit.error().kind, ErrorKind::kEstimationFailed);
  EXPECT_NE(fit.error().message.find("one line"), std::string::npos);
}

TEST(PlanarView, MagnificationDoesNotDependOnTheTilt) {
  for (double tilt = 0; tilt < 1.2; tilt += 0.1)
    for (double turn = 0; turn < 6; turn += 0.7) {
      const Eigen::Matrix3d rotation = ExpRotation({0, 0, turn}) * ExpRotation({tilt, 0.1, 0.0});
      EXPECT_NEAR(MagnificationFromHomography(HomographyOf(rotation)), kMagnification, 1e-9);
    }
}

TEST(PlanarView, TheTwoRotationsAreNeckerTwinsAndOneIsTrue) {
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, 1, -1).asDiagonal();
  for (double tilt = 0.05; tilt < 1.3; tilt += 0.2)
    for (double turn = 0; turn < 6; turn += 0.9) {
      const Eigen::Matrix3d truth = ExpRotation({0.2, 0, turn}) * ExpRotation({tilt, -0.2, 0.4});
      const auto both = RotationsFromHomography(HomographyOf(truth), kMagnification);
      const auto& [first, second] = both.camera_from_target;
      EXPECT_NEAR(first.determinant(), 1, 1e-12);
      EXPECT_LT((second - mirror * first * mirror).norm(), 1e-7);
      EXPECT_LT(std::min((first - truth).norm(), (second - truth).norm()), 1e-6);
    }
}

TEST(PlanarView, PaperEquationSixWorksForFreeTiltsAndNotForTheArray) {
  std::vector<AffineHomography> free_tilts, one_axis;
  for (int i = 0; i < 18; ++i) {
    const double direction = 0.7 * i, tilt = 0.2 + 0.02 * i;
    free_tilts.push_back(
        HomographyOf(ExpRotation({tilt * std::cos(direction), tilt * std::sin(direction), 0}) *
                     ExpRotation({0, 0, 0.1 * i})));
    one_axis.push_back(HomographyOf(ExpRotation({0.5, 0, 0})));
  }
  const auto scales = TwoMagnificationsOfPaper(free_tilts);
  ASSERT_TRUE(scales.has_value());
  EXPECT_NEAR(scales->x(), kMagnification, 1e-6 * kMagnification);
  EXPECT_NEAR(scales->y(), kMagnification, 1e-6 * kMagnification);
  EXPECT_FALSE(TwoMagnificationsOfPaper(one_axis).has_value());
}

}  // namespace
}  // namespace telestrain
