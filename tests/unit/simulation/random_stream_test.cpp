#include "simulation/random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace telestrain {
namespace {

constexpr int kMany = 200000;

TEST(RandomStream, UniformNumbersHaveTheMomentsOfTheUniformDistribution) {
  RandomStream random(7);
  double sum = 0, squares = 0;
  for (int i = 0; i < kMany; ++i) {
    const double value = random.Uniform();
    ASSERT_GE(value, 0);
    ASSERT_LT(value, 1);
    sum += value;
    squares += value * value;
  }
  // 4 sigma: sd of the mean sqrt(1/12/n), of the mean square sqrt(4/45/n).
  EXPECT_NEAR(sum / kMany, 0.5, 4 * std::sqrt(1.0 / 12 / kMany));
  EXPECT_NEAR(squares / kMany, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / kMany));
}

TEST(RandomStream, NormalPairsAreStandardNormalAndUncorrelated) {
  double sum = 0, squares = 0, products = 0, fourth = 0;
  for (int i = 0; i < kMany; ++i) {
    const auto [a, b] = NormalPair(3, i);
    sum += a + b;
    squares += a * a + b * b;
    products += a * b;
    fourth += a * a * a * a + b * b * b * b;
  }
  const double n = 2.0 * kMany;  // 4 sigma: var(x) = 1, var(x^2) = 2, var(x^4) = 96, var(ab) = 1
  EXPECT_NEAR(sum / n, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 4 * std::sqrt(2 / n));
  EXPECT_NEAR(fourth / n, 3, 4 * std::sqrt(96 / n));
  EXPECT_NEAR(products / kMany, 0, 4 / std::sqrt(kMany));
}

TEST(RandomStream, PoissonHasEqualMeanAndVariance) {
  RandomStream random(11);
  double sum = 0, squares = 0;
  for (int i = 0; i < kMany; ++i) {
    const double count = random.Poisson(1.0);
    sum += count;
    squares += count * count;
  }
  const double mean = sum / kMany, variance = squares / kMany - mean * mean;
  EXPECT_NEAR(mean, 1, 4 / std::sqrt(kMany));
  EXPECT_NEAR(variance, 1, 4 * std::sqrt(3.0 / kMany));  // var of the sample variance: mu4 - 1 = 3
}

TEST(RandomStream, KeysAndCountersMatter) {
  EXPECT_NE(CombineKeys(1, 2), CombineKeys(2, 1));
  EXPECT_NE(NormalPair(1, 0)[0], NormalPair(2, 0)[0]);
  EXPECT_NE(NormalPair(1, 0)[0], NormalPair(1, 1)[0]);
  EXPECT_EQ(NormalPair(1, 5)[0], NormalPair(1, 5)[0]);
}

TEST(RandomStream, NormalDeviatesFollowTheNormalDistribution) {
  std::vector<double> deviates;
  for (int i = 0; i < kMany / 2; ++i)
    for (const double deviate : NormalPair(9, i)) deviates.push_back(deviate);
  std::sort(deviates.begin(), deviates.end());
  double largest = 0;
  for (std::size_t i = 0; i < deviates.size(); ++i)
    largest = std::max(largest, std::abs(0.5 * std::erfc(-deviates[i] / std::sqrt(2.0)) -
                                         (static_cast<double>(i) + 0.5) / kMany));
  EXPECT_LT(largest, 1.95 / std::sqrt(kMany));  // Kolmogorov-Smirnov, 0.1 %
}

}  // namespace
}  // namespace telestrain
