#include "diagnostics/pattern_columns.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace telestrain {
namespace {

using Layout = PatternLayout;
using CornerColumns = Eigen::Matrix<double, 2, Layout::kColumns>;

struct Scene {
  const TelecentricLens& lens;
  const TelecentricView& view;
  const TargetPose& pose;
  const BoardGeometry& geometry;
  double order = 0;  // of the image, from -1/2 to 1/2
};

void FillView(const Scene& scene, const Eigen::Vector3d& point_in_array_mm, CornerColumns& c) {
  const TelecentricLens& lens = scene.lens;
  const Eigen::Vector3d turned = scene.view.Rotation() * point_in_array_mm;
  const double depth_mm = scene.view.Depth_mm(point_in_array_mm);
  const double scale = 1 + lens.telecentricity_per_mm * depth_mm;
  const Eigen::Vector2d q = scene.view.Ideal(point_in_array_mm) / scale;
  const Eigen::Vector2d scales = lens.Scales_px_per_mm(), image = lens.Distort(q);
  const double x = q.x(), y = q.y(), r2 = q.squaredNorm();
  c.col(0) = scales.cwiseProduct(image);
  c.col(1) = Eigen::Vector2d(0, lens.magnification_px_per_mm * image.y());
  c.col(2) = scales.cwiseProduct(r2 * q);
  c.col(3) = scales.cwiseProduct(r2 * r2 * q);
  c.col(4) = scales.cwiseProduct(Eigen::Vector2d(2 * x * y, r2 + 2 * y * y));
  c.col(5) = scales.cwiseProduct(Eigen::Vector2d(r2 + 2 * x * x, 2 * x * y));
  c.col(6) = scales.cwiseProduct(r2 * r2 * r2 * q);
  const Eigen::Matrix2d by_ideal = scales.asDiagonal() * lens.DistortJacobian(q) / scale;
  c.col(7) = by_ideal * (-depth_mm * q);
  c.col(Layout::kRotation) = by_ideal * Eigen::Vector2d(0, -turned.z());
  c.col(Layout::kRotation + 1) = by_ideal * Eigen::Vector2d(turned.z(), 0);
  c.col(Layout::kRotation + 2) = by_ideal * Eigen::Vector2d(-turned.y(), turned.x());
  c.middleCols<2>(Layout::kOffset) = by_ideal;
  c.middleCols<2>(Layout::kDrift) = scene.order * Eigen::Matrix2d::Identity();
}

void FillTarget(const Scene& scene, const Eigen::Vector2d& corner_in_board_mm,
                const Eigen::Vector3d& corner_in_target_mm, CornerColumns& c) {
  const BoardGeometry& g = scene.geometry;
  const Eigen::Vector3d arm = scene.pose.array_from_target * corner_in_target_mm;
  const Eigen::Vector3d point = arm + scene.pose.origin_in_array_mm;
  const Eigen::Matrix<double, 2, 3> by_array = ProjectJacobian(scene.lens, scene.view, point);
  const Eigen::Matrix<double, 2, 3> by_target = by_array * scene.pose.array_from_target;
  const BasisVector basis = BasisAt(g, corner_in_board_mm);
  const auto shapes = ShapeDerivatives(g);
  for (std::size_t i = 0; i < shapes.size(); ++i)
    c.col(Layout::kBoardAt + static_cast<int>(i)) = by_target * (shapes[i] * basis);
  const double x = corner_in_board_mm.x(), y = corner_in_board_mm.y();
  const Eigen::Vector3d normal = g.x_in_target.cross(g.y_in_target);
  c.col(Layout::kBoardAt + Layout::kTwist) = by_target * normal * basis[1] * basis[2];
  c.col(Layout::kBoardAt + Layout::kStretch) = by_target * (x * g.x_in_target - y * g.y_in_target);
  c.col(Layout::kBoardAt + Layout::kShear) = by_target * (y * g.x_in_target + x * g.y_in_target);
  for (int axis = 0; axis < 3; ++axis)
    c.col(Layout::kPoseAt + axis) = by_array * Eigen::Vector3d::Unit(axis).cross(arm);
  c.middleCols<3>(Layout::kPoseAt + 3) = by_array;
  c.middleCols<2>(Layout::kAffineAt) = Eigen::Matrix2d::Identity();
  c.middleCols<2>(Layout::kAffineAt + 2) = basis[1] * Eigen::Matrix2d::Identity();
  c.middleCols<2>(Layout::kAffineAt + 4) = basis[2] * Eigen::Matrix2d::Identity();
}

}  // namespace

Eigen::MatrixXd PatternColumns(const BoardData& board, const ArrayState& state) {
  const auto view = static_cast<std::size_t>(board.view);
  const auto last = std::max<double>(1, static_cast<double>(state.poses.size()) - 1);
  const Scene scene{state.array.LensOf(view), state.array.views[view],
                    state.poses[static_cast<std::size_t>(board.image)], board.geometry,
                    board.image / last - 0.5};
  const Eigen::Matrix3Xd corners =
      CornersOfBoard(board.geometry, board.corners_in_board_mm, state.target);
  const Eigen::Matrix2Xd errors_px = ReprojectionErrors_px(state, board);
  Eigen::MatrixXd columns(2 * board.Count(), Layout::kColumns);
  CornerColumns corner;
  for (Eigen::Index i = 0; i < board.Count(); ++i) {
    const Eigen::Vector3d point =
        scene.pose.array_from_target * corners.col(i) + scene.pose.origin_in_array_mm;
    FillView(scene, point, corner);
    FillTarget(scene, board.corners_in_board_mm.col(i), corners.col(i), corner);
    corner.col(Layout::kResidualAt) = errors_px.col(i);
    columns.middleRows<2>(2 * i) = board.whitening[static_cast<std::size_t>(i)] * corner;
  }
  return columns;
}

}  // namespace telestrain
