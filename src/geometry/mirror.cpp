#include "geometry/mirror.h"

namespace telestrain {

Eigen::Vector3d Mirror::ReflectDirection(const Eigen::Vector3d& direction) const {
  return direction - 2.0 * normal.dot(direction) * normal;
}

Eigen::Vector3d Mirror::ReflectPoint(const Eigen::Vector3d& point_in_mm) const {
  return point_in_mm - 2.0 * normal.dot(point_in_mm - point_mm) * normal;
}

}  // namespace telestrain
