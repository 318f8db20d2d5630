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
  calibration.lenses = {array.lens};
  calibration.lenses.front().distortion = {1e-5, 0, 1e-5, -2e-5, 0};
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
        measured.push_back(
            {v, Project(array.lenses.front(), array.views[static_cast<std::size_t>(v)], point),
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
  array.lenses.front().distortion = {};
  const Eigen::Vector3d point(-13.5, 0.4, 0.1);
  constexpr int kTrials = 4000;
  constexpr double kSigma_px = 0.1;
  const double sigma_mm = kSigma_px / array.lenses.front().magnification_px_per_mm;
  Random random(5);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d predicted;
  for (int t = 0; t < kTrials; ++t) {
    std::vector<ViewMeasurement> measured;
    for (int v = 0; v < 2; ++v) {
      Eigen::Vector2d pixel =
          Project(array.lenses.front(), array.views[static_cast<std::size_t>(v)], point);
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

// A lens of its own for every view, none of them quite telecentric or square.
ArrayCalibration LeaningCalibration() {
  ArrayCalibration array = TrueCalibration(MakeSyntheticArray({}));
  array.lenses.assign(4, array.lenses.front());
  for (std::size_t v = 0; v < 4; ++v) {
    array.lenses[v].magnification_px_per_mm *= 1 + 0.001 * static_cast<double>(v);
    array.lenses[v].aspect = 1.002 - 0.003 * static_cast<double>(v);
    array.lenses[v].telecentricity_per_mm = v % 2 == 0 ? 2e-4 : -1e-3;
  }
  return array;
}

std::vector<ViewMeasurement> See(const ArrayCalibration& array, const Eigen::Vector3d& point) {
  return {{2, array.Project(2, point), Eigen::Matrix2d::Identity()},
          {3, array.Project(3, point), Eigen::Matrix2d::Identity()}};
}

TEST(Triangulation, ExactPixelsOfLeaningLensesGiveTheExactPoint) {
  const ArrayCalibration array = LeaningCalibration();
  for (double x = 11; x < 16; x += 0.7)
    for (const double z : {-2.0, 0.0, 1.5}) {
      const Eigen::Vector3d point(x, 0.1 * x - 1, z);
      const TriangulatedPoint found = Triangulate(array, See(array, point));
      EXPECT_LT((found.in_array_mm - point).norm(), 1e-10);
      EXPECT_LT(found.residual_px, 1e-8);
    }
}

TEST(Triangulation, CovarianceOfLeaningLensesIsThatOfThePixels) {
  ArrayCalibration array = LeaningCalibration();
  for (TelecentricLens& lens : array.lenses) lens.distortion = {};
  auto measured = See(array, {13.2, -0.4, 1});
  measured[0].covariance_px2 << 2, 0.5, 0.5, 1;
  constexpr double kStep_px = 0.01;
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < measured.size(); ++i) {
    Eigen::Matrix<double, 3, 2> by_pixel;
    for (int axis = 0; axis < 2; ++axis) {
      auto up = measured, down = measured;
      up[i].pixel(axis) += kStep_px;
      down[i].pixel(axis) -= kStep_px;
      by_pixel.col(axis) =
          (Triangulate(array, up).in_array_mm - Triangulate(array, down).in_array_mm) /
          (2 * kStep_px);
    }
    expected += by_pixel * measured[i].covariance_px2 * by_pixel.transpose();
  }
  const Eigen::Matrix3d stated = Triangulate(array, measured).covariance_mm2;
  // The second order of the step: kappa times a pixel's 4e-5 mm; rounding 1e-15 / 4e-5.
  EXPECT_LT((stated - expected).norm(), 1e-7 * expected.norm());
}

TEST(Triangulation, OneViewIsABrokenContract) {
  const ArrayCalibration array = TrueCalibration(MakeSyntheticArray({}));
  EXPECT_THROW(Triangulate(array, {{0, {600, 500}, Eigen::Matrix2d::Identity()}}),
               std::logic_error);
}

}  // namespace
}  // namespace telestrain
