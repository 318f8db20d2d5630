// Orders 0, 1 and 2 of the shape function on exact images of quadratic maps.
#include <gtest/gtest.h>

#include "correlation/image_filters.h"
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

// The variance of u from the normal equations of a shape function on given slopes.
double VarianceOfU(const GrayImage& slope_x, const GrayImage& slope_y, int half_px, int order) {
  constexpr int kBasis[] = {1, 3, 6};
  const int size = kBasis[order];
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(2 * size, 2 * size);
  for (int dy = -half_px; dy <= half_px; ++dy)
    for (int dx = -half_px; dx <= half_px; ++dx) {
      const double x = dx / static_cast<double>(half_px), y = dy / static_cast<double>(half_px);
      Eigen::VectorXd basis(6);
      basis << 1, x, y, x * x, x * y, y * y;
      Eigen::VectorXd row(2 * size);
      row << slope_x.At(kCenter.x() + dx, kCenter.y() + dy) * basis.head(size),
          slope_y.At(kCenter.x() + dx, kCenter.y() + dy) * basis.head(size);
      normal += row * row.transpose();
    }
  return normal.inverse()(0, 0);
}

// Shift and curvature are correlated. Where the slopes are the same everywhere, the least squares
// of a parabola over a square of n pixels give u 1 + 2 m2^2 / (m4 - m2^2) times the variance of a
// constant, with m2 = (n^2 - 1) / 12 and m4 = (n^2 - 1) (3 n^2 - 7) / 240: 3.50 for n = 61. On a
// real pattern the ratio is that of the pattern's own slopes, here of the blurred image.
// The noise of the reference, 0.86 in the slopes, shifts the sums of their squares (9.5 rms) by 2 x
// 0.86 / (9.5 x 61) = 0.3 %, those weighted by the basis at most sqrt(5) times as much; two
// variances are divided: 4 sqrt(2) sqrt(5) 0.3 %.
TEST(ShapeOrder, TheSecondPaysForCurvatureInNoise) {
  const Speckle speckle(32, kSide, kSide);
  std::mt19937 random(33);
  const GrayImage clean = speckle.Render(kSide, kSide);
  GrayImage before = clean, after = clean;
  AddNoise(2, random, before);
  AddNoise(2, random, after);
  double variance[3];
  for (int order : {0, 1, 2}) {
    const CorrelationOptions options{.subset_px = 61, .shape_order = order};
    const CorrelationReference reference(before, kRegion, options);
    const SubsetMatch match = reference.Match(kCenter, {after, kRegion, options}, {});
    ASSERT_TRUE(match.ok());
    variance[order] = match.covariance(0, 0);
  }
  const auto blur = correlation::GaussianKernel(CorrelationOptions().prefilter_sigma_px);
  const auto slope = correlation::SlopeKernel(CorrelationOptions().prefilter_sigma_px);
  GrayImage slope_x = clean, slope_y = clean;
  correlation::FilterSeparable(correlation::View(clean, kRegion), slope, blur, kRegion, 1,
                               slope_x.pixels.data(), kSide);
  correlation::FilterSeparable(correlation::View(clean, kRegion), blur, slope, kRegion, 1,
                               slope_y.pixels.data(), kSide);
  double expected[3];
  for (int order : {0, 1, 2}) expected[order] = VarianceOfU(slope_x, slope_y, 30, order);
  EXPECT_NEAR(variance[1] / variance[0] / (expected[1] / expected[0]), 1, 0.038);
  EXPECT_NEAR(variance[2] / variance[1] / (expected[2] / expected[1]), 1, 0.038);
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
