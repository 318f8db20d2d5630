#include "calibration/target_shape.h"

#include <Eigen/Geometry>
#include <cmath>

namespace telestrain {

BoardGeometry GeometryOfBoard(const TargetSpec& target, int board) {
  const SubBoard& spec = target.boards.at(static_cast<std::size_t>(board));
  const double cosine = std::cos(spec.rotation_rad), sine = std::sin(spec.rotation_rad);
  BoardGeometry geometry;
  geometry.board = board;
  geometry.center_in_target_mm = spec.center_in_target_mm;
  geometry.x_in_target = {cosine, sine, 0};
  geometry.y_in_target = {-sine, cosine, 0};
  const Eigen::Vector3d apart =
      spec.center_in_target_mm - target.boards.front().center_in_target_mm;
  geometry.separation_in_target = apart.norm() > 0 ? apart.normalized() : geometry.x_in_target;
  geometry.half_width_mm = 0.5 * target.square_mm * (target.columns - 1);
  geometry.half_height_mm = 0.5 * target.square_mm * (target.rows - 1);
  return geometry;
}

BasisVector BasisAt(const BoardGeometry& geometry, const Eigen::Vector2d& corner_in_board_mm) {
  const double x = corner_in_board_mm.x() / geometry.half_width_mm;
  const double y = corner_in_board_mm.y() / geometry.half_height_mm;
  return {1, x, y, 1 - x * x, 1 - y * y};
}

std::array<TargetFromBasis, 1 + kBoardShapeSize> ShapeDerivatives(const BoardGeometry& g) {
  const Eigen::Vector3d normal = g.x_in_target.cross(g.y_in_target);
  std::array<TargetFromBasis, 1 + kBoardShapeSize> derivatives;
  for (TargetFromBasis& derivative : derivatives) derivative.setZero();
  derivatives[0].col(1) = g.half_width_mm * g.x_in_target;
  derivatives[0].col(2) = g.half_height_mm * g.y_in_target;
  derivatives[1].col(0) = g.separation_in_target;
  derivatives[2].col(0) = normal;
  derivatives[3].col(2) = g.half_height_mm * normal;
  derivatives[4].col(1) = -g.half_width_mm * normal;
  derivatives[5].col(3) = normal;
  derivatives[6].col(4) = normal;
  return derivatives;
}

TargetFromBasis ShapeMatrix(const BoardGeometry& geometry, double pitch_relative,
                            const BoardShape& shape) {
  const auto derivatives = ShapeDerivatives(geometry);
  const double values[kBoardShapeSize] = {shape.shift_mm,   shape.height_mm, shape.tilt_x_rad,
                                          shape.tilt_y_rad, shape.bow_x_mm,  shape.bow_y_mm};
  TargetFromBasis matrix = (1 + pitch_relative) * derivatives[0];
  matrix.col(0) = geometry.center_in_target_mm;
  for (std::size_t i = 0; i < kBoardShapeSize; ++i)
    if (values[i] != 0) matrix += values[i] * derivatives[i + 1];
  return matrix;
}

Eigen::Matrix3Xd CornersOfBoard(const BoardGeometry& geometry,
                                const Eigen::Matrix2Xd& corners_in_board_mm,
                                const TargetShape& shape) {
  const TargetFromBasis matrix =
      ShapeMatrix(geometry, shape.pitch_relative, shape.Board(geometry.board));
  Eigen::Matrix3Xd corners(3, corners_in_board_mm.cols());
  for (Eigen::Index i = 0; i < corners.cols(); ++i)
    corners.col(i) = matrix * BasisAt(geometry, corners_in_board_mm.col(i));
  return corners;
}

}  // namespace telestrain
