#include "geometry/rotation.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

namespace telestrain {

Eigen::Matrix3d Skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d skew;
  skew << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return skew;
}

Eigen::Matrix3d ExpRotation(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity() + Skew(w);
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Eigen::Vector3d LogRotation(const Eigen::Matrix3d& rotation) {
  // Through the quaternion, which stays well conditioned up to and at pi.
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine < 1e-12) return 2.0 * q.vec();
  return 2.0 * std::atan2(sine, q.w()) / sine * q.vec();
}

Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& w) {
  const double angle2 = w.squaredNorm();
  const Eigen::Matrix3d skew = Skew(w);
  if (angle2 < 1e-10) return Eigen::Matrix3d::Identity() + 0.5 * skew + skew * skew / 6.0;
  const double angle = std::sqrt(angle2);
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / angle2 * skew +
         (angle - std::sin(angle)) / (angle2 * angle) * skew * skew;
}

Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

double AngleBetween_rad(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return LogRotation(a * b.transpose()).norm();
}

Eigen::Matrix3d RotationFromRows(const Eigen::Vector3d& row_x, const Eigen::Vector3d& row_y) {
  const Eigen::Vector3d sum = (row_x.normalized() + row_y.normalized()).normalized();
  const Eigen::Vector3d difference = (row_x.normalized() - row_y.normalized()).normalized();
  Eigen::Matrix3d rotation;
  rotation.row(0) = (sum + difference).transpose() / std::sqrt(2.0);
  rotation.row(1) = (sum - difference).transpose() / std::sqrt(2.0);
  rotation.row(2) = rotation.row(0).cross(rotation.row(1));
  return rotation;
}

}  // namespace telestrain
