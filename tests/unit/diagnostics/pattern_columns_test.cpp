#include "diagnostics/pattern_columns.h"

#include <gtest/gtest.h>

#include <functional>

#include "geometry/rotation.h"
#include "unit/diagnostics/fitted_array.h"

namespace telestrain {
namespace {

using Layout = PatternLayout;
using Change = std::function<void(ArrayState&, double)>;

// How a state changes along every column that a state has a number for.
std::vector<std::pair<int, Change>> Changes(int image, int view, int board) {
  const auto lens = [](ArrayState& s) -> TelecentricLens& { return s.array.lenses.front(); };
  const auto v = static_cast<std::size_t>(view), k = static_cast<std::size_t>(image);
  std::vector<std::pair<int, Change>> changes = {
      {0, [=](ArrayState& s, double d) { lens(s).magnification_px_per_mm *= 1 + d; }},
      {1, [=](ArrayState& s, double d) { lens(s).aspect += d; }},
      {7, [=](ArrayState& s, double d) { lens(s).telecentricity_per_mm += d; }},
      {Layout::kBoardAt, [](ArrayState& s, double d) { s.target.pitch_relative += d; }}};
  for (std::size_t i = 0; i < 5; ++i)
    changes.push_back(
        {2 + static_cast<int>(i), [=](ArrayState& s, double d) { lens(s).distortion[i] += d; }});
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    changes.push_back({Layout::kRotation + axis, [=](ArrayState& s, double d) {
                         TelecentricView& turned = s.array.views[v];
                         turned.axes_in_array =
                             (ExpRotation(d * unit) * turned.Rotation()).topRows<2>();
                       }});
    changes.push_back({Layout::kPoseAt + axis, [=](ArrayState& s, double d) {
                         Eigen::Matrix3d& turned = s.poses[k].array_from_target;
                         turned = ExpRotation(d * unit) * turned;
                       }});
    changes.push_back({Layout::kPoseAt + 3 + axis, [=](ArrayState& s, double d) {
                         s.poses[k].origin_in_array_mm += d * unit;
                       }});
  }
  for (int axis = 0; axis < 2; ++axis)
    changes.push_back({Layout::kOffset + axis,
                       [=](ArrayState& s, double d) { s.array.views[v].offset_mm[axis] += d; }});
  double BoardShape::*const shapes[] = {&BoardShape::shift_mm,   &BoardShape::height_mm,
                                        &BoardShape::tilt_x_rad, &BoardShape::tilt_y_rad,
                                        &BoardShape::bow_x_mm,   &BoardShape::bow_y_mm};
  for (int i = 0; i < 6; ++i)
    changes.push_back({Layout::kBoardAt + 1 + i, [=](ArrayState& s, double d) {
                         s.target.boards[static_cast<std::size_t>(board)].*shapes[i] += d;
                       }});
  return changes;
}

TEST(PatternColumns, AreTheDerivativesOfTheImage) {
  testing_support::FittedArray fitted = testing_support::FitArray({});
  fitted.state.target.boards.resize(2);
  fitted.state.array.lenses.front().distortion = {1e-4, 1e-6, 1e-5, -2e-5, 1e-8};
  const BoardData& board = fitted.data.boards[22];
  const Eigen::MatrixXd columns = PatternColumns(board, fitted.state);
  for (const auto& [column, change] : Changes(board.image, board.view, board.geometry.board)) {
    constexpr double kStep = 1e-6;
    ArrayState more = fitted.state, less = fitted.state;
    change(more, kStep);
    change(less, -kStep);
    const Eigen::Matrix2Xd by_number =
        (ReprojectionErrors_px(less, board) - ReprojectionErrors_px(more, board)) / (2 * kStep);
    for (Eigen::Index i = 0; i < board.Count(); ++i) {
      const Eigen::Vector2d whitened =
          board.whitening[static_cast<std::size_t>(i)] * by_number.col(i);
      // Rounding of pixels, 1e-13 * 1000, over the step and the noise of 0.1 px: 1e-3; the step's
      // square times the third derivative is less.
      EXPECT_LT((columns.block<2, 1>(2 * i, column) - whitened).norm(),
                2e-3 + 1e-6 * whitened.norm())
          << column;
    }
  }
}

TEST(PatternColumns, EndWithTheWhitenedResidual) {
  const testing_support::FittedArray fitted = testing_support::FitArray({});
  const BoardData& board = fitted.data.boards[3];
  const Eigen::MatrixXd columns = PatternColumns(board, fitted.state);
  ASSERT_EQ(columns.rows(), 2 * board.Count());
  const Eigen::Vector2d whitened =
      board.whitening[5] * ReprojectionErrors_px(fitted.state, board).col(5);
  EXPECT_EQ((columns.block<2, 1>(10, Layout::kResidualAt)), whitened);
}

}  // namespace
}  // namespace telestrain
