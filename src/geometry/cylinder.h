#pragma once

#include <Eigen/Core>
#include <optional>

namespace telestrain {

// An infinite circular cylinder.
struct Cylinder {
  Eigen::Vector3d axis_point_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // unit vector
  double radius_mm = 0;

  // Signed distance of a point from the surface, positive outside.
  double Distance_mm(const Eigen::Vector3d& point_mm) const;
  // Unit vector from the axis to the point; undefined on the axis itself.
  Eigen::Vector3d Normal(const Eigen::Vector3d& point_mm) const;
  double AxialCoordinate_mm(const Eigen::Vector3d& point_mm) const {
    return axis.dot(point_mm - axis_point_mm);
  }
  // Where a ray through `origin_mm` along `direction` enters the cylinder, coming from far
  // behind; nothing when it misses.
  std::optional<Eigen::Vector3d> Enter(const Eigen::Vector3d& origin_mm,
                                       const Eigen::Vector3d& direction) const;
};

}  // namespace telestrain
