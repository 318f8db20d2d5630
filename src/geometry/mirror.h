#pragma once

#include <Eigen/Core>

namespace telestrain {

// A planar mirror: a point on it and its unit normal (either side).
struct Mirror {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();

  // Householder reflection of a direction and of a point. Applying either twice is the identity.
  Eigen::Vector3d ReflectDirection(const Eigen::Vector3d& direction) const;
  Eigen::Vector3d ReflectPoint(const Eigen::Vector3d& point_in_mm) const;
};

}  // namespace telestrain
