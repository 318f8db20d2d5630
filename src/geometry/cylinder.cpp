#include "geometry/cylinder.h"

#include <cmath>

namespace telestrain {
namespace {

Eigen::Vector3d Across(const Eigen::Vector3d& vector, const Eigen::Vector3d& axis) {
  return vector - axis.dot(vector) * axis;
}

}  // namespace

double Cylinder::Distance_mm(const Eigen::Vector3d& point_mm) const {
  return Across(point_mm - axis_point_mm, axis).norm() - radius_mm;
}

Eigen::Vector3d Cylinder::Normal(const Eigen::Vector3d& point_mm) const {
  return Across(point_mm - axis_point_mm, axis).normalized();
}

std::optional<Eigen::Vector3d> Cylinder::Enter(const Eigen::Vector3d& origin_mm,
                                               const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d d = Across(direction, axis);
  const Eigen::Vector3d o = Across(origin_mm - axis_point_mm, axis);
  const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - radius_mm * radius_mm;
  const double discriminant = b * b - a * c;
  if (a < 1e-12 || discriminant <= 0) return {};
  return origin_mm + (-b - std::sqrt(discriminant)) / a * direction;
}

}  // namespace telestrain
