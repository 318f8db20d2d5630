// The passes give the same whatever instruction set and threads they run with.
#include <gtest/gtest.h>

#include "correlation/kernels.h"
#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

using correlation::SetVectorLevel;
using correlation::VectorLevel;

constexpr int kSide = 220;
const PixelRegion kRegion{0, 0, kSide, kSide};
const Eigen::Vector2d kAbout = kRegion.Middle();

class VectorLevels : public testing::TestWithParam<std::tuple<int, Interpolation, bool>> {
 protected:
  ~VectorLevels() override { SetVectorLevel(correlation::BestVectorLevel()); }

  // Small, rotated and large gradients take different ways through the interpolation.
  static std::vector<ShapeFunction> Maps() {
    std::vector<ShapeFunction> maps(4);
    for (auto& map : maps) map.displacement_px = {0.31, -0.42};
    maps[1].gradient << 5e-4, 2e-4, -3e-4, -2e-4;
    maps[2].gradient << 0, -0.0174, 0.0174, 0;
    maps[3].gradient << -0.3, 0.1, 0.05, 0.1;
    return maps;
  }

  std::vector<SubsetMatch> Run(VectorLevel level, int threads) const {
    EXPECT_TRUE(SetVectorLevel(level));
    const auto [order, interpolation, masked] = GetParam();
    const CorrelationOptions options{
        .subset_px = 61, .shape_order = order, .interpolation = interpolation, .threads = threads};
    const Speckle speckle(11, kSide, kSide);
    PixelMask mask{kSide, kSide, std::vector<unsigned char>(kSide * kSide, 1)};
    for (int k = 0; k < kSide; ++k)
      for (int y = 80; y < 110; ++y) mask.inside[y * kSide + k] = k < 100;
    const CorrelationReference reference(speckle.Render(kSide, kSide), kRegion, options,
                                         masked ? &mask : nullptr);
    std::vector<SubsetMatch> matches;
    for (const ShapeFunction& map : Maps()) {
      const PreparedImage image(speckle.Render(kSide, kSide, map, kAbout), kRegion, options);
      for (const Eigen::Vector2i& center : {Eigen::Vector2i(110, 108), Eigen::Vector2i(97, 120)})
        matches.push_back(reference.Match(center, image, TruthAt(map, kAbout, center), threads));
    }
    return matches;
  }
};

void ExpectSameBits(const std::vector<SubsetMatch>& a, const std::vector<SubsetMatch>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].status, b[i].status) << i;
    EXPECT_EQ(a[i].iterations, b[i].iterations) << i;
    EXPECT_EQ(a[i].zncc, b[i].zncc) << i;
    EXPECT_EQ(a[i].shape.displacement_px, b[i].shape.displacement_px) << i;
    EXPECT_EQ(a[i].shape.gradient, b[i].shape.gradient) << i;
    EXPECT_EQ(a[i].shape.curvature_per_px, b[i].shape.curvature_per_px) << i;
    EXPECT_EQ(a[i].covariance, b[i].covariance) << i;
    EXPECT_EQ(a[i].sssig, b[i].sssig) << i;
  }
}

TEST_P(VectorLevels, Avx2AndAvx512GiveTheSameBits) {
  if (correlation::BestVectorLevel() != VectorLevel::kAvx512) GTEST_SKIP() << "no AVX-512 here";
  ExpectSameBits(Run(VectorLevel::kAvx2, 1), Run(VectorLevel::kAvx512, 1));
}

// Without fused operations only the last digits differ: 1e-6 px is a hundredth of what the
// iterations are ended at.
TEST_P(VectorLevels, ThePlainLevelAgrees) {
  const auto plain = Run(VectorLevel::kPlain, 1), best = Run(correlation::BestVectorLevel(), 1);
  for (std::size_t i = 0; i < best.size(); ++i) {
    EXPECT_EQ(plain[i].status, best[i].status);
    if (!best[i].ok()) continue;  // a shift alone does not fit the large gradients
    const Eigen::Vector2d way = plain[i].shape.displacement_px - best[i].shape.displacement_px;
    EXPECT_LT(way.norm(), 1e-6) << i;
  }
}

TEST_P(VectorLevels, ThreadsThatShareTheRowsChangeNoBit) {
  const auto one = Run(correlation::BestVectorLevel(), 1);
  ExpectSameBits(one, Run(correlation::BestVectorLevel(), 2));
  ExpectSameBits(one, Run(correlation::BestVectorLevel(), 3));
}

INSTANTIATE_TEST_SUITE_P(All, VectorLevels,
                         testing::Combine(testing::Values(0, 1, 2),
                                          testing::Values(Interpolation::kCubic,
                                                          Interpolation::kQuintic),
                                          testing::Bool()));

// The fast ways of the interpolation against the plain formula: warped moments of one pixel rows
// are grey levels, here taken from Sample.
TEST(WarpedMoments, AgreeWithTheInterpolatedGreyLevels) {
  const Speckle speckle(12, kSide, kSide);
  for (const Interpolation interpolation : {Interpolation::kCubic, Interpolation::kQuintic}) {
    const CorrelationOptions options{.subset_px = 33,
                                     .interpolation = interpolation,
                                     .max_iterations = 1,
                                     .convergence_px = 100};
    const CorrelationReference reference(speckle.Render(kSide, kSide), kRegion, options);
    const PreparedImage image(speckle.Render(kSide, kSide), kRegion, options);
    for (const double slope : {0.0, 3e-4, 1.5e-3, 0.012, 0.2}) {
      ShapeFunction shape;
      shape.displacement_px = {0.97, 0.03};
      shape.gradient << slope, -slope, 0.7 * slope, slope;
      const SubsetMatch match = reference.Match({110, 110}, image, shape);
      double f = 0, t = 0, ff = 0, tt = 0, ft = 0;
      for (int y = -16; y <= 16; ++y) {
        for (int x = -16; x <= 16; ++x) {
          const Eigen::Vector2d d(x, y);
          const Eigen::Vector2d at = d + shape.displacement_px + shape.gradient * d;
          const double a = PreparedImage(image).Sample(110 + x, 110 + y);
          const double b = image.Sample(110 + at.x(), 110 + at.y());
          f += a, t += b, ff += a * a, tt += b * b, ft += a * b;
        }
      }
      const double n = 33 * 33;
      const double zncc = (ft - f * t / n) / std::sqrt((ff - f * f / n) * (tt - t * t / n));
      EXPECT_NEAR(match.zncc, zncc, 3e-6) << slope;  // floats of 128 have steps of 8e-6
    }
  }
}

}  // namespace
}  // namespace telestrain
