#include "diagnostics/mrcal_lattice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/calibration/synthetic_array.h"
#include "unit/diagnostics/random_rig.h"

namespace telestrain {
namespace {

using AffineImage = Eigen::Matrix<double, 2, 3>;

double LossOfCorners(const BoardData& board, const AffineImage& image) {
  double sum = 0;
  for (Eigen::Index i = 0; i < board.Count(); ++i) {
    const Eigen::Vector3d place(1, board.corners_in_target_mm(0, i),
                                board.corners_in_target_mm(1, i));
    const double weight = IsotropicWeight(board.whitening[static_cast<std::size_t>(i)]);
    sum += weight * weight * (image * place - board.pixels.col(i)).squaredNorm();
  }
  return sum;
}

double LossOfNodes(const CondensedBoard& board, const PlateLattice& lattice,
                   const AffineImage& image) {
  double sum = 0;
  for (int node = 0; node < lattice.NodeCount(); ++node) {
    const Eigen::Vector2d place = lattice.Node_mm(node);
    const double weight = board.weight_1_px(node);
    sum +=
        weight * weight *
        (image * Eigen::Vector3d(1, place.x(), place.y()) - board.pixels.col(node)).squaredNorm();
  }
  return sum;
}

TEST(Condense, TheNodesHaveTheLossOfTheCornersUpToAConstant) {
  testing_support::Random random(4);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto rig = testing_support::MakeRandomRig(seed);
    const PlateLattice lattice = LatticeOver(rig.data);
    for (const BoardData& board : rig.data.boards) {
      const auto condensed = Condense(board, lattice);
      ASSERT_TRUE(condensed);
      AffineImage first, second;
      for (double& value : first.reshaped()) value = random.Normal(100);
      second = first;
      for (double& value : second.reshaped()) value += random.Normal(10);
      const double of_corners = LossOfCorners(board, second) - LossOfCorners(board, first);
      const double of_nodes =
          LossOfNodes(*condensed, lattice, second) - LossOfNodes(*condensed, lattice, first);
      // Moments to 1e-13, of places up to a hundred times the board's size.
      EXPECT_NEAR(of_nodes / of_corners, 1, 1e-9);
    }
  }
}

TEST(Condense, CornersOnALineHaveNoNodes) {
  auto rig = testing_support::MakeRandomRig(1);
  const PlateLattice lattice = LatticeOver(rig.data);
  BoardData board = rig.data.boards.front();
  std::vector<bool> remove;
  const int row = board.corner.front() / rig.data.target.columns;
  for (const int corner : board.corner) remove.push_back(corner / rig.data.target.columns != row);
  board.RemoveCorners(remove);
  EXPECT_LT(LeastSpread_mm(board), 1e-6);
  EXPECT_FALSE(Condense(board, lattice));
}

TEST(LeastSpread, OfAWholeBoardIsTheOneAcrossItsRows) {
  testing_support::SyntheticOptions options;
  const auto array = MakeSyntheticArray(options);
  const auto data = CollectCalibrationData(array.session, array.boards).value();
  // Of n equal steps: step sqrt((n^2 - 1) / 12); rounding.
  EXPECT_NEAR(LeastSpread_mm(data.boards.front()), 0.3 * std::sqrt(80.0 / 12), 1e-12);
}

}  // namespace
}  // namespace telestrain
