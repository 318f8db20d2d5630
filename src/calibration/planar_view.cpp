#include "calibration/planar_view.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/rotation.h"

namespace telestrain {

Result<AffineHomography> FitAffineHomography(const Eigen::Matrix2Xd& target_mm,
                                             const Eigen::Matrix2Xd& pixels) {
  TELESTRAIN_CHECK(target_mm.cols() == pixels.cols(), "points and pixels differ in number");
  if (target_mm.cols() < 3)
    return EstimationFailed("a homography needs at least 3 corners, found " +
                            std::to_string(target_mm.cols()));
  const Eigen::Vector2d target_mean = target_mm.rowwise().mean();
  const Eigen::Vector2d pixel_mean = pixels.rowwise().mean();
  const Eigen::Matrix2Xd centred = target_mm.colwise() - target_mean;
  const Eigen::Matrix2d normal = centred * centred.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix2d> spread(normal);
  if (spread.singularValues()(1) < 1e-9 * spread.singularValues()(0))
    return EstimationFailed("the corners lie on one line; a homography needs a plane of corners");
  AffineHomography homography;
  homography.px_per_mm =
      normal.ldlt().solve(centred * (pixels.colwise() - pixel_mean).transpose()).transpose();
  homography.offset_px = pixel_mean - homography.px_per_mm * target_mean;
  return homography;
}

double MagnificationFromHomography(const AffineHomography& homography) {
  return Eigen::JacobiSVD<Eigen::Matrix2d>(homography.px_per_mm).singularValues()(0);
}

std::optional<Eigen::Vector2d> TwoMagnificationsOfPaper(
    const std::vector<AffineHomography>& homographies) {
  if (homographies.size() < 3) return {};
  const double scale = MagnificationFromHomography(homographies.front());
  Eigen::MatrixX3d design(homographies.size(), 3);
  Eigen::VectorXd right(homographies.size());
  for (Eigen::Index i = 0; i < design.rows(); ++i) {
    const Eigen::Matrix2d h = homographies[static_cast<std::size_t>(i)].px_per_mm / scale;
    design.row(i) << 1.0, -h.row(0).squaredNorm(), -h.row(1).squaredNorm();
    right(i) = -h.determinant() * h.determinant();
  }
  const auto solver = design.colPivHouseholderQr();
  if (solver.rank() < 3) return {};
  const Eigen::Vector3d solution = solver.solve(right);  // mx^2 my^2, my^2, mx^2 over scale^2
  if (solution(1) <= 0 || solution(2) <= 0) return {};
  return Eigen::Vector2d(std::sqrt(solution(2)), std::sqrt(solution(1))) * scale;
}

TwoFoldRotation RotationsFromHomography(const AffineHomography& homography,
                                        double magnification_px_per_mm) {
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(homography.px_per_mm / magnification_px_per_mm,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double cos_tilt = std::min(1.0, svd.singularValues()(1));
  const Eigen::Matrix2d block =
      svd.matrixU() * Eigen::Vector2d(1.0, cos_tilt).asDiagonal() * svd.matrixV().transpose();
  TwoFoldRotation rotations;
  rotations.depth_row = std::sqrt(1.0 - cos_tilt * cos_tilt) * svd.matrixU().col(1);
  for (int branch = 0; branch < 2; ++branch) {
    const Eigen::Vector2d depth = branch == 0 ? rotations.depth_row : -rotations.depth_row;
    rotations.camera_from_target[static_cast<std::size_t>(branch)] = RotationFromRows(
        {block(0, 0), block(0, 1), depth(0)}, {block(1, 0), block(1, 1), depth(1)});
  }
  return rotations;
}

}  // namespace telestrain
