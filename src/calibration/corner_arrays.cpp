#include "calibration/corner_arrays.h"

namespace telestrain {
namespace {
constexpr int kPadding = 4;  // what the sums over corners take at once
}  // namespace

CornerArrays::CornerArrays(const BoardData& board) {
  const auto count = static_cast<int>(board.Count());
  padded_ = (count + kPadding - 1) / kPadding * kPadding;
  values_.assign(static_cast<std::size_t>(kQuantities * padded_), 0.0);
  const auto at = [&](Quantity quantity, int corner) -> double& {
    return values_[static_cast<std::size_t>(quantity * padded_ + corner)];
  };
  for (int i = 0; i < count; ++i) {
    const BasisVector basis = BasisAt(board.geometry, board.corners_in_board_mm.col(i));
    const Eigen::Matrix2d& w = board.whitening[static_cast<std::size_t>(i)];
    at(kX, i) = basis(1);
    at(kY, i) = basis(2);
    at(kCurveX, i) = basis(3);
    at(kCurveY, i) = basis(4);
    at(kU, i) = board.pixels(0, i);
    at(kV, i) = board.pixels(1, i);
    at(kW00, i) = w(0, 0);
    at(kW01, i) = w(0, 1);
    at(kW10, i) = w(1, 0);
    at(kW11, i) = w(1, 1);
  }
}

}  // namespace telestrain
