#include "measurement/estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "measurement/line_fit.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::Random;

// P(|Z| > 2) = 4.55 %; JCGM 100 Table G.2 has these factors for 95.45 %.
TEST(Estimate, FactorsAreThoseOfTheGuide) {
  for (const auto& [degrees, factor] :
       {std::pair{1, 13.97}, {2, 4.53}, {3, 3.31}, {4, 2.87}, {5, 2.65}, {10, 2.28}, {50, 2.05}})
    EXPECT_NEAR(StudentFactor(2, degrees), factor, 0.005) << degrees;  // printed places
  EXPECT_EQ(StudentFactor(2, 0), 2);
  EXPECT_NEAR(StudentFactor(2, 1999), 2, 1e-2);
}

TEST(Estimate, ManyTestsNeedALargerFactor) {
  // P(|Z| > t) = 4.55 % / 10: t = 2.838.
  const double t = StudentFactor(2, 0, 10);
  EXPECT_NEAR(std::erfc(t / std::sqrt(2.0)), std::erfc(std::sqrt(2.0)) / 10, 1e-12);
  EXPECT_FALSE(IsSignificant({2.5, 1, 0}, 2, 10));
  EXPECT_TRUE(IsSignificant({2.5, 1, 0}, 2));
}

// Pearson's data with York's weights; slope, intercept and their errors of York et al. (2004),
// Table II.
TEST(FitLine, ReproducesYorksTable) {
  const double x[] = {0, .9, 1.8, 2.6, 3.3, 4.4, 5.2, 6.1, 6.5, 7.4};
  const double y[] = {5.9, 5.4, 4.4, 4.6, 3.5, 3.7, 2.8, 2.8, 2.4, 1.5};
  const double wx[] = {1000, 1000, 500, 800, 200, 80, 60, 20, 1.8, 1};
  const double wy[] = {1, 1.8, 4, 8, 20, 20, 70, 70, 100, 500};
  std::vector<LinePoint> points;
  for (int i = 0; i < 10; ++i)
    points.push_back({x[i], y[i], 1 / std::sqrt(wx[i]), 1 / std::sqrt(wy[i])});
  const auto line = FitLine(points);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->slope.value, -0.480533407, 1e-9);
  EXPECT_NEAR(line->intercept.value, 5.47991022, 1e-8);
  EXPECT_NEAR(line->slope.standard_uncertainty, 0.0579850, 1e-6);
  EXPECT_NEAR(line->intercept.standard_uncertainty, 0.294970735, 1e-6);
  EXPECT_NEAR(line->chi2 / 8, 1.48329415, 1e-7);
}

TEST(FitLine, RefusesWhatDoesNotDetermineALine) {
  EXPECT_FALSE(FitLine({{1, 2, 0, 1}}));
  EXPECT_FALSE(FitLine({{1, 2, 0, 1}, {1, 3, 0, 1}}));
  EXPECT_FALSE(FitLine({{1, 2, 0, 1}, {2, 3, 0, 0}}));
  EXPECT_FALSE(FitLine({{1, 2, -1, 1}, {2, 3, 1, 1}}));
}

TEST(FitLine, ScatterBeyondTheStatedUncertaintyWidensIt) {
  std::vector<LinePoint> points;
  for (int i = 0; i < 20; ++i) points.push_back({1.0 * i, i % 2 == 0 ? 1.0 : -1.0, 0, 0.1});
  const auto line = FitLine(points);
  ASSERT_TRUE(line);
  EXPECT_TRUE(line->scatters_more_than_stated);
  EXPECT_EQ(line->slope.degrees_of_freedom, 18);
  // sigma 0.1 over sqrt(sum of squares about 9.5) = 0.1 / 25.8, times the square root of chi2 / 18.
  EXPECT_NEAR(line->slope.standard_uncertainty, 0.1 / std::sqrt(665.0) * std::sqrt(line->chi2 / 18),
              1e-12);
}

// Errors of equal size in both coordinates, where least squares of y on x is flat by
// sigma_x^2 / (sigma_x^2 + variance of x).
TEST(FitLine, StatedIntervalsCoverTheTruth) {
  constexpr int kRuns = 600;
  Random random(11);
  int slope_within = 0, intercept_within = 0;
  double mean_slope = 0;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<LinePoint> points;
    for (int i = 0; i < 12; ++i)
      points.push_back(
          {2.0 * i + 0.5 * random.Normal(1), 3 + 1.1 * 2.0 * i + 0.6 * random.Normal(1), 0.5, 0.6});
    const auto line = FitLine(points);
    ASSERT_TRUE(line);
    mean_slope += line->slope.value / kRuns;
    slope_within += std::abs(line->slope.value - 1.1) < ExpandedUncertainty(line->slope, 2);
    intercept_within +=
        std::abs(line->intercept.value - 3) < ExpandedUncertainty(line->intercept, 2);
  }
  // 95.45 % of 600 = 573, three binomial sigmas 15.3; the few widened by their scatter add to it.
  for (const int within : {slope_within, intercept_within}) {
    EXPECT_GE(within, 557);
    EXPECT_LE(within, 589);
  }
  // sd of a slope 0.034, of the mean of 600 0.0014, four of them.
  EXPECT_NEAR(mean_slope, 1.1, 0.0056);
}

TEST(FitLeastSquares, StatedIntervalsCoverWithFewDegreesOfFreedom) {
  constexpr int kRuns = 600;
  Random random(12);
  int within = 0;
  for (int run = 0; run < kRuns; ++run) {
    Eigen::MatrixXd design(6, 2);
    Eigen::VectorXd values(6);
    for (int i = 0; i < 6; ++i) {
      design.row(i) << 1, i;
      values(i) = 2 - 0.3 * i + 0.2 * random.Normal(1);
    }
    const auto fit = FitLeastSquares(design, values);
    ASSERT_TRUE(fit);
    within += std::abs(fit->coefficients(1) + 0.3) < ExpandedUncertainty(fit->Coefficient(1), 2);
  }
  EXPECT_GE(within, 557);  // as above
  EXPECT_LE(within, 589);
}

TEST(FitLeastSquares, RefusesDependentColumns) {
  Eigen::MatrixXd design(5, 2);
  design << 1, 2, 1, 2, 1, 2, 1, 2, 1, 2;
  EXPECT_FALSE(FitLeastSquares(design, Eigen::VectorXd::Ones(5)));
  EXPECT_FALSE(FitLeastSquares(design.topRows(2), Eigen::VectorXd::Ones(2)));
}

}  // namespace
}  // namespace telestrain
