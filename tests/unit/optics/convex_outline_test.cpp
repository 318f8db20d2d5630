#include "optics/convex_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace telestrain {
namespace {

using Eigen::Vector2d;

TEST(ConvexOutline, HullHoldsItsPointsAndAddsNone) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-5, 5);
  for (int round = 0; round < 50; ++round) {
    std::vector<Vector2d> points;
    for (int i = 0; i < 30; ++i) {
      const double x = uniform(random), y = uniform(random);
      points.emplace_back(x, y);
    }
    const ConvexOutline hull = HullOf(points);
    EXPECT_GT(AreaOf_mm2(hull), 0) << "not counter-clockwise";
    ConvexOutline wider = hull;  // a point on the edge may round to either side
    for (Vector2d& corner : wider) corner += 1e-12 * (corner - MiddleOf(hull));
    for (const Vector2d& point : points) EXPECT_TRUE(Contains(wider, point));
    for (const Vector2d& corner : hull)
      EXPECT_NE(std::find(points.begin(), points.end(), corner), points.end());
  }
}

TEST(ConvexOutline, ACutSharesTheAreaBetweenItsSides) {
  const ConvexOutline rectangle = RectangleOutline({-2, -1}, {4, 3});
  for (int i = 0; i < 24; ++i) {
    const double angle = 2 * std::numbers::pi * i / 24;
    const Vector2d inward(std::cos(angle), std::sin(angle)), on_line(0.7, 1.1);
    const double kept = AreaOf_mm2(CutAt(rectangle, on_line, inward));
    const double other = AreaOf_mm2(CutAt(rectangle, on_line, -inward));
    EXPECT_NEAR(kept + other, 24, 1e-13);  // rounding of 24
    EXPECT_GT(kept, 0);
  }
  EXPECT_TRUE(CutAt(rectangle, {9, 0}, {1, 0}).empty());
  EXPECT_EQ(CutAt(rectangle, {-9, 0}, {1, 0}), rectangle);
}

TEST(ConvexOutline, IntersectionIsWhatBothContain) {
  const ConvexOutline a = RectangleOutline({0, 0}, {4, 2}), b = RectangleOutline({3, -1}, {6, 1});
  EXPECT_NEAR(AreaOf_mm2(Intersection(a, b)), 1, 1e-14);
  EXPECT_NEAR(AreaOf_mm2(Intersection(b, a)), 1, 1e-14);
  EXPECT_NEAR(AreaOf_mm2(Intersection(a, a)), 8, 1e-14);
  EXPECT_TRUE(Intersection(a, RectangleOutline({5, 5}, {6, 6})).empty());
  EXPECT_TRUE(Intersection(a, {}).empty());
}

}  // namespace
}  // namespace telestrain
