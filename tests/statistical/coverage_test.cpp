// Do stated uncertainties hold? 400 calibrations of one instrument, each with fresh chance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "statistical/repeated_calibration.h"

namespace telestrain::testing_support {
namespace {

class Coverage : public ::testing::Test {
 protected:
  static const RepeatedCalibrations& All() {
    static const RepeatedCalibrations all = RepeatCalibration(kOptions);
    return all;
  }
  static constexpr RepeatOptions kOptions{};
};

double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// A name that GoogleTest's report can carry.
std::string NameOf(std::string quantity) {
  std::replace(quantity.begin(), quantity.end(), ' ', '_');
  return quantity;
}

// A fraction p of N independent trials scatters by sqrt(p (1 - p) / N); 3 sigma of it.
double BinomialBand(double p, std::size_t count) {
  return 3 * std::sqrt(p * (1 - p) / static_cast<double>(count));
}

TEST_F(Coverage, NinetyFivePercentIntervalsCoverNinetyFivePercent) {
  ASSERT_EQ(All().errors.size(), 2u + 3u * 3u + 1u);
  for (const auto& [quantity, errors] : All().errors) {
    ASSERT_GE(errors.size(), 200u) << quantity;
    double inside = 0;
    for (const StatedError& e : errors) inside += std::abs(e.error) <= 1.959964 * e.sigma;
    EXPECT_NEAR(inside / static_cast<double>(errors.size()), 0.95,
                BinomialBand(0.95, errors.size()))
        << quantity;
    RecordProperty(NameOf(quantity), std::to_string(inside / static_cast<double>(errors.size())));
  }
}

TEST_F(Coverage, StatedSigmasAreThoseOfTheErrors) {
  for (const auto& [quantity, errors] : All().errors) {
    double sum = 0;
    for (const StatedError& e : errors) sum += std::pow(e.error / e.sigma, 2);
    const double count = static_cast<double>(errors.size());
    // The mean square of N normal numbers scatters by sqrt(2 / N); 4 sigma for twelve quantities.
    EXPECT_NEAR(sum / count, 1, 4 * std::sqrt(2 / count)) << quantity;
  }
}

TEST_F(Coverage, ErrorsHaveNoBias) {
  for (const auto& [quantity, errors] : All().errors) {
    double sum = 0;
    for (const StatedError& e : errors) sum += e.error / e.sigma;
    const double count = static_cast<double>(errors.size());
    EXPECT_LT(std::abs(sum / count), 4 / std::sqrt(count)) << quantity;  // 4 sigma of a mean
  }
}

TEST_F(Coverage, TheWeightedSquareSumIsThatOfItsDegreesOfFreedom) {
  const double count = static_cast<double>(All().chi2_per_freedom.size());
  EXPECT_NEAR(Mean(All().chi2_per_freedom), 1, 4 * std::sqrt(2 / (All().freedom * count)));
}

// Seven needless steps are offered, each accepted by chance once in a thousand times.
TEST_F(Coverage, ChanceAddsAsManyParametersAsItsLevelAllows) {
  const double expected = 7e-3 * static_cast<double>(All().rms_px.size());
  EXPECT_LE(All().richer_models, expected + 4 * std::sqrt(expected));  // 4 sigma of a Poisson count
}

TEST_F(Coverage, TheResidualsFollowTheRmsLaw) {
  double mean_square_px2 = 0;
  for (const double rms_px : All().rms_px) mean_square_px2 += rms_px * rms_px;
  const double count = static_cast<double>(All().rms_px.size());
  mean_square_px2 /= count;
  const double law_px2 = std::pow(kOptions.noise_px, 2) * (1 - All().parameters / All().residuals);
  EXPECT_NEAR(mean_square_px2 / law_px2, 1, 4 * std::sqrt(2 / (All().residuals * count)));
}

}  // namespace
}  // namespace telestrain::testing_support
