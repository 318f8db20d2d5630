#include "target/blurred_saddle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace telestrain {
namespace {

// E[sgn(x) sgn(y)] of two correlated normal numbers with means h, k by a fine sum over the first.
double BruteForce(double h, double k, double rho) {
  constexpr int kSteps = 40000;
  constexpr double kRange = 9;
  const double step = 2 * kRange / kSteps, width = std::sqrt(1 - rho * rho);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = -kRange + (i + 0.5) * step;
    const double density = std::exp(-0.5 * t * t) / std::sqrt(2 * std::numbers::pi);
    sum += density * (h + t > 0 ? 1 : -1) * std::erf((k + rho * t) / (width * std::numbers::sqrt2));
  }
  return sum * step;
}

struct SaddleValue {
  double value, by_h, by_k, by_rho;
};

// At one point, from the last place of a block whose others are elsewhere.
SaddleValue Evaluate(double rho, double h, double k) {
  float hs[kBlock], ks[kBlock];
  for (int i = 0; i < kBlock; ++i) {
    hs[i] = static_cast<float>(h) + 0.25F * static_cast<float>(kBlock - 1 - i);
    ks[i] = static_cast<float>(k) - 0.5F * static_cast<float>(kBlock - 1 - i);
  }
  SaddleBlock at;
  BlurredSaddle(rho).Evaluate(hs, ks, &at);
  constexpr int kLast = kBlock - 1;
  return {at.value[kLast], at.by_h[kLast], at.by_k[kLast], at.by_rho[kLast]};
}

// Abramowitz and Stegun 7.1.26, twice, and a few roundings of floats.
constexpr double kValueError = 2e-6;

TEST(BlurredSaddle, ValueIsTheBlurOfTwoStepEdges) {
  for (const double rho : {-0.7, -0.3, 0.0, 0.5, 0.75})
    for (const double h : {-3.1, -1.2, 0.0, 0.4, 2.2})
      for (const double k : {-2.5, -0.3, 0.9, 3.7}) {
        const double value = Evaluate(rho, h, k).value;
        // The sum's step (4.5e-4) times the density (0.4) limits the reference near h + t = 0.
        EXPECT_NEAR(value, BruteForce(h, k, rho), 2e-4) << h << " " << k << " " << rho;
      }
}

TEST(BlurredSaddle, DerivativesAreThoseOfTheValue) {
  constexpr double kStep = 0.02;
  for (const double rho : {-0.6, 0.0, 0.45})
    for (const double h : {-2.0, -0.1, 0.8})
      for (const double k : {-0.7, 0.2, 1.9}) {
        const auto value = [&](double a, double b, double r) { return Evaluate(r, a, b).value; };
        const SaddleValue e = Evaluate(rho, h, k);
        // The value's error over the step, and the third derivative (at most 3) times step^2 / 6.
        constexpr double kTolerance = kValueError / kStep + 3 * kStep * kStep / 6;
        EXPECT_NEAR(e.by_h, (value(h + kStep, k, rho) - value(h - kStep, k, rho)) / (2 * kStep),
                    kTolerance);
        EXPECT_NEAR(e.by_k, (value(h, k + kStep, rho) - value(h, k - kStep, rho)) / (2 * kStep),
                    kTolerance);
        EXPECT_NEAR(e.by_rho, (value(h, k, rho + kStep) - value(h, k, rho - kStep)) / (2 * kStep),
                    kTolerance);
      }
}

TEST(BlurredSaddle, PerpendicularLinesGiveTheProductOfTheEdges) {
  for (const double h : {-6.5, -0.3, 0.1, 1.7})
    EXPECT_NEAR(Evaluate(0, h, 0.8).value,
                std::erf(h / std::numbers::sqrt2) * std::erf(0.8 / std::numbers::sqrt2),
                kValueError);
}

}  // namespace
}  // namespace telestrain
