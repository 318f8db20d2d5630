#include "diagnostics/noise_distributions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/model_choice.h"

namespace telestrain {
namespace {

// Quantiles of Abramowitz and Stegun's tables 26.8 to 26.10 with more digits; their slopes are of
// the order of the tail itself, so that seven digits of a quantile give 1e-7.
TEST(NoiseDistributions, GiveTheTablesTails) {
  EXPECT_NEAR(NormalUpperTail(1.9599640), 0.025, 1e-7);
  EXPECT_NEAR(ChiSquareUpperTail(3.8414588, 1), 0.05, 1e-7);
  EXPECT_NEAR(ChiSquareUpperTail(2.7055435, 1), 0.10, 1e-7);
  EXPECT_NEAR(ChiSquareUpperTail(18.3070381, 10), 0.05, 1e-7);
  EXPECT_NEAR(ChiSquareUpperTail(3.9402991, 10), 0.95, 1e-7);
  EXPECT_NEAR(FUpperTail(4.9646027, 1, 10), 0.05, 1e-7);
  EXPECT_NEAR(FUpperTail(3.3258345, 5, 10), 0.05, 1e-7);
  EXPECT_NEAR(StudentTwoSided(2.2281389, 10), 0.05, 1e-7);
  EXPECT_NEAR(StudentTwoSided(-2.2281389, 10), 0.05, 1e-7);
}

TEST(NoiseDistributions, ChiSquareEqualsItsFiniteSeries) {
  for (const int degrees : {1, 2, 7, 30, 200})
    for (const double ratio : {0.3, 0.9, 1.0, 1.2, 3.0})
      // Alternating rounding of a few hundred terms.
      EXPECT_NEAR(
          ChiSquareUpperTail(ratio * degrees, degrees) / ChiSquareTail(ratio * degrees, degrees), 1,
          1e-9);
}

TEST(NoiseDistributions, HoldForThousandsOfDegrees) {
  // Wilson and Hilferty's cube root is right to about 1 / degrees there.
  for (const double z : {-3.0, -1.0, 0.0, 1.0, 3.0}) {
    const double n = 33000, cube = 1 - 2 / (9 * n) + z * std::sqrt(2 / (9 * n));
    EXPECT_NEAR(ChiSquareUpperTail(n * cube * cube * cube, n), NormalUpperTail(z), 3e-5);
    EXPECT_NEAR(FUpperTail(2.0 + z / 2, 6, 1e7) / ChiSquareUpperTail(6 * (2.0 + z / 2), 6), 1,
                1e-4);
  }
}

TEST(NoiseDistributions, FIsTheSameFromBothSides) {
  for (const double f : {0.2, 1.0, 2.5})
    EXPECT_NEAR(FUpperTail(f, 7, 40) + FUpperTail(1 / f, 40, 7), 1, 1e-12);
}

TEST(HolmAdjusted, MultipliesTheSmallestMost) {
  const auto adjusted = HolmAdjusted({0.04, 0.01, 0.03, 0.5});
  EXPECT_DOUBLE_EQ(adjusted[1], 0.04);
  EXPECT_DOUBLE_EQ(adjusted[2], 0.09);
  EXPECT_DOUBLE_EQ(adjusted[0], 0.09);  // 0.08, but not before a smaller one
  EXPECT_DOUBLE_EQ(adjusted[3], 0.5);
}

}  // namespace
}  // namespace telestrain
