// Orders 0, 1 and 2 of the shape function on exact images of quadratic maps.
#include <gtest/gtest.h>

#include "correlation/subset_algebra.h"
#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kSide = 160;
const PixelRegion kRegion{0, 0, kSide, kSide};
const Eigen::Vector2i kCenter{80, 80};

Eigen::Vector2d Mapped(const ShapeFunction& map, const Eigen::Vector2d& d) {
  return d + map.displacement_px + map.gradient * d +
         map.curvature_per_px *
             Eigen::Vector3d(d.x() * d.x() / 2, d.x() * d.y(), d.y() * d.y() / 2);
}

// The pattern after a quadratic map about the centre, inverted by fixed-point steps.
GrayImage RenderMapped(const Speckle& speckle, const ShapeFunction& map) {
  const Eigen::Vector2d about = kCenter.cast<double>();
  GrayImage image{kSide, kSide, 255, {}};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Eigen::Vector2d to = Eigen::Vector2d(x, y) - about;
      Eigen::Vector2d from = to;
      for (int step = 0; step < 12; ++step) from += to - Mapped(map, from);
      image.pixels.push_back(static_cast<float>(speckle.At(about + from)));
    }
  return image;
}

SubsetMatch MatchMapped(const ShapeFunction& map, int order) {
  const CorrelationOptions options{.subset_px = 61, .shape_order = order};
  const Speckle speckle(31, kSide, kSide);
  const CorrelationReference reference(speckle.Render(kSide, kSide), kRegion, options);
  ShapeFunction start;
  start.displacement_px = map.displacement_px + Eigen::Vector2d(0.3, -0.2);
  return reference.Match(kCenter, {RenderMapped(speckle, map), kRegion, options}, start);
}

ShapeFunction Bent() {
  ShapeFunction map;
  map.displacement_px = {0.37, -0.61};
  map.gradient << 0.004, -0.002, 0.003, -0.001;
  map.curvature_per_px << 4e-4, -2e-4, 3e-4, -1e-4, 3e-4, -4e-4;
  return map;
}

// What interpolation costs a single point is below 1 mpx (accuracy_test.cpp), here at the subset's
// edge, 30 px from the centre; the curvature of the map is worth 180 mpx there.
TEST(ShapeOrder, TheSecondFindsGradientsAndCurvature) {
  const ShapeFunction map = Bent();
  const SubsetMatch match = MatchMapped(map, 2);
  ASSERT_TRUE(match.ok()) << ToText(match.status);
  EXPECT_LT((match.shape.displacement_px - map.displacement_px).norm(), 1e-3);
  EXPECT_LT((match.shape.gradient - map.gradient).norm(), 1e-3 / 30);
  EXPECT_LT((match.shape.curvature_per_px - map.curvature_per_px).norm(), 2 * 1e-3 / (30 * 30));
  EXPECT_GT(match.zncc, 0.99999);
}

TEST(ShapeOrder, LowerOrdersLeaveWhatTheyDoNotHaveAtZero) {
  ShapeFunction shift;
  shift.displacement_px = {0.37, -0.61};
  for (int order : {0, 1, 2}) {
    const SubsetMatch match = MatchMapped(shift, order);
    ASSERT_TRUE(match.ok()) << order;
    EXPECT_LT((match.shape.displacement_px - shift.displacement_px).norm(), 3e-4) << order;
    EXPECT_EQ(match.shape.curvature_per_px.isZero(0), order < 2);
    EXPECT_EQ(match.shape.gradient.isZero(0), order < 1);
  }
  EXPECT_LT(MatchMapped(Bent(), 1).zncc, MatchMapped(Bent(), 2).zncc);
}

// Shift and curvature are correlated: the variance of u grows with the order, for a homogeneous
// pattern by 1 + 5/4 + 5/4 as the least squares of a parabola over a square say. A real pattern is
// not homogeneous: half as much again or less is let pass.
TEST(ShapeOrder, TheSecondPaysForCurvatureInNoise) {
  const CorrelationOptions options{.subset_px = 61};
  const Speckle speckle(32, kSide, kSide);
  std::mt19937 random(33);
  GrayImage before = speckle.Render(kSide, kSide), after = before;
  AddNoise(2, random, before);
  AddNoise(2, random, after);
  double variance[3];
  for (int order : {0, 1, 2}) {
    CorrelationOptions of_order = options;
    of_order.shape_order = order;
    const CorrelationReference reference(before, kRegion, of_order);
    const SubsetMatch match = reference.Match(kCenter, {after, kRegion, of_order}, {});
    ASSERT_TRUE(match.ok());
    variance[order] = match.covariance(0, 0);
  }
  EXPECT_NEAR(variance[1] / variance[0], 1, 0.1);
  EXPECT_GT(variance[2] / variance[1], 3.5 / 1.5);
  EXPECT_LT(variance[2] / variance[1], 3.5 * 1.5);
}

template <int kOrder>
void ExpectComposedWithItselfIsIdentity() {
  using Algebra = correlation::StepAlgebra<kOrder>;
  typename Algebra::Vector step = Algebra::Vector::LinSpaced(1e-4, 5e-4);
  ShapeFunction shape;  // the step as a shape
  const double half = 20;
  for (int row = 0; row < 2; ++row) {
    const auto part = step.template segment<Algebra::kBasis>(row * Algebra::kBasis);
    shape.displacement_px[row] = part[0];
    for (int k = 1; k < Algebra::kBasis; ++k)
      (k < 3 ? shape.gradient(row, k - 1) : shape.curvature_per_px(row, k - 3)) =
          part[k] / (k < 3 ? half : half * half);
  }
  const ShapeFunction none = Algebra::Compose(shape, step, half);
  EXPECT_LT(none.displacement_px.norm(), 1e-15);
  EXPECT_LT(none.gradient.norm(), 1e-15);
  EXPECT_LT(none.curvature_per_px.norm(), 1e-15);
}

TEST(ShapeOrder, AShapeAfterItsOwnInverseIsTheIdentity) {
  ExpectComposedWithItselfIsIdentity<0>();
  ExpectComposedWithItselfIsIdentity<1>();
  ExpectComposedWithItselfIsIdentity<2>();
}

}  // namespace
}  // namespace telestrain
