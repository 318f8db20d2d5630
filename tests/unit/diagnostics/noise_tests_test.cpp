#include "diagnostics/noise_tests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "diagnostics/noise_moran.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::Random;

constexpr int kColumns = 13, kRows = 9, kViews = 4, kImages = 6;

// Boards of 62 px squares somewhere in their view, with residuals of pure noise of 0.1 px.
ResidualList PureNoise(std::uint64_t seed, int images = kImages) {
  Random random(seed);
  ResidualList list;
  for (int image = 0; image < images; ++image)
    for (int view = 0; view < kViews; ++view) {
      const Eigen::Vector2d start(random.Uniform(100, 400), random.Uniform(100, 300));
      for (int corner = 0; corner < kColumns * kRows; ++corner) {
        CornerResidual r{image, view, view / 2, corner};
        r.observed_px = start + 62 * Eigen::Vector2d(corner % kColumns, corner / kColumns);
        r.whitened = {random.Normal(1), random.Normal(1)};
        r.residual_px = 0.1 * r.whitened;
        list.push_back(r);
      }
    }
  return list;
}

int Degrees(const ResidualList& list) { return 2 * static_cast<int>(list.size()); }

NoiseReport Tested(const ResidualList& list) { return TestNoise(list, Degrees(list), kColumns); }

// Adds a residual to every corner.
template <typename Pattern>
ResidualList Planted(Pattern pattern, std::uint64_t seed = 1) {
  ResidualList list = PureNoise(seed);
  for (CornerResidual& r : list) {
    r.whitened += pattern(r);
    r.residual_px = 0.1 * r.whitened;
  }
  return list;
}

// The test that finds most.
SpatialTest Strongest(const NoiseReport& report) {
  return *std::min_element(
      report.spatial.begin(), report.spatial.end(),
      [](const SpatialTest& a, const SpatialTest& b) { return a.p_value < b.p_value; });
}

TEST(MoransI, IsMinusOneOnARingOfAlternatingValues) {
  const std::vector<std::pair<int, int>> ring = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  const MoranStatistic m = MoransI({1, -1, 1, -1}, ring);
  EXPECT_DOUBLE_EQ(m.i, -1);
  EXPECT_DOUBLE_EQ(m.expected, -1.0 / 3);
  // Four values: S0 = 8, S1 = 16, S2 = 64; (16 16 - 4 64 + 3 64) / (15 64) - 1 / 9 = 4 / 45.
  EXPECT_NEAR(m.z, (-1 + 1.0 / 3) / std::sqrt(4.0 / 45), 1e-12);
  EXPECT_EQ(MoransI({1, 1, 1, 1}, ring).z, 0);
}

TEST(TestNormality, KnowsTheNormalAndTheUniformDistribution) {
  Random random(3);
  std::vector<double> normal, uniform, contaminated;
  for (int i = 0; i < 4000; ++i) {
    normal.push_back(random.Normal(2) + 7);
    uniform.push_back(random.Uniform(0, 1));
    contaminated.push_back(random.Normal(i % 20 == 0 ? 4 : 1));
  }
  EXPECT_GT(TestNormality(normal).p_value, 0.01);
  EXPECT_LT(TestNormality(uniform).p_value, 1e-10);
  EXPECT_NEAR(TestNormality(uniform).excess_kurtosis, -1.2, 4 * std::sqrt(24.0 / 4000));
  EXPECT_LT(TestNormality(contaminated).p_value, 1e-10);
  EXPECT_EQ(TestNormality({1, 1, 1}).p_value, 1);
}

