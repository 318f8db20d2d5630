#include "diagnostics/residual_labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "unit/diagnostics/fitted_array.h"

namespace telestrain {
namespace {

using testing_support::FitArray;
using testing_support::FittedArray;

// The corners of a board with other labels, those that leave the grid dropped; the corner at
// (column, row) gets the label of (column - columns, row - rows).
BoardData Relabelled(const BoardData& board, const TargetSpec& target, int columns, int rows) {
  BoardData moved = board;
  std::vector<bool> remove;
  for (std::size_t i = 0; i < board.corner.size(); ++i) {
    const int column = board.corner[i] % target.columns - columns;
    const int row = board.corner[i] / target.columns - rows;
    const bool inside = column >= 0 && column < target.columns && row >= 0 && row < target.rows;
    remove.push_back(!inside);
    if (!inside) continue;
    moved.corner[i] = row * target.columns + column;
    moved.corners_in_board_mm.col(static_cast<Eigen::Index>(i)) =
        target.square_mm *
        Eigen::Vector2d(column - 0.5 * (target.columns - 1), row - 0.5 * (target.rows - 1));
  }
  moved.RemoveCorners(remove);
  return moved;
}

TEST(ReadLabels, FindsHowTheLabelsWereMoved) {
  const FittedArray fitted = FitArray({});
  const TargetSpec& target = fitted.data.target;
  const BoardData board = Relabelled(fitted.data.boards[9], target, -2, 3);
  const LabelReading reading = ReadLabels(board, target, fitted.state);
  EXPECT_TRUE(reading.IsMislabelled());
  EXPECT_FALSE(reading.turned);
  EXPECT_EQ(reading.columns, -2);
  EXPECT_EQ(reading.rows, 3);
  EXPECT_NEAR(reading.rms_px, 0.1, 4 * 0.1 / std::sqrt(4.0 * 66));  // 11 x 6 corners are left
  EXPECT_EQ(ToText(reading), "2 squares along -x and 3 squares along y");
}

TEST(ReadLabels, LeavesRightLabelsAlone) {
  const FittedArray fitted = FitArray({});
  const LabelReading reading = ReadLabels(fitted.data.boards[9], fitted.data.target, fitted.state);
  EXPECT_FALSE(reading.IsMislabelled());
  EXPECT_EQ(reading.rms_px, reading.rms_as_labelled_px);
  EXPECT_EQ(ToText(reading), "nothing");
}

}  // namespace
}  // namespace telestrain
