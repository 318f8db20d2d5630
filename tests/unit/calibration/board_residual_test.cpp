#include "calibration/board_residual.h"

#include <gtest/gtest.h>

#include <vector>

namespace telestrain {
namespace {

BoardData SomeBoard() {
  BoardData board;
  board.corners_in_target_mm.resize(3, 3);
  board.corners_in_target_mm << -14, -12, -13, 1, -1, 0.5, 0, 0, 0;
  board.pixels.resize(2, 3);
  board.pixels << 400, 700, 555, 300, 500, 222;
  for (int i = 0; i < 3; ++i) {
    board.corner.push_back(i);
    Eigen::Matrix2d whitening;
    whitening << 10, 0, 1.0 + i, 8;
    board.whitening.push_back(whitening);
  }
  return board;
}

// Analytic derivatives equal central differences, also near half a turn where mirrored views live.
TEST(BoardResidual, JacobiansEqualNumericDerivatives) {
  const BoardData board = SomeBoard();
  const BoardResidual residual(board, 227.0, {1295.5, 971.5});
  for (const double turn : {0.0, 0.4, 3.0, 3.1415}) {
    std::vector<double> lens{1.001, 0.003, -0.002, 0.001, 0.002, 0.0005};
    std::vector<double> view{turn, 0.1, -0.05, 13.0, 0.2};
    std::vector<double> pose{0.05, -0.1, 0.2, 0.3, -0.1, 0.4};
    double* blocks[3] = {lens.data(), view.data(), pose.data()};
    const int sizes[3] = {kLensSize, kViewSize, kPoseSize};
    std::vector<std::vector<double>> analytic;
    double* jacobians[3];
    for (int b = 0; b < 3; ++b) analytic.emplace_back(6 * sizes[b]);
    for (int b = 0; b < 3; ++b) jacobians[b] = analytic[static_cast<std::size_t>(b)].data();
    double values[6], plus[6], minus[6];
    ASSERT_TRUE(residual.Evaluate(blocks, values, jacobians));
    for (int b = 0; b < 3; ++b)
      for (int p = 0; p < sizes[b]; ++p) {
        const double step = 1e-6, saved = blocks[b][p];
        blocks[b][p] = saved + step;
        residual.Evaluate(blocks, plus, nullptr);
        blocks[b][p] = saved - step;
        residual.Evaluate(blocks, minus, nullptr);
        blocks[b][p] = saved;
        for (int r = 0; r < 6; ++r) {
          const double numeric = (plus[r] - minus[r]) / (2 * step);
          // Central differences of step 1e-6 are good to about 1e-8 relative here.
          EXPECT_NEAR(jacobians[b][r * sizes[b] + p], numeric, 1e-6 * (1 + std::abs(numeric)))
              << "block " << b << " parameter " << p << " residual " << r << " turn " << turn;
        }
      }
  }
}

}  // namespace
}  // namespace telestrain
