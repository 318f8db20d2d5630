#include "geometry/mirror.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace telestrain {
namespace {

using Eigen::Vector3d;

Vector3d RandomVector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  const double x = uniform(random), y = uniform(random), z = uniform(random);
  return {x, y, z};
}

Mirror RandomMirror(std::mt19937& random) {
  return {RandomVector(random, 50), RandomVector(random, 1).normalized()};
}

// Points of up to 200 mm after some reflections: 1e-12 is a hundred roundings of 200 x 2^-53.
constexpr double kRounding_mm = 1e-12;

TEST(MirrorTest, ReflectingTwiceIsTheIdentity) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Mirror mirror = RandomMirror(random);
    const Vector3d point = RandomVector(random, 100), direction = RandomVector(random, 1);
    EXPECT_LT((mirror.ReflectPoint(mirror.ReflectPoint(point)) - point).norm(), kRounding_mm);
    EXPECT_LT((mirror.ReflectDirection(mirror.ReflectDirection(direction)) - direction).norm(),
              1e-14);
  }
}

TEST(MirrorTest, PointsOfTheMirrorStayAndTheOthersChangeSides) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const Mirror mirror = RandomMirror(random);
    const Vector3d point = RandomVector(random, 100);
    const double height_mm = mirror.normal.dot(point - mirror.point_mm);
    const Vector3d foot = point - height_mm * mirror.normal;
    EXPECT_LT((mirror.ReflectPoint(foot) - foot).norm(), kRounding_mm);
    const Vector3d reflected = mirror.ReflectPoint(point);
    EXPECT_NEAR(mirror.normal.dot(reflected - mirror.point_mm), -height_mm, kRounding_mm);
    EXPECT_LT((0.5 * (reflected + point) - foot).norm(), kRounding_mm);
  }
}

TEST(MirrorTest, KeepsDistancesAndTurnsHandednessOver) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const Mirror mirror = RandomMirror(random);
    const Vector3d a = RandomVector(random, 100), b = RandomVector(random, 100);
    EXPECT_NEAR((mirror.ReflectPoint(a) - mirror.ReflectPoint(b)).norm(), (a - b).norm(),
                kRounding_mm);
    const Vector3d x = mirror.ReflectDirection(Vector3d::UnitX());
    const Vector3d y = mirror.ReflectDirection(Vector3d::UnitY());
    const Vector3d z = mirror.ReflectDirection(Vector3d::UnitZ());
    EXPECT_NEAR(x.cross(y).dot(z), -1, 1e-14);
  }
}

TEST(MirrorTest, TheSideOfTheNormalDoesNotMatter) {
  std::mt19937 random(4);
  const Mirror mirror = RandomMirror(random);
  const Mirror turned{mirror.point_mm, -mirror.normal};
  const Vector3d point = RandomVector(random, 100);
  EXPECT_EQ(mirror.ReflectPoint(point), turned.ReflectPoint(point));
  EXPECT_EQ(mirror.ReflectDirection(point), turned.ReflectDirection(point));
}

}  // namespace
}  // namespace telestrain
