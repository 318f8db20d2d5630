#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "session/session.h"

namespace telestrain {

// How a target deviates from its nominal geometry within what its certificate leaves open
// (MODEL.md 5). Lengths mm, target frame; every corner is linear in every one of these numbers.

// Of one sub-board, against the plane and the distance that the first one defines.
struct BoardShape {
  double shift_mm = 0;                // along the direction from the first board's middle
  double height_mm = 0;               // along the target's normal
  double tilt_x_rad = 0;              // about the board's x: z = tilt_x y
  double tilt_y_rad = 0;              // about the board's y: z = -tilt_y x
  double bow_x_mm = 0, bow_y_mm = 0;  // z = bow_x (1 - (2 x / w)^2) + bow_y (1 - (2 y / h)^2)
};
inline constexpr int kBoardShapeSize = 6;

struct TargetShape {
  double pitch_relative = 0;  // error of the pitch common to all boards, about each board's middle
  std::vector<BoardShape> boards;  // one per TargetSpec::boards; one that is missing is nominal

  BoardShape Board(int board) const {
    const auto index = static_cast<std::size_t>(board);
    return index < boards.size() ? boards[index] : BoardShape();
  }
};

// Where a sub-board lies by the certificate.
struct BoardGeometry {
  int board = 0;  // index into TargetSpec::boards
  Eigen::Vector3d center_in_target_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d x_in_target = Eigen::Vector3d::UnitX();
  Eigen::Vector3d y_in_target = Eigen::Vector3d::UnitY();
  // From the first board's middle to this one's; of the first board the x axis.
  Eigen::Vector3d separation_in_target = Eigen::Vector3d::UnitX();
  double half_width_mm = 1, half_height_mm = 1;  // of the grid of corners: w / 2, h / 2
};

BoardGeometry GeometryOfBoard(const TargetSpec& target, int board);

// The functions of a corner's place (x, y) in its board in which its position is linear:
// 1, 2 x / w, 2 y / h, 1 - (2 x / w)^2, 1 - (2 y / h)^2.
inline constexpr int kBasisSize = 5;
using BasisVector = Eigen::Matrix<double, kBasisSize, 1>;
using TargetFromBasis = Eigen::Matrix<double, 3, kBasisSize>;

BasisVector BasisAt(const BoardGeometry& geometry, const Eigen::Vector2d& corner_in_board_mm);
TargetFromBasis ShapeMatrix(const BoardGeometry& geometry, double pitch_relative,
                            const BoardShape& shape);
// d(ShapeMatrix) by pitch_relative, then by the members of BoardShape in their order: constants.
std::array<TargetFromBasis, 1 + kBoardShapeSize> ShapeDerivatives(const BoardGeometry& geometry);

// 3xN positions in the target frame of corners given by their nominal places (2xN) in the board.
Eigen::Matrix3Xd CornersOfBoard(const BoardGeometry& geometry,
                                const Eigen::Matrix2Xd& corners_in_board_mm,
                                const TargetShape& shape);

}  // namespace telestrain
