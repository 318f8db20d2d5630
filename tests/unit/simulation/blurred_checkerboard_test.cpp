#include "simulation/blurred_checkerboard.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

namespace telestrain {
namespace {

// The pattern's mean over the blur by brute force, on a grid of +-6 sigma.
double BrightnessByQuadrature(const Eigen::Vector2d& point, const Eigen::Matrix2d& cov) {
  const Eigen::Matrix2d root = cov.llt().matrixL();
  constexpr int kSteps = 600;
  constexpr double kHalf = 6;
  double sum = 0, weights = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const Eigen::Vector2d z(kHalf * ((2.0 * i + 1) / kSteps - 1),
                              kHalf * ((2.0 * j + 1) / kSteps - 1));
      const Eigen::Vector2d p = point + root * z;
      const int column = static_cast<int>(std::floor(p.x() + 2));  // 4 x 3 squares of 1 mm
      const int row = static_cast<int>(std::floor(p.y() + 1.5));
      const bool dark = column >= 0 && column < 4 && row >= 0 && row < 3 && (column + row) % 2 == 0;
      const double weight = std::exp(-z.squaredNorm() / 2);
      sum += weight * (dark ? 0 : 1);
      weights += weight;
    }
  return sum / weights;
}

PlaneBlur InFocus(const Eigen::Matrix2d& cov_mm2) {
  return {{cov_mm2, 0}, Eigen::Matrix2d::Identity(), {0, 0}};
}

TEST(BlurredCheckerboard, AgreesWithQuadratureAtSaddlesEdgesAndBorders) {
  Eigen::Matrix2d cov;
  cov << 0.0064, 0.0035, 0.0035, 0.0049;  // sigma 0.08 and 0.07 mm, correlation 0.62
  const BlurredCheckerboard board(3, 2, 1.0, InFocus(cov));
  for (const auto& [x, y] : {std::pair{0.03, 0.51},
                             {-0.05, 0.45},
                             {1.97, 1.46},
                             {-2.05, -1.52},
                             {0.5, 0.52},
                             {2.04, 0.1},
                             {0.98, -1.55},
                             {1.02, -0.47}})
    // The quadrature's error: jumps between nodes 0.02 sigma apart.
    EXPECT_NEAR(board.Brightness({x, y}, 0), BrightnessByQuadrature({x, y}, cov), 2e-3)
        << x << ' ' << y;
}

TEST(BlurredCheckerboard, IsDarkInItsFirstAndLastSquareAndBrightAround) {
  const BlurredCheckerboard board(13, 9, 0.3, InFocus(1e-4 * Eigen::Matrix2d::Identity()));
  EXPECT_NEAR(board.Brightness({-1.95, -1.35}, 0), 0, 1e-9);
  EXPECT_NEAR(board.Brightness({1.95, 1.35}, 0), 0, 1e-9);
  EXPECT_NEAR(board.Brightness({-1.65, -1.35}, 0), 1, 1e-9);
  EXPECT_NEAR(board.Brightness({-2.4, -1.35}, 0), 1, 1e-9);
  EXPECT_NEAR(board.Brightness({0, 3}, 0), 1, 1e-9);
  EXPECT_NEAR(board.Brightness({0, 0}, 0), 0.5, 1e-9);
}

TEST(SignCovariance, HasTheKnownValueAtTheOrigin) {
  // Sheppard: E[sgn X sgn Y] = 2/pi asin(rho).
  for (const double rho : {-0.9, -0.1, 0.0, 0.3, 0.7})
    EXPECT_NEAR(SignCovariance(0, 0, rho), 2 / std::numbers::pi * std::asin(rho), 1e-6) << rho;
}

}  // namespace
}  // namespace telestrain
