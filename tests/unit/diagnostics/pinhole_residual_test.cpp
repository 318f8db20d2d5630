#include "diagnostics/pinhole_residual.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/diagnostics/pinhole_array.h"

namespace telestrain {
namespace {

using testing_support::SyntheticOptions;
using Block = std::array<double, 6>;

struct Evaluated {
  Eigen::VectorXd residuals;
  std::array<Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>, 3> jacobians;
};

Evaluated Evaluate(const PinholeBoardResidual& cost, const std::array<Block, 3>& at) {
  Evaluated result;
  result.residuals.resize(cost.num_residuals());
  std::array<double*, 3> jacobians{};
  for (std::size_t b = 0; b < 3; ++b) {
    result.jacobians[b].resize(cost.num_residuals(), 6);
    jacobians[b] = result.jacobians[b].data();
  }
  const std::array<const double*, 3> blocks{at[0].data(), at[1].data(), at[2].data()};
  EXPECT_TRUE(cost.Evaluate(blocks.data(), result.residuals.data(), jacobians.data()));
  return result;
}

TEST(PinholeBoardResidual, DerivativesAgreeWithDifferences) {
  for (const bool mirrored : {false, true}) {
    SyntheticOptions options;
    options.mirrored = mirrored;
    const auto made = testing_support::MakeCase(options);
    auto views = PinholeViewsAt(made.array.session, made.data, made.telecentric, {150});
    EXPECT_EQ(views[0].flipped, !mirrored);  // three mirrors: odd
    views[0].distortion = {1e-4, 2e-6, 3e-4, -2e-4, 1e-7};
    const PinholeBoardResidual cost(made.data.boards[0], views[0]);
    std::array<Block, 3> at{PinholeLensBlock(views[0]), PinholeCameraBlock(views[0]),
                            Block{0.02, -0.03, 0.01, 0.2, -0.1, 0.3}};
    at[0][0] = 1.01;
    const Evaluated exact = Evaluate(cost, at);
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t k = 0; k < 6; ++k) {
        constexpr double kStep = 1e-5;
        auto low = at, high = at;
        low[b][k] -= kStep;
        high[b][k] += kStep;
        const Eigen::VectorXd difference =
            (Evaluate(cost, high).residuals - Evaluate(cost, low).residuals) / (2 * kStep);
        const Eigen::VectorXd column = exact.jacobians[b].col(static_cast<Eigen::Index>(k));
        // Central differences: 1e-10 of the third derivative, and rounding 1e-15 * 1e4 / 1e-5.
        EXPECT_LT((difference - column).cwiseAbs().maxCoeff(),
                  1e-7 * std::max(10.0, column.cwiseAbs().maxCoeff()))
            << "block " << b << ", parameter " << k;
      }
  }
}

TEST(PinholeBoardResidual, ACornerBehindTheCameraIsNotEvaluated) {
  const auto made = testing_support::MakeCase({});
  const auto views = PinholeViewsAt(made.array.session, made.data, made.telecentric, {150});
  const PinholeBoardResidual cost(made.data.boards[0], views[0]);
  Block lens = PinholeLensBlock(views[0]), camera = PinholeCameraBlock(views[0]), pose{};
  camera[5] = -1;
  const std::array<const double*, 3> blocks{lens.data(), camera.data(), pose.data()};
  Eigen::VectorXd residuals(cost.num_residuals());
  EXPECT_FALSE(cost.Evaluate(blocks.data(), residuals.data(), nullptr));
}

}  // namespace
}  // namespace telestrain
