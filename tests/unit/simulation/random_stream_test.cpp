#include "simulation/random_stream.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/sensor_readout.h"

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

GrayImage Flat(float gray) { return {500, 401, 255, std::vector<float>(500 * 401, gray)}; }

void ExpectNoise(const GrayImage& image, double mean_level, double sd_levels) {
  double sum = 0, squares = 0;
  for (const float level : image.pixels) {
    sum += level - mean_level;
    squares += (level - mean_level) * (level - mean_level);
  }
  const auto n = static_cast<double>(image.pixels.size());
  const double mean = sum / n;
  EXPECT_NEAR(mean, 0, 4 * sd_levels / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n - mean * mean), sd_levels, 4 * sd_levels / std::sqrt(2 * n));
}

TEST(ReadOut, NoiseAndQuantisationAddUpToTheWantedNoise) {
  ExpectNoise(ReadOut(Flat(100.3F), 1.5, 8, 42), 100.3F, 1.5);
  ExpectNoise(ReadOut(Flat(37.8F), 0.8, 8, 42), 37.8F, 0.8);
  ExpectNoise(ReadOut(Flat(100.3F), 1.5, 16, 42), 257 * double(100.3F), 257 * 1.5);
}

TEST(ReadOut, WithoutNoiseRoundsAndClips) {
  EXPECT_EQ(ReadOut(Flat(100.3F), 0, 8, 1).At(3, 4), 100);
  EXPECT_EQ(ReadOut(Flat(100.5F), 0, 8, 1).At(3, 4), 101);
  EXPECT_EQ(ReadOut(Flat(300), 0, 8, 1).At(3, 4), 255);
  EXPECT_EQ(ReadOut(Flat(-5), 0, 8, 1).At(3, 4), 0);
  EXPECT_EQ(ReadOut(Flat(100), 0, 16, 1).At(3, 4), 25700);
  EXPECT_EQ(ReadOut(Flat(100), 0, 16, 1).max_gray, 65535);
}

}  // namespace
}  // namespace telestrain
