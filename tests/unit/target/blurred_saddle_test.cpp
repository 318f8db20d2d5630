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

TEST(BlurredSaddle, ValueIsTheBlurOfTwoStepEdges) {
  for (const double rho : {-0.7, -0.3, 0.0, 0.5, 0.75})
    for (const double h : {-3.1, -1.2, 0.0, 0.4, 2.2})
      for (const double k : {-2.5, -0.3, 0.9, 3.7}) {
        const double value = BlurredSaddle(rho).Evaluate(h, k).value;
        // The sum's step (4.5e-4) times the density (0.4) limits the reference near h + t = 0.
        EXPECT_NEAR(value, BruteForce(h, k, rho), 2e-4) << h << " " << k << " " << rho;
      }
}

TEST(BlurredSaddle, DerivativesAreThoseOfTheValue) {
  constexpr double kStep = 1e-4;
  for (const double rho : {-0.6, 0.0, 0.45})
    for (const double h : {-2.0, -0.1, 0.8})
      for (const double k : {-0.7, 0.2, 1.9}) {
        const auto value = [&](double a, double b, double r) {
          return BlurredSaddle(r).Evaluate(a, b).value;
        };
        const SaddleValue e = BlurredSaddle(rho).Evaluate(h, k);
        // Interpolation error 1e-9 over the step, and its square by the third derivative.
        constexpr double kTolerance = 2e-5;
        EXPECT_NEAR(e.by_h, (value(h + kStep, k, rho) - value(h - kStep, k, rho)) / (2 * kStep),
                    kTolerance);
        EXPECT_NEAR(e.by_k, (value(h, k + kStep, rho) - value(h, k - kStep, rho)) / (2 * kStep),
                    kTolerance);
        EXPECT_NEAR(e.by_rho, (value(h, k, rho + kStep) - value(h, k, rho - kStep)) / (2 * kStep),
                    5e-5);
      }
}

TEST(BlurredSaddle, PerpendicularLinesGiveTheProductOfTheEdges) {
  const BlurredSaddle saddle(0);
  for (const double h : {-6.5, -0.3, 0.1, 1.7})
    EXPECT_NEAR(saddle.Evaluate(h, 0.8).value,
                std::erf(h / std::numbers::sqrt2) * std::erf(0.8 / std::numbers::sqrt2), 1e-8);
}

}  // namespace
}  // namespace telestrain
