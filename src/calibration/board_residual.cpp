#include "calibration/board_residual.h"

#include <cmath>

namespace telestrain {
namespace {
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
}  // namespace

TelecentricLens LensFromBlock(const double* block, double unit_px_per_mm,
                              const Eigen::Vector2d& center_px) {
  TelecentricLens lens;
  lens.magnification_px_per_mm = unit_px_per_mm * block[0];
  lens.center_px = center_px;
  for (std::size_t i = 0; i < 5; ++i)
    lens.distortion[i] = block[i + 1] / std::pow(kScaleRadius_mm, kRadiusPower[i]);
  return lens;
}

struct BoardResidual::Geometry {
  Geometry(const BoardResidual& self, double const* const* parameters)
      : lens(LensFromBlock(parameters[0], self.unit_px_per_mm_, self.center_px_)),
        offset(Eigen::Map<const Eigen::Vector2d>(parameters[1] + 3)),
        origin(Eigen::Map<const Eigen::Vector3d>(parameters[2] + 3)) {
    const Eigen::Vector3d view_rotation = Eigen::Map<const Eigen::Vector3d>(parameters[1]);
    const Eigen::Vector3d pose_rotation = Eigen::Map<const Eigen::Vector3d>(parameters[2]);
    camera_from_array = ExpRotation(view_rotation);
    view_jacobian = LeftJacobian(view_rotation);
    array_from_target = ExpRotation(pose_rotation);
    pose_jacobian = LeftJacobian(pose_rotation);
  }
  TelecentricLens lens;
  Eigen::Vector2d offset;
  Eigen::Vector3d origin;
  Eigen::Matrix3d camera_from_array, view_jacobian, array_from_target, pose_jacobian;
};

BoardResidual::BoardResidual(const BoardData& board, double unit_px_per_mm,
                             const Eigen::Vector2d& center_px)
    : board_(board), unit_px_per_mm_(unit_px_per_mm), center_px_(center_px) {
  set_num_residuals(static_cast<int>(2 * board.Count()));
  *mutable_parameter_block_sizes() = {kLensSize, kViewSize, kPoseSize};
}

bool BoardResidual::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  const Geometry geometry(*this, parameters);
  for (Eigen::Index i = 0; i < board_.Count(); ++i) {
    const Eigen::Vector3d in_array =
        geometry.array_from_target * board_.corners_in_target_mm.col(i) + geometry.origin;
    const Eigen::Vector2d ideal =
        geometry.camera_from_array.topRows<2>() * in_array + geometry.offset;
    Eigen::Map<Eigen::Vector2d>(residuals + 2 * i) =
        board_.whitening[static_cast<std::size_t>(i)] *
        (geometry.lens.PixelFromIdeal(ideal) - board_.pixels.col(i));
    if (jacobians != nullptr) WriteJacobians(geometry, i, ideal, jacobians);
  }
  return true;
}

void BoardResidual::WriteJacobians(const Geometry& g, Eigen::Index corner,
                                   const Eigen::Vector2d& ideal, double** jacobians) const {
  const Eigen::Matrix2d& whitening = board_.whitening[static_cast<std::size_t>(corner)];
  const Eigen::Matrix2d pixel_from_ideal =
      whitening * g.lens.magnification_px_per_mm * g.lens.DistortJacobian(ideal);
  const Eigen::Vector3d turned = g.array_from_target * board_.corners_in_target_mm.col(corner);
  const auto rows = [&](int block, int size) {
    return Eigen::Map<RowMatrix>(jacobians[block] + 2 * corner * size, 2, size);
  };
  if (jacobians[0] != nullptr) rows(0, kLensSize) = whitening * LensJacobian(g.lens, ideal);
  if (jacobians[1] != nullptr) {
    const Eigen::Vector3d in_camera = g.camera_from_array * (turned + g.origin);
    auto view = rows(1, kViewSize);
    view.leftCols<3>() = pixel_from_ideal * (-Skew(in_camera) * g.view_jacobian).topRows<2>();
    view.rightCols<2>() = pixel_from_ideal;
  }
  if (jacobians[2] != nullptr) {
    const Eigen::Matrix<double, 2, 3> pixel_from_array =
        pixel_from_ideal * g.camera_from_array.topRows<2>();
    auto pose = rows(2, kPoseSize);
    pose.leftCols<3>() = pixel_from_array * (-Skew(turned) * g.pose_jacobian);
    pose.rightCols<3>() = pixel_from_array;
  }
}

Eigen::Matrix<double, 2, kLensSize> BoardResidual::LensJacobian(
    const TelecentricLens& lens, const Eigen::Vector2d& ideal) const {
  const double m = lens.magnification_px_per_mm;
  const Eigen::Vector2d s = ideal / kScaleRadius_mm;  // coefficients multiply scaled coordinates
  const double r2 = s.squaredNorm(), xy = 2 * s.x() * s.y();
  Eigen::Matrix<double, 2, kLensSize> jacobian;
  jacobian.col(0) = unit_px_per_mm_ * lens.Distort(ideal);
  jacobian.col(1) = m * r2 * ideal;
  jacobian.col(2) = m * r2 * r2 * ideal;
  jacobian.col(3) = m * kScaleRadius_mm * Eigen::Vector2d(xy, r2 + 2 * s.y() * s.y());
  jacobian.col(4) = m * kScaleRadius_mm * Eigen::Vector2d(r2 + 2 * s.x() * s.x(), xy);
  jacobian.col(5) = m * r2 * r2 * r2 * ideal;
  return jacobian;
}

}  // namespace telestrain
