#pragma once

#include <optional>
#include <string>
#include <vector>

#include "target/board_ends.h"
#include "target/corner_grid.h"
#include "target/target_detector.h"

namespace telestrain {

// Which corner of the board each corner of a grid is, or why that cannot be told.
struct BoardLabels {
  // Column and row of the grid's corner (i, j): origin + along i + up j, column first.
  Eigen::Vector2i origin = Eigen::Vector2i::Zero();
  Eigen::Matrix2i steps = Eigen::Matrix2i::Zero();
  std::string refused_because;  // empty when the labels are known

  Eigen::Vector2i ColumnAndRow(const LatticeIndex& at) const {
    return origin + steps * Eigen::Vector2i(at.first, at.second);
  }
};

// Of the four quarter turns that give the axes the handedness of the nominal view, the one with
// the smallest turn is right, since the true axes lie within 45 deg of the nominal ones; turns with
// which the grid would leave the board, or with which two seen borders would be at the wrong
// distance, are left out. When the next smallest turn differs by less than 20 deg the choice is
// refused. Along each axis the grid must span the whole board or one border must be seen.
BoardLabels LabelGrid(const CornerGrid& grid, const BoardEnds& ends, const TargetSearch& search);

// "another pattern: ..." when the grid is too large for the board or its squares have not the size
// that the nominal view predicts; empty otherwise.
std::string WhyAnotherPattern(const CornerLattice& lattice, const TargetSearch& search);

}  // namespace telestrain
