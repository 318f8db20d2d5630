#include "calibration/board_residual.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::Random;
using Residual = BoardResidual;

constexpr int kSizes[Residual::kBlocks] = {kLensSize, kViewSize, 2 * kPoseSize, 1, kBoardShapeSize};

// 23 corners, so that the last group of corners is not full; whitenings of every kind.
BoardData SomeBoard(Random& random) {
  BoardData board;
  board.geometry.center_in_target_mm = {13.85, 0.4, 0};
  board.geometry.x_in_target = {0.8, 0.6, 0};
  board.geometry.y_in_target = {-0.6, 0.8, 0};
  board.geometry.half_width_mm = 1.8;
  board.geometry.half_height_mm = 1.2;
  constexpr int kCorners = 23;
  board.corners_in_board_mm.resize(2, kCorners);
  board.pixels.resize(2, kCorners);
  for (int i = 0; i < kCorners; ++i) {
    board.corner.push_back(i);
    board.corners_in_board_mm.col(i) << random.Uniform(-1.8, 1.8), random.Uniform(-1.2, 1.2);
    board.pixels.col(i) << random.Uniform(0, 2000), random.Uniform(0, 2000);
    Eigen::Matrix2d whitening;
    whitening << 10, random.Uniform(-2, 2), random.Uniform(-2, 2), 8;
    board.whitening.push_back(whitening);
  }
  return board;
}

struct State {
  std::vector<double> blocks[Residual::kBlocks];
  std::vector<const double*> Pointers() const {
    std::vector<const double*> pointers;
    for (const auto& block : blocks) pointers.push_back(block.data());
    return pointers;
  }
};

// `turn` is the view's rotation: also near half a turn, where mirrored views live.
State SomeState(double turn, Random& random) {
  State state;
  for (int b = 0; b < Residual::kBlocks; ++b)
    for (int i = 0; i < kSizes[b]; ++i) state.blocks[b].push_back(random.Uniform(-0.05, 0.05));
  state.blocks[Residual::kLens][0] += 1;
  state.blocks[Residual::kLens][1] += 1;
  state.blocks[Residual::kView][0] = turn;
  state.blocks[Residual::kView][3] = 13;
  return state;
}

BoardModel SomeModel(double robust_sigmas) {
  BoardModel model;
  model.plan.curved = model.plan.depth = true;
  model.plan.lens_free.fill(true);
  model.plan.robust_sigmas = robust_sigmas;
  model.unit_px_per_mm = 227;
  model.center_px = {1295.5, 971.5};
  model.depth_sense = -1;
  model.depth_offset_mm = 0.7;
  model.pose = 1;
  model.poses = 2;
  return model;
}

// Residuals and all derivatives, two rows per corner: what the condensed rows stand for.
Eigen::MatrixXd FullJacobian(const Residual& residual, const State& state,
                             Eigen::VectorXd& residuals) {
  const auto pointers = state.Pointers();
  const Eigen::MatrixXd columns = residual.Columns(pointers.data());
  const Eigen::Index images = columns.cols() - kLensSize - 1;
  residuals = columns.rightCols(1);
  Eigen::MatrixXd jacobian(columns.rows(), 0);
  for (int b = 0; b < Residual::kBlocks; ++b)
    for (int i = 0; i < kSizes[b]; ++i) {
      jacobian.conservativeResize(Eigen::NoChange, jacobian.cols() + 1);
      if (b == Residual::kLens)
        jacobian.rightCols(1) = columns.col(images + i);
      else if (b == Residual::kPose && i < kPoseSize)
        jacobian.rightCols(1).setZero();  // the other pose of the block
      else
        jacobian.rightCols(1) =
            columns.leftCols(images) *
            residual.ImageDerivative(pointers.data(), static_cast<Residual::Block>(b),
                                     b == Residual::kPose ? i - kPoseSize : i);
    }
  return jacobian;
}

TEST(BoardResidual, JacobiansEqualNumericDerivatives) {
  Random random(7);
  for (const double turn : {0.0, 0.4, 3.0, 3.1415}) {
    const Residual residual(SomeBoard(random), SomeModel(0));
    State state = SomeState(turn, random);
    Eigen::VectorXd values, plus, minus;
    const Eigen::MatrixXd analytic = FullJacobian(residual, state, values);
    Eigen::Index column = 0;
    for (auto& block : state.blocks)
      for (double& parameter : block) {
        const double step = 1e-5, saved = parameter;
        parameter = saved + step;
        FullJacobian(residual, state, plus);
        parameter = saved - step;
        FullJacobian(residual, state, minus);
        parameter = saved;
        const Eigen::VectorXd numeric = (plus - minus) / (2 * step);
        // Rounding of residuals up to 3e4 leaves 3e4 * 2e-16 / 1e-5 = 6e-7; the third derivative
        // leaves step^2 of the size of the first one.
        EXPECT_LT((analytic.col(column) - numeric).cwiseAbs().maxCoeff(),
                  2e-5 + 1e-7 * numeric.cwiseAbs().maxCoeff())
            << "parameter " << column << " turn " << turn;
        ++column;
      }
  }
}

