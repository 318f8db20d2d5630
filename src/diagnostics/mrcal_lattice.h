#pragma once

#include <Eigen/Core>
#include <optional>

#include "calibration/calibration_data.h"

namespace telestrain {

// Stands in for the corners of a flat board under an affine camera (mrcal_telecentric.h says what
// for): a few weighted nodes of a lattice that have the same moments.

// Nodes at first_node + spacing (column, row) in the plane of the target.
struct PlateLattice {
  Eigen::Vector3d first_node_in_target_mm = Eigen::Vector3d::Zero();
  double spacing_mm = 1;
  int columns = 0, rows = 0;

  int NodeCount() const { return columns * rows; }
  Eigen::Vector2d Node_mm(int node) const {
    return first_node_in_target_mm.head<2>() +
           spacing_mm * Eigen::Vector2d(node % columns, node / columns);
  }
};

// One number for the weight of a corner: the inverse of the geometric mean of its two standard
// deviations. mrcal has no other.
double IsotropicWeight(const Eigen::Matrix2d& whitening);

// Weighted standard deviation of the places of a board's corners in the direction in which they
// are closest to a line. A lattice needs a spacing of less than twice that.
double LeastSpread_mm(const BoardData& board);

// The coarsest lattice on which every board of `data` has nodes to spare. All corners lie in one
// plane of constant z.
PlateLattice LatticeOver(const CalibrationData& data);

// Column per node; weight 0: not used.
struct CondensedBoard {
  Eigen::Matrix2Xd pixels;
  Eigen::VectorXd weight_1_px;
};

// The board by its nodes: for every affine image A the sum of squares of the nodes is the one of
// the corners plus a constant. The weights squared are the distribution of greatest entropy on the
// nodes around the board with the moments of the corners (Newton's method on its convex dual).
// Nothing when the corners are too close to a line for the lattice.
std::optional<CondensedBoard> Condense(const BoardData& board, const PlateLattice& lattice);

}  // namespace telestrain
