#include "diagnostics/pinhole_residual.h"

#include <cmath>

#include "geometry/rotation.h"

namespace telestrain {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// About half the width of a view's field, so that all parameters have similar sizes.
constexpr double kFieldRadius_mm = 3.0;
constexpr std::array<int, 5> kPower{2, 4, 1, 1, 6};

// d(Brown(x, y)) / d(scaled coefficients), 2x5.
Eigen::Matrix<double, 2, 5> CoefficientJacobian(const Eigen::Vector2d& plane_mm) {
  const Eigen::Vector2d s = plane_mm / kFieldRadius_mm;
  const double r2 = s.squaredNorm(), xy = 2 * s.x() * s.y();
  Eigen::Matrix<double, 2, 5> jacobian;
  jacobian.col(0) = r2 * plane_mm;
  jacobian.col(1) = r2 * r2 * plane_mm;
  jacobian.col(2) = kFieldRadius_mm * Eigen::Vector2d(xy, r2 + 2 * s.y() * s.y());
  jacobian.col(3) = kFieldRadius_mm * Eigen::Vector2d(r2 + 2 * s.x() * s.x(), xy);
  jacobian.col(4) = r2 * r2 * r2 * plane_mm;
  return jacobian;
}

}  // namespace

std::array<double, kPinholeLensSize> PinholeLensBlock(const PinholeView& view) {
  std::array<double, kPinholeLensSize> block{1};
  for (std::size_t i = 0; i < 5; ++i)
    block[i + 1] = view.distortion[i] * std::pow(kFieldRadius_mm, kPower[i]);
  return block;
}

std::array<double, kPinholeCameraSize> PinholeCameraBlock(const PinholeView& view) {
  const Eigen::Vector3d w = LogRotation(view.camera_from_array);
  const Eigen::Vector3d& t = view.origin_in_camera_mm;
  return {w.x(), w.y(), w.z(), t.x(), t.y(), t.z() / view.working_distance_mm};
}

PinholeView PinholeViewFromBlocks(const PinholeView& start, const double* lens,
                                  const double* camera) {
  PinholeView view = start;
  view.scale_px_per_mm *= lens[0];
  for (std::size_t i = 0; i < 5; ++i)
    view.distortion[i] = lens[i + 1] / std::pow(kFieldRadius_mm, kPower[i]);
  view.camera_from_array = ExpRotation({camera[0], camera[1], camera[2]});
  view.origin_in_camera_mm = {camera[3], camera[4], camera[5] * view.working_distance_mm};
  return view;
}

struct PinholeBoardResidual::Geometry {
  Geometry(const PinholeView& start, double const* const* parameters)
      : view(PinholeViewFromBlocks(start, parameters[0], parameters[1])),
        origin(Eigen::Map<const Eigen::Vector3d>(parameters[2] + 3)) {
    const Eigen::Vector3d view_rotation = Eigen::Map<const Eigen::Vector3d>(parameters[1]);
    const Eigen::Vector3d pose_rotation = Eigen::Map<const Eigen::Vector3d>(parameters[2]);
    view_jacobian = LeftJacobian(view_rotation);
    array_from_target = ExpRotation(pose_rotation);
    pose_jacobian = LeftJacobian(pose_rotation);
    brown.distortion = view.distortion;
    flip = Eigen::Vector2d(view.flipped ? -1 : 1, 1).asDiagonal();
  }
  PinholeView view;
  TelecentricLens brown;
  Eigen::Vector3d origin;
  Eigen::Matrix3d view_jacobian, array_from_target, pose_jacobian;
  Eigen::Matrix2d flip;
};

PinholeBoardResidual::PinholeBoardResidual(const BoardData& board, const PinholeView& start)
    : board_(board), start_(start) {
  set_num_residuals(static_cast<int>(2 * board.Count()));
  *mutable_parameter_block_sizes() = {kPinholeLensSize, kPinholeCameraSize, kPinholePoseSize};
}

bool PinholeBoardResidual::Evaluate(double const* const* parameters, double* residuals,
                                    double** jacobians) const {
  const Geometry geometry(start_, parameters);
  for (Eigen::Index i = 0; i < board_.Count(); ++i) {
    const auto predicted = geometry.view.Project(
        geometry.array_from_target * board_.corners_in_target_mm.col(i) + geometry.origin);
    if (!predicted) return false;
    Eigen::Map<Eigen::Vector2d>(residuals + 2 * i) =
        board_.whitening[static_cast<std::size_t>(i)] * (*predicted - board_.pixels.col(i));
    if (jacobians != nullptr) WriteJacobians(geometry, i, jacobians);
  }
  return true;
}

void PinholeBoardResidual::WriteJacobians(const Geometry& g, Eigen::Index corner,
                                          double** jacobians) const {
  const double distance_mm = g.view.working_distance_mm;
  const Eigen::Vector3d turned = g.array_from_target * board_.corners_in_target_mm.col(corner);
  const Eigen::Vector3d rotated = g.view.camera_from_array * (turned + g.origin);
  const Eigen::Vector3d in_camera = rotated + g.view.origin_in_camera_mm;
  const double enlargement = distance_mm / in_camera.z();
  const Eigen::Vector2d plane_mm = enlargement * in_camera.head<2>();
  const Eigen::Matrix2d pixel_from_brown =
      board_.whitening[static_cast<std::size_t>(corner)] * g.flip * g.view.scale_px_per_mm;
  Eigen::Matrix<double, 2, 3> plane_from_camera;
  plane_from_camera << enlargement, 0, -plane_mm.x() / in_camera.z(), 0, enlargement,
      -plane_mm.y() / in_camera.z();
  const Eigen::Matrix<double, 2, 3> pixel_from_camera =
      pixel_from_brown * g.brown.DistortJacobian(plane_mm) * plane_from_camera;
  const auto rows = [&](int block) {
    return Eigen::Map<RowMatrix>(jacobians[block] + 2 * corner * 6, 2, 6);
  };
  if (jacobians[0] != nullptr) {
    auto lens = rows(0);
    lens.col(0) = pixel_from_brown * g.brown.Distort(plane_mm) * start_.scale_px_per_mm /
                  g.view.scale_px_per_mm;
    lens.rightCols<5>() = pixel_from_brown * CoefficientJacobian(plane_mm);
  }
  if (jacobians[1] != nullptr) {
    auto camera = rows(1);
    camera.leftCols<3>() = pixel_from_camera * (-Skew(rotated) * g.view_jacobian);
    camera.rightCols<3>() = pixel_from_camera * Eigen::Vector3d(1, 1, distance_mm).asDiagonal();
  }
  if (jacobians[2] != nullptr) {
    const Eigen::Matrix<double, 2, 3> pixel_from_array =
        pixel_from_camera * g.view.camera_from_array;
    auto pose = rows(2);
    pose.leftCols<3>() = pixel_from_array * (-Skew(turned) * g.pose_jacobian);
    pose.rightCols<3>() = pixel_from_array;
  }
}

}  // namespace telestrain
