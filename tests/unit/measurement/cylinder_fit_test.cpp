#include "measurement/cylinder_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::Random;

Cylinder SomePipe() {
  Cylinder pipe;
  pipe.axis_point_mm = {0, 0.2, -4.1};
  pipe.axis = Eigen::Vector3d(1, 0.004, -0.006).normalized();
  pipe.radius_mm = 4.0;
  return pipe;
}

// Two patches, 60 degrees of arc each, as the array sees them.
std::vector<Eigen::Vector3d> SurfacePoints(const Cylinder& pipe, double noise_mm, Random& random) {
  const Eigen::Vector3d up = (Eigen::Vector3d::UnitZ() - pipe.axis * pipe.axis.z()).normalized();
  const Eigen::Vector3d side = pipe.axis.cross(up);
  std::vector<Eigen::Vector3d> points;
  for (const double center : {-13.85, 13.85})
    for (double x = -2; x <= 2; x += 0.4)
      for (double angle = -0.5; angle <= 0.5; angle += 0.1) {
        const double radius = pipe.radius_mm + random.Normal(noise_mm);
        points.push_back(pipe.axis_point_mm + pipe.axis * (center + x) +
                         radius * (up * std::cos(angle) + side * std::sin(angle)));
      }
  return points;
}

Cylinder Start() {
  Cylinder start;
  start.axis_point_mm = {0, 0, -4};
  start.radius_mm = 4.05;
  return start;
}

TEST(CylinderFit, ExactPointsGiveTheExactCylinder) {
  Random random(1);
  const Cylinder pipe = SomePipe();
  const auto fit = FitCylinder(SurfacePoints(pipe, 0, random), Start());
  ASSERT_TRUE(fit.ok()) << fit.error().message;
  EXPECT_NEAR(fit->cylinder.radius_mm, 4.0, 1e-9);
  EXPECT_LT(fit->cylinder.axis.cross(pipe.axis).norm(), 1e-9);
}

TEST(CylinderFit, DiameterLiesWithinItsUncertaintyDespiteOutliers) {
  int within = 0;
  for (int seed = 0; seed < 40; ++seed) {
    Random random(100 + seed);
    auto points = SurfacePoints(SomePipe(), 5e-4, random);
    for (std::size_t i = 3; i < points.size(); i += 25) points[i].z() += 0.1;
    const auto fit = FitCylinder(points, Start());
    ASSERT_TRUE(fit.ok());
    EXPECT_FALSE(fit->used[3]);
    within += std::abs(2 * fit->cylinder.radius_mm - 8.0) < 2 * fit->sigma_diameter_mm;
  }
  EXPECT_GE(within, 33);  // 95 % of 40 is 38; binomial 3 sigma is 4.1
}

TEST(CylinderFit, TooFewPointsAreRefused) {
  const auto fit = FitCylinder({{0, 0, 0}, {1, 0, 0}}, Start());
  ASSERT_FALSE(fit.ok());
  EXPECT_NE(fit.error().message.find("at least 20"), std::string::npos);
}

}  // namespace
}  // namespace telestrain
