#include "geometry/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace telestrain {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

std::vector<Vector3d> Axes() {
  std::vector<Vector3d> axes;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) axes.push_back(Vector3d(x, y, z).normalized());
  axes.push_back(Vector3d(1e-8, 1, -1e-9).normalized());
  return axes;
}

// From no rotation over the switches to series up to a half turn.
const std::vector<double> kAngles_rad{0,   1e-300, 1e-13, 1e-11, 1e-9,       1e-6,       1e-5,
                                      0.1, 1,      2,     3,     kPi - 1e-7, kPi - 1e-10};

void ExpectProper(const Matrix3d& rotation) {
  EXPECT_LT((rotation * rotation.transpose() - Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_NEAR(rotation.determinant(), 1, 1e-14);
}

TEST(RotationTest, SkewIsTheCrossProduct) {
  const Vector3d a(1, -2, 3), b(0.5, 4, -1);
  EXPECT_EQ(Skew(a) * b, a.cross(b));
  EXPECT_EQ(Skew(a).transpose(), -Skew(a));
}

TEST(RotationTest, ExpIsProperAndTurnsAboutTheVector) {
  for (const Vector3d& axis : Axes()) {
    for (const double angle : kAngles_rad) {
      const Matrix3d rotation = ExpRotation(angle * axis);
      ExpectProper(rotation);
      EXPECT_LT((rotation * axis - axis).norm(), 1e-14);
      const Vector3d across = axis.unitOrthogonal();
      EXPECT_NEAR(axis.dot(across.cross(rotation * across)), std::sin(angle), 1e-14);
      EXPECT_NEAR(across.dot(rotation * across), std::cos(angle), 1e-14);
    }
  }
}

TEST(RotationTest, LogUndoesExp) {
  for (const Vector3d& axis : Axes())
    for (const double angle : kAngles_rad)
      // A matrix holds small angles to its rounding of 2^-53 per entry.
      EXPECT_LT((LogRotation(ExpRotation(angle * axis)) - angle * axis).norm(), 4e-15)
          << angle << " about " << axis.transpose();
}

TEST(RotationTest, LogOfAHalfTurnIsOneOfTheTwo) {
  for (const Vector3d& axis : Axes()) {
    const Vector3d log = LogRotation(ExpRotation(kPi * axis));
    EXPECT_LE(log.norm(), kPi + 1e-15);
    EXPECT_LT(std::min((log - kPi * axis).norm(), (log + kPi * axis).norm()), 4e-15)
        << axis.transpose();
  }
}

TEST(RotationTest, LogIsAtMostAHalfTurn) {
  const Vector3d axis = Vector3d(1, 2, -2) / 3;
  EXPECT_LT((LogRotation(ExpRotation(4 * axis)) - (4 - 2 * kPi) * axis).norm(), 4e-15);
}

TEST(RotationTest, LeftJacobianIsTheDerivativeOfExp) {
  const Vector3d point(0.3, -1.2, 0.7);
  for (const Vector3d& axis : Axes()) {
    for (const double angle : {0.0, 1e-6, 1e-4, 0.3, 2.0, 3.1}) {
      const Vector3d w = angle * axis;
      const Matrix3d analytic = -Skew(ExpRotation(w) * point) * LeftJacobian(w);
      Matrix3d numeric;
      // Central differences: an error of step^2 / 6 x third derivative and of 2^-53 / step.
      constexpr double kStep = 1e-5;
      for (int i = 0; i < 3; ++i) {
        const Vector3d step = kStep * Vector3d::Unit(i);
        numeric.col(i) =
            (ExpRotation(w + step) * point - ExpRotation(w - step) * point) / (2 * kStep);
      }
      EXPECT_LT((analytic - numeric).norm(), 5e-10) << angle << " about " << axis.transpose();
    }
  }
}

TEST(RotationTest, LeftJacobianIsSmoothWhereItsSeriesEnds) {
  const Vector3d axis = Vector3d(2, -1, 2) / 3;
  // 1 + skew / 2 is right to angle^2 / 6 x 2e-5; the closed form cancels to 2^-53 / angle = 1e-11.
  const Matrix3d step = LeftJacobian(1.00001e-5 * axis) - LeftJacobian(0.99999e-5 * axis);
  EXPECT_LT((step - 0.5 * Skew(2e-10 * axis)).norm(), 2e-11);
}

TEST(RotationTest, NearestRotationLeavesRotationsAndMendsNoise) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 1e-3);
  for (const Vector3d& axis : Axes()) {
    const Matrix3d rotation = ExpRotation(2.5 * axis);
    EXPECT_LT((NearestRotation(rotation) - rotation).norm(), 1e-14);
    EXPECT_LT((NearestRotation(3 * rotation) - rotation).norm(), 1e-14);
    const Matrix3d noisy =
        rotation + Matrix3d::NullaryExpr([&](auto, auto) { return noise(random); });
    const Matrix3d nearest = NearestRotation(noisy);
    ExpectProper(nearest);
    // No neighbour is nearer.
    for (const Vector3d& turn : Axes())
      EXPECT_LT((nearest - noisy).norm(), (ExpRotation(1e-3 * turn) * nearest - noisy).norm());
  }
}

TEST(RotationTest, NearestRotationOfAReflectionIsProper) {
  const Matrix3d reflection = Vector3d(1, 1, -0.9).asDiagonal();
  ExpectProper(NearestRotation(reflection));
}

TEST(RotationTest, AngleBetweenIsSymmetricAndExact) {
  for (const Vector3d& axis : Axes()) {
    const Matrix3d a = ExpRotation(Vector3d(0.4, -1, 2));
    const Matrix3d b = ExpRotation(1.3 * axis) * a;
    EXPECT_NEAR(AngleBetween_rad(a, b), 1.3, 1e-14);
    EXPECT_NEAR(AngleBetween_rad(b, a), 1.3, 1e-14);
    EXPECT_NEAR(AngleBetween_rad(a, a), 0, 1e-14);
  }
}

TEST(RotationTest, RowsOfARotationGiveItBack) {
  for (const Vector3d& axis : Axes()) {
    const Matrix3d rotation = ExpRotation(1.1 * axis);
    const Vector3d x = rotation.row(0), y = rotation.row(1);
    EXPECT_LT((RotationFromRows(x, y) - rotation).norm(), 1e-14);
    EXPECT_LT((RotationFromRows(3 * x, 0.5 * y) - rotation).norm(), 1e-14);
  }
}

TEST(RotationTest, SkewRowsShareTheCorrection) {
  constexpr double kLean_rad = 0.02;
  const Vector3d x(1, 0, 0), y(std::sin(kLean_rad), std::cos(kLean_rad), 0);
  const Matrix3d rotation = RotationFromRows(x, y);
  ExpectProper(rotation);
  // Each row turns by half the lean, within their plane.
  EXPECT_NEAR(rotation(0, 1), -std::sin(kLean_rad / 2), 1e-15);
  EXPECT_NEAR(rotation(1, 0), std::sin(kLean_rad / 2), 1e-15);
  EXPECT_LT((rotation.row(2) - Eigen::RowVector3d(0, 0, 1)).norm(), 1e-15);
}

}  // namespace
}  // namespace telestrain
