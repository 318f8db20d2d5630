#include "measurement/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::MakeSyntheticArray;
using testing_support::Random;
using testing_support::SyntheticArray;

ArrayCalibration TrueCalibration(const SyntheticArray& array) {
  ArrayCalibration calibration;
  calibration.lens = array.lens;
  calibration.lens.distortion = {1e-5, 0, 1e-5, -2e-5, 0};
  calibration.views = array.views;
  return calibration;
}

TEST(Triangulation, ExactPixelsGiveTheExactPoint) {
  const ArrayCalibration array = TrueCalibration(MakeSyntheticArray({}));
  for (double x = -16; x < -11; x += 0.7)
    for (double y = -1.5; y < 1.6; y += 0.5) {
      const Eigen::Vector3d point(x, y, 0.3 * y);
      std::vector<ViewMeasurement> measured;
      for (int v = 0; v < 2; ++v)
        measured.push_back({v, Project(array.lens, array.views[static_cast<std::size_t>(v)], point),
                            Eigen::Matrix2d::Identity()});
      const TriangulatedPoint found = Triangulate(array, measured);
      EXPECT_LT((found.in_array_mm - point).norm(), 1e-10);
      EXPECT_LT(found.residual_px, 1e-8);
    }
}

// MODEL.md Eq. 13: along the bisector 1.414, across it in the stereo plane 0.816, normal to the
// plane 0.707 times the pixel noise in the object, for views 60 degrees apart; and the scatter
// agrees.
TEST(Triangulation, CovarianceIsTheScatter) {
  testing_support::SyntheticOptions options;
  options.view_error_deg = 0;
  const SyntheticArray synthetic = MakeSyntheticArray(options);
  ArrayCalibration array = TrueCalibration(synthetic);
  array.lens.distortion = {};
  const Eigen::Vector3d point(-13.5, 0.4, 0.1);
  constexpr int kTrials = 4000;
  constexpr double kSigma_px = 0.1;
  const double sigma_mm = kSigma_px / array.lens.magnification_px_per_mm;
  Random random(5);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d predicted;
  for (int t = 0; t < kTrials; ++t) {
    std::vector<ViewMeasurement> measured;
    for (int v = 0; v < 2; ++v) {
      Eigen::Vector2d pixel = Project(array.lens, array.views[static_cast<std::size_t>(v)], point);
      pixel += Eigen::Vector2d(random.Normal(kSigma_px), random.Normal(kSigma_px));
      measured.push_back({v, pixel, kSigma_px * kSigma_px * Eigen::Matrix2d::Identity()});
    }
    const TriangulatedPoint found = Triangulate(array, measured);
    const Eigen::Vector3d error = found.in_array_mm - point;
    scatter += error * error.transpose() / kTrials;
    predicted = found.covariance_mm2;
  }
  const Eigen::Vector3d expected = Eigen::Vector3d(0.7071, 0.8165, 1.4142) * sigma_mm;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::sqrt(predicted(i, i)), expected(i), 1e-3 * expected(i));
    // A standard deviation from n trials scatters by 1/sqrt(2n) = 1.1 %; 4 sigma.
    EXPECT_NEAR(std::sqrt(scatter(i, i)), expected(i), 0.045 * expected(i));
  }
}

TEST(Triangulation, OneViewIsABrokenContract) {
  const ArrayCalibration array = TrueCalibration(MakeSyntheticArray({}));
  EXPECT_THROW(Triangulate(array, {{0, {600, 500}, Eigen::Matrix2d::Identity()}}),
               std::logic_error);
}

}  // namespace
}  // namespace telestrain
