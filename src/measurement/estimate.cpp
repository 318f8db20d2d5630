#include "measurement/estimate.h"

#include <cmath>
#include <numbers>

#include "base/check.h"

namespace telestrain {
namespace {

// From here on the normal distribution is the same within 1e-3 of the factor at k = 2.
constexpr int kNormalFrom = 2000;

double NormalTwoSided(double t) { return std::erfc(t / std::numbers::sqrt2); }

// P(|T| > t), finite series in the angle atan(t / sqrt(degrees)) (Abramowitz and Stegun 26.7.3-4).
double StudentTwoSided(double t, int degrees) {
  const double angle = std::atan(t / std::sqrt(static_cast<double>(degrees)));
  const double sine = std::sin(angle), cosine = std::cos(angle);
  const bool odd = degrees % 2 == 1;
  double term = odd ? cosine : 1, sum = degrees == 1 ? 0 : term;
  for (int i = odd ? 3 : 2; i <= degrees - 2; i += 2) {
    term *= cosine * cosine * (i - 1.0) / i;
    sum += term;
  }
  if (!odd) return 1 - sine * sum;
  return 1 - 2 / std::numbers::pi * (angle + sine * sum);
}

}  // namespace

double StudentFactor(double coverage_factor, int degrees, int tests) {
  TELESTRAIN_CHECK(coverage_factor >= 0 && coverage_factor <= 10, "a coverage factor of 0 to 10");
  TELESTRAIN_CHECK(tests >= 1, "at least one test");
  const bool normal = degrees <= 0 || degrees >= kNormalFrom;
  if (normal && tests == 1) return coverage_factor;
  const double wanted = NormalTwoSided(coverage_factor) / tests;
  double low = 0, high = 1e6;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    const double tail = normal ? NormalTwoSided(middle) : StudentTwoSided(middle, degrees);
    (tail > wanted ? low : high) = middle;
  }
  return low;
}

double ExpandedUncertainty(const Estimate& estimate, double coverage_factor) {
  return StudentFactor(coverage_factor, estimate.degrees_of_freedom) *
         estimate.standard_uncertainty;
}

bool IsSignificant(const Estimate& estimate, double coverage_factor, int tests) {
  return std::abs(estimate.value) >
         StudentFactor(coverage_factor, estimate.degrees_of_freedom, tests) *
             estimate.standard_uncertainty;
}

}  // namespace telestrain
