#include "diagnostics/residual_labels.h"

#include <cmath>
#include <cstdlib>

namespace telestrain {
namespace {

constexpr int kFarthest_squares = 4;
constexpr double kMuchBetter = 0.1;

BoardData Relabelled(BoardData board, const TargetSpec& target, const LabelReading& reading) {
  for (std::size_t i = 0; i < board.corner.size(); ++i) {
    int column = board.corner[i] % target.columns, row = board.corner[i] / target.columns;
    if (reading.turned) {
      column = target.columns - 1 - column;
      row = target.rows - 1 - row;
    }
    board.corners_in_board_mm.col(static_cast<Eigen::Index>(i)) =
        target.square_mm * Eigen::Vector2d(column + reading.columns - 0.5 * (target.columns - 1),
                                           row + reading.rows - 0.5 * (target.rows - 1));
  }
  return board;
}

double Rms_px(const Eigen::Matrix2Xd& errors_px) {
  return std::sqrt(errors_px.squaredNorm() / static_cast<double>(errors_px.size()));
}

std::string Squares(int count, const char* axis) {
  const std::string number =
      std::abs(count) == 1 ? "one square" : std::to_string(std::abs(count)) + " squares";
  return number + " along " + (count < 0 ? "-" : "") + axis;
}

}  // namespace

bool LabelReading::IsMislabelled() const {
  return (turned || columns != 0 || rows != 0) && rms_px < kMuchBetter * rms_as_labelled_px;
}

LabelReading ReadLabels(const BoardData& board, const TargetSpec& target, const ArrayState& state) {
  const Eigen::Matrix2Xd as_labelled = ReprojectionErrors_px(state, board);
  LabelReading best;
  best.rms_px = best.rms_as_labelled_px = Rms_px(as_labelled);
  for (const bool turned : {false, true})
    for (int row = -kFarthest_squares; row <= kFarthest_squares; ++row)
      for (int column = -kFarthest_squares; column <= kFarthest_squares; ++column) {
        LabelReading reading{turned, column, row, 0, best.rms_as_labelled_px, 0};
        const Eigen::Matrix2Xd errors =
            ReprojectionErrors_px(state, Relabelled(board, target, reading));
        reading.rms_px = Rms_px(errors);
        reading.shift_px = (errors - as_labelled).colwise().norm().mean();
        if (reading.rms_px < best.rms_px) best = reading;
      }
  return best;
}

std::string ToText(const LabelReading& reading) {
  std::string text = reading.turned ? "half a turn" : "";
  const auto add = [&](int count, const char* axis) {
    if (count != 0) text += (text.empty() ? "" : " and ") + Squares(count, axis);
  };
  add(reading.columns, "x");
  add(reading.rows, "y");
  return text.empty() ? "nothing" : text;
}

}  // namespace telestrain