// The condensed residuals and their derivatives, as Ceres gets them.
Eigen::MatrixXd CondensedJacobian(const Residual& residual, const State& state,
                                  Eigen::VectorXd& condensed) {
  const auto pointers = state.Pointers();
  const Eigen::Index rows = residual.num_residuals();
  condensed.resize(rows);
  std::vector<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>> blocks;
  std::vector<double*> block_pointers;
  for (const int size : kSizes) blocks.emplace_back(rows, size);
  for (auto& block : blocks) block_pointers.push_back(block.data());
  EXPECT_TRUE(residual.Evaluate(pointers.data(), condensed.data(), block_pointers.data()));
  Eigen::MatrixXd jacobian(rows, std::accumulate(std::begin(kSizes), std::end(kSizes), 0));
  jacobian << blocks[0], blocks[1], blocks[2], blocks[3], blocks[4];
  return jacobian;
}

// The rows that Ceres gets have the cost, gradient and Gauss-Newton matrix of all residuals; also
// of a lens so nearly perfect that its columns depend on each other to the last digits but one.
TEST(BoardResidual, CondensedRowsStandForAllResiduals) {
  Random random(8);
  for (const auto& [robust_sigmas, imperfection] :
       {std::pair{0.0, 1.0}, std::pair{3000.0, 1.0}, std::pair{0.0, 1e-6}, std::pair{0.0, 1e-8}}) {
    const Residual residual(SomeBoard(random), SomeModel(robust_sigmas));
    State state = SomeState(0.4, random);
    std::vector<double>& lens = state.blocks[Residual::kLens];
    lens[1] = 1;
    for (std::size_t i = 2; i < lens.size(); ++i) lens[i] *= imperfection;
    const auto pointers = state.Pointers();
    Eigen::VectorXd all;
    const Eigen::MatrixXd jacobian = FullJacobian(residual, state, all);
    Eigen::VectorXd condensed;
    const Eigen::MatrixXd condensed_jacobian = CondensedJacobian(residual, state, condensed);
    const double loss = residual.Loss(pointers.data());
    const Eigen::VectorXd scale = jacobian.colwise().norm().transpose();
    // Sums of 46 products, pivots down to the rounding that the factor drops.
    EXPECT_NEAR(condensed.squaredNorm(), loss, 1e-12 * loss);
    if (robust_sigmas == 0) {
      EXPECT_NEAR(all.squaredNorm(), loss, 1e-12 * loss);
    }
    const Eigen::VectorXd gradient = jacobian.transpose() * all;
    const Eigen::VectorXd of_condensed = condensed_jacobian.transpose() * condensed;
    const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    const Eigen::MatrixXd normal_of_condensed = condensed_jacobian.transpose() * condensed_jacobian;
    for (Eigen::Index i = 0; i < scale.size(); ++i) {
      EXPECT_NEAR(of_condensed(i), gradient(i), 1e-12 * (1e-300 + scale(i) * all.norm()));
      for (Eigen::Index j = 0; j < scale.size(); ++j)
        EXPECT_NEAR(normal_of_condensed(i, j), normal(i, j),
                    1e-10 * (1e-300 + scale(i) * scale(j)));
    }
    Eigen::VectorXd cost_only(residual.num_residuals());
    ASSERT_TRUE(residual.Evaluate(pointers.data(), cost_only.data(), nullptr));
    EXPECT_NEAR(cost_only.squaredNorm(), loss, 1e-12 * loss);
  }
}

// The gradient of the robust cost itself, by central differences.
TEST(BoardResidual, TheRobustGradientIsThatOfTheLoss) {
  Random random(9);
  const Residual residual(SomeBoard(random), SomeModel(5000));
  State state = SomeState(0.2, random);
  Eigen::VectorXd weighted;
  const Eigen::VectorXd gradient = FullJacobian(residual, state, weighted).transpose() * weighted;
  Eigen::Index column = 0;
  for (auto& block : state.blocks)
    for (double& parameter : block) {
      const double step = 1e-5, saved = parameter;
      parameter = saved + step;
      const double plus = residual.Loss(state.Pointers().data());
      parameter = saved - step;
      const double minus = residual.Loss(state.Pointers().data());
      parameter = saved;
      // Rounding: 1e-16 * loss / step.
      EXPECT_NEAR(gradient(column), (plus - minus) / (4 * step),
                  1e-6 * std::abs(gradient(column)) + 1e-10 * plus)
          << column;
      ++column;
    }
}

}  // namespace
}  // namespace telestrain
