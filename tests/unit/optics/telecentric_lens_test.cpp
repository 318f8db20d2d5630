#include "optics/telecentric_lens.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace telestrain {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// A lens whose terms together displace the corners of the field (7.1 mm) by up to 10 %.
std::vector<TelecentricLens> Lenses() {
  const TelecentricLens plain{227.27, {1295.5, 971.5}, {}};
  std::vector<TelecentricLens> lenses(4, plain);
  lenses[1].distortion = {1e-4, 0, 0, 0, 0};
  lenses[2].distortion = {-1e-3, 1e-6, 2e-4, -1e-4, 0};
  lenses[3].distortion = {1.2e-3, -8e-6, -3e-4, 2e-4, 5e-8};
  return lenses;
}

std::vector<Vector2d> Field() {
  std::vector<Vector2d> field;
  for (double x = -5.7; x <= 5.7; x += 0.95)
    for (double y = -4.3; y <= 4.3; y += 0.86) field.push_back({x, y});
  return field;
}

TEST(TelecentricLensTest, UndistortUndoesDistort) {
  for (const TelecentricLens& lens : Lenses()) {
    for (const Vector2d& ideal : Field()) {
      // The header's promise.
      EXPECT_LT((lens.Undistort(lens.Distort(ideal)) - ideal).norm(), 1e-13);
      EXPECT_LT((lens.Distort(lens.Undistort(ideal)) - ideal).norm(), 1e-13);
    }
  }
}

TEST(TelecentricLensTest, PixelsGoThereAndBack) {
  for (const TelecentricLens& lens : Lenses())
    for (const Vector2d& ideal : Field())
      EXPECT_LT((lens.IdealFromPixel(lens.PixelFromIdeal(ideal)) - ideal).norm(), 1e-13);
}

TEST(TelecentricLensTest, JacobianIsTheDerivative) {
  constexpr double kStep_mm = 1e-4;
  for (const TelecentricLens& lens : Lenses()) {
    for (const Vector2d& ideal : Field()) {
      Matrix2d numeric;
      for (int i = 0; i < 2; ++i) {
        const Vector2d step = kStep_mm * Vector2d::Unit(i);
        numeric.col(i) = (lens.Distort(ideal + step) - lens.Distort(ideal - step)) / (2 * kStep_mm);
      }
      // Rounding 7 x 2^-53 / step = 1e-11; truncation step^2 / 6 x third derivative (< 0.05).
      EXPECT_LT((lens.DistortJacobian(ideal) - numeric).norm(), 2e-10);
    }
  }
}

TEST(TelecentricLensTest, WithoutDistortionItIsAScale) {
  const TelecentricLens lens{200, {100, 50}, {}};
  EXPECT_EQ(lens.PixelFromIdeal({0, 0}), Vector2d(100, 50));
  EXPECT_EQ(lens.PixelFromIdeal({0.5, -0.25}), Vector2d(200, 0));
}

TEST(TelecentricLensTest, TermsAreTheEquationsOfTheHeader) {
  TelecentricLens lens;
  const double x = 2, y = -3, r2 = 13;
  lens.distortion = {1e-3, 0, 0, 0, 0};
  EXPECT_TRUE(lens.Distort({x, y}).isApprox(Vector2d(x, y) * (1 + 1e-3 * r2), 1e-15));
  lens.distortion = {0, 1e-5, 0, 0, 0};
  EXPECT_TRUE(lens.Distort({x, y}).isApprox(Vector2d(x, y) * (1 + 1e-5 * r2 * r2), 1e-15));
  lens.distortion = {0, 0, 1e-3, 0, 0};
  EXPECT_TRUE(lens.Distort({x, y}).isApprox(Vector2d(x + 2e-3 * x * y, y + 1e-3 * (r2 + 2 * y * y)),
                                            1e-15));
  lens.distortion = {0, 0, 0, 1e-3, 0};
  EXPECT_TRUE(lens.Distort({x, y}).isApprox(Vector2d(x + 1e-3 * (r2 + 2 * x * x), y + 2e-3 * x * y),
                                            1e-15));
  lens.distortion = {0, 0, 0, 0, 1e-6};
  EXPECT_TRUE(lens.Distort({x, y}).isApprox(Vector2d(x, y) * (1 + 1e-6 * r2 * r2 * r2), 1e-15));
}

}  // namespace
}  // namespace telestrain