TEST(TestNoise, FalseAlarmsKeepWhatTheyState) {
  constexpr int kSets = 300;
  constexpr double kStated = 0.05;
  int spatial = 0, trend = 0, normality = 0, chi_square = 0;
  std::array<int, 3> by_kind{};
  for (int set = 0; set < kSets; ++set) {
    const NoiseReport report = Tested(PureNoise(1000 + static_cast<std::uint64_t>(set)));
    spatial += report.SmallestSpatialP() < kStated;
    trend += report.SmallestTrendP() < kStated;
    normality += report.normality.p_value < kStated;
    chi_square += report.chi_square.p_value < kStated;
    for (const SpatialTest& test : report.spatial) by_kind[test.over] += test.p_value < kStated;
  }
  // Binomial three-sigma bands.
  const auto most = [&](double n) { return kStated * n + 3 * std::sqrt(kStated * 0.95 * n); };
  RecordProperty("spatial", spatial);
  RecordProperty("trend", trend);
  std::cout << "false alarms of " << kSets << " at 0.05: spatial " << spatial << ", trend " << trend
            << ", normality " << normality << ", chi-square " << chi_square << "\n";
  EXPECT_LE(spatial, most(kSets));
  EXPECT_LE(trend, most(kSets));
  EXPECT_LE(normality, most(kSets));
  EXPECT_LE(chi_square, most(kSets));
  for (const int count : by_kind) {
    EXPECT_LE(count, most(kSets * 2 * kViews));
    EXPECT_GE(count, kStated / 2 * kSets * 2 * kViews);  // and are not idle
  }
}

TEST(TestNoise, AThirdOrderPatternInOneViewIsFoundInItsField) {
  const NoiseReport report = Tested(Planted([](const CornerResidual& r) -> Eigen::Vector2d {
    const Eigen::Vector2d p = (r.observed_px - Eigen::Vector2d(620, 450)) / 500;
    return r.view == 2 ? Eigen::Vector2d(2 * (p.squaredNorm() - 0.6) * p) : Eigen::Vector2d::Zero();
  }));
  EXPECT_LT(report.SmallestSpatialP(), 0.002);  // the level of the verdict
  EXPECT_EQ(Strongest(report).view, 2);
}

TEST(TestNoise, APatternOfTheBoardIsFoundOverTheBoard) {
  const NoiseReport report = Tested(Planted([](const CornerResidual& r) -> Eigen::Vector2d {
    const double x = (r.corner % kColumns - 6) / 6.0;
    return r.view < 2 ? Eigen::Vector2d(0, 1.0 * (x * x - 0.4)) : Eigen::Vector2d::Zero();
  }));
  EXPECT_LT(report.SmallestSpatialP(), 0.002);  // the level of the verdict
  EXPECT_LT(Strongest(report).view, 2);
  EXPECT_EQ(Strongest(report).component, 1);
}

TEST(TestNoise, ADriftingViewIsNamedWithItsChange) {
  const NoiseReport report = Tested(Planted([](const CornerResidual& r) -> Eigen::Vector2d {
    return r.view == 1 ? Eigen::Vector2d(0.2 * (r.image - 2.5), 0) : Eigen::Vector2d::Zero();
  }));
  const TrendTest& trend = report.trends[2];
  EXPECT_EQ(trend.view, 1);
  EXPECT_LT(trend.adjusted_p_value, 0.01);
  // 0.2 whitened an image over five steps; 4 sigma.
  EXPECT_NEAR(trend.change_px, 0.1, 4 * trend.sigma_change_px);
  for (const std::size_t other : {0u, 1u, 3u, 4u, 5u, 6u, 7u})
    EXPECT_GT(report.trends[other].adjusted_p_value, 0.01);
}

TEST(TestNoise, OutliersAreNotCounted) {
  ResidualList list = PureNoise(9);
  const NoiseReport without = Tested(list);
  CornerResidual wrong = list.front();
  wrong.residual_px = {1e3, 1e3};
  wrong.whitened = {1e4, 1e4};
  wrong.is_outlier = true;
  list.push_back(wrong);
  const NoiseReport with = TestNoise(list, Degrees(list) - 2, kColumns);
  EXPECT_EQ(with.chi_square.chi2, without.chi_square.chi2);
  EXPECT_EQ(with.normality.statistic, without.normality.statistic);
  EXPECT_EQ(with.SmallestSpatialP(), without.SmallestSpatialP());
}

TEST(TestChiSquare, TellsLargerNoiseThanStated) {
  ResidualList list = PureNoise(4);
  EXPECT_GT(Tested(list).chi_square.p_value, 1e-3);
  for (CornerResidual& r : list) r.whitened *= 1.1;
  const ChiSquareTest test = Tested(list).chi_square;
  EXPECT_LT(test.p_too_large, 1e-10);
  EXPECT_NEAR(test.sigma0, 1.1, 4 * 1.1 / std::sqrt(2.0 * Degrees(list)));
}

}  // namespace
}  // namespace telestrain
