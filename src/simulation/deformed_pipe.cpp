#include "simulation/deformed_pipe.h"

#include <Eigen/Geometry>
#include <cmath>

namespace telestrain {

Eigen::Vector3d DeformedPipe::Material(double along_mm, double angle_rad) const {
  return {along_mm, radius_mm * std::sin(angle_rad), radius_mm * std::cos(angle_rad)};
}

Eigen::Matrix3d DeformedPipe::BendingAxes() const {
  const double cosine = std::cos(curvature_angle_rad), sine = std::sin(curvature_angle_rad);
  Eigen::Matrix3d axes;
  axes << 1, 0, 0, 0, cosine, sine, 0, -sine, cosine;
  return axes;
}

Eigen::Vector3d DeformedPipe::BendingDisplacement_mm(const Eigen::Vector3d& material_mm) const {
  const Eigen::Matrix3d axes = BendingAxes();
  const Eigen::Vector3d p = axes.transpose() * material_mm;
  const double k = curvature_per_mm, n = poisson_ratio;
  return axes *
         Eigen::Vector3d(-k * p.x() * p.z(), n * k * p.y() * p.z(),
                         0.5 * k * p.x() * p.x() + 0.5 * n * k * (p.z() * p.z() - p.y() * p.y()));
}

Eigen::Vector3d DeformedPipe::Displacement_mm(const Eigen::Vector3d& p) const {
  const double a = UniformAxial(), h = UniformAcross();
  Eigen::Vector3d u = Eigen::Vector3d(a * p.x(), h * p.y(), h * p.z()) + BendingDisplacement_mm(p);
  if (twist_rad_per_mm == 0) return u;
  const double phi = twist_rad_per_mm * p.x(), sine = std::sin(phi);
  const double one_minus_cosine = 2 * std::sin(0.5 * phi) * std::sin(0.5 * phi);
  u.y() += p.z() * sine - p.y() * one_minus_cosine;
  u.z() -= p.y() * sine + p.z() * one_minus_cosine;
  return u;
}

Eigen::Matrix3d DeformedPipe::DisplacementGradient(const Eigen::Vector3d& p) const {
  const double k = curvature_per_mm, n = poisson_ratio;
  const Eigen::Matrix3d axes = BendingAxes();
  const Eigen::Vector3d q = axes.transpose() * p;
  Eigen::Matrix3d bending;
  bending << -k * q.z(), 0, -k * q.x(),  // u_x
      0, n * k * q.z(), n * k * q.y(),   // u_y
      k * q.x(), -n * k * q.y(), n * k * q.z();
  Eigen::Matrix3d gradient = axes * bending * axes.transpose();
  gradient.diagonal() += Eigen::Vector3d(UniformAxial(), UniformAcross(), UniformAcross());
  const double phi = twist_rad_per_mm * p.x();
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(-phi).toRotationMatrix();
  gradient.bottomRightCorner<2, 2>() += turn - Eigen::Matrix2d::Identity();
  const Eigen::Vector2d turned = turn * p.tail<2>();
  gradient.bottomLeftCorner<2, 1>() += twist_rad_per_mm * Eigen::Vector2d(turned.y(), -turned.x());
  return gradient;
}

Eigen::Vector3d DeformedPipe::Bend(const Eigen::Vector3d& straight_mm) const {
  if (bend_radius_mm == 0) return straight_mm;
  const double phi = straight_mm.x() / bend_radius_mm;
  const double one_minus_cosine = 2 * std::sin(0.5 * phi) * std::sin(0.5 * phi);
  return {(bend_radius_mm - straight_mm.z()) * std::sin(phi), straight_mm.y(),
          straight_mm.z() + (bend_radius_mm - straight_mm.z()) * one_minus_cosine};
}

Eigen::Matrix3d DeformedPipe::BendRotation(double along_mm) const {
  if (bend_radius_mm == 0) return Eigen::Matrix3d::Identity();
  const double phi = along_mm / bend_radius_mm;
  Eigen::Matrix3d rotation;
  rotation << std::cos(phi), 0, -std::sin(phi), 0, 1, 0, std::sin(phi), 0, std::cos(phi);
  return rotation;
}

SurfaceStrain DeformedPipe::StrainAt(double along_mm, double angle_rad) const {
  const Eigen::Vector3d material_mm = Material(along_mm, angle_rad);
  const Eigen::Matrix3d map = Eigen::Matrix3d::Identity() + DisplacementGradient(material_mm);
  Eigen::Vector3d along = map.col(0);
  Eigen::Vector3d around = map * Eigen::Vector3d(0, std::cos(angle_rad), -std::sin(angle_rad));
  double along_before = 1;
  if (bend_radius_mm != 0) {
    // Bending the axis shortens what is on the inside of the arc.
    const double z_mm = material_mm.z() + Displacement_mm(material_mm).z();
    along.x() *= 1 - z_mm / bend_radius_mm;
    around.x() *= 1 - z_mm / bend_radius_mm;
    along_before = 1 - material_mm.z() / bend_radius_mm;
  }
  return {along.norm() / along_before - 1, around.norm() - 1,
          std::asin(along.dot(around) / (along.norm() * around.norm()))};
}

}  // namespace telestrain
