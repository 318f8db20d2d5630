#include "diagnostics/noise_distributions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/check.h"

namespace telestrain {
namespace {

constexpr int kMaxTerms = 200000;
constexpr double kPrecision = 1e-15;
constexpr double kTiny = 1e-300;

// Value of the continued fraction 1 / (1 + a1 / (1 + a2 / (1 + ...))), by Lentz's method.
template <typename Coefficient>
double ContinuedFraction(Coefficient a) {
  double value = 1, c = 1, d = 0;
  for (int i = 1; i < kMaxTerms; ++i) {
    const double term = a(i);
    d = 1 + term * d;
    c = 1 + term / c;
    d = 1 / (std::abs(d) < kTiny ? kTiny : d);
    if (std::abs(c) < kTiny) c = kTiny;
    value *= c * d;
    if (std::abs(c * d - 1) < kPrecision) break;
  }
  return 1 / value;
}

// The lower incomplete gamma function over x^a e^-x / Gamma(a): A&S 6.5.29.
double GammaSeries(double a, double x) {
  double sum = 1 / a, term = 1 / a;
  for (int i = 1; i < kMaxTerms && term > kPrecision * sum; ++i) {
    term *= x / (a + i);
    sum += term;
  }
  return sum;
}

// The upper one over the same: A&S 6.5.31 in its even form, whose terms shrink faster.
double GammaFraction(double a, double x) {
  double b = x + 1 - a, c = 1 / kTiny, d = 1 / b, value = d;
  for (int i = 1; i < kMaxTerms; ++i) {
    const double term = -i * (i - a);
    b += 2;
    d = 1 / (term * d + b);
    c = b + term / c;
    value *= c * d;
    if (std::abs(c * d - 1) < kPrecision) break;
  }
  return value;
}

// The incomplete beta function I_x(a, b) for x below (a + 1) / (a + b + 2): A&S 26.5.8.
double BetaFraction(double a, double b, double x) {
  const double log_front =
      std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x);
  const auto coefficient = [&](int i) {
    const double m = i / 2;
    if (i % 2 == 0) return m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    return -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
  };
  return std::exp(log_front) * ContinuedFraction(coefficient) / a;
}

double IncompleteBeta(double a, double b, double x) {
  if (!(x > 0)) return 0;
  if (!(x < 1)) return 1;
  if (x < (a + 1) / (a + b + 2)) return BetaFraction(a, b, x);
  return 1 - BetaFraction(b, a, 1 - x);
}

}  // namespace

double NormalUpperTail(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

double ChiSquareUpperTail(double x, double degrees) {
  TELESTRAIN_CHECK(degrees > 0, "chi-square needs a degree of freedom");
  if (!(x > 0)) return 1;
  const double a = degrees / 2, half = x / 2;
  const double front = std::exp(a * std::log(half) - half - std::lgamma(a));
  return half < a + 1 ? 1 - front * GammaSeries(a, half) : front * GammaFraction(a, half);
}

double FUpperTail(double f, double numerator, double denominator) {
  TELESTRAIN_CHECK(numerator > 0 && denominator > 0, "F needs degrees of freedom");
  if (!(f > 0)) return 1;
  return IncompleteBeta(denominator / 2, numerator / 2,
                        denominator / (denominator + numerator * f));
}

double StudentTwoSided(double t, double degrees) {
  TELESTRAIN_CHECK(degrees > 0, "t needs a degree of freedom");
  return IncompleteBeta(degrees / 2, 0.5, degrees / (degrees + t * t));
}

std::vector<double> HolmAdjusted(const std::vector<double>& p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const auto remaining = static_cast<double>(order.size() - rank);
    largest = std::max(largest, std::min(1.0, remaining * p_values[order[rank]]));
    adjusted[order[rank]] = largest;
  }
  return adjusted;
}

}  // namespace telestrain
