#include "viz/scene/scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace telestrain::viz {

std::array<Eigen::Vector3d, 4> ViewVolume::Section(double along_axis_mm) const {
  const Eigen::Vector3d middle = center_in_array_mm + along_axis_mm * axis_in_array;
  const Eigen::Vector3d u = 0.5 * width_mm * image_x_in_array;
  const Eigen::Vector3d v = 0.5 * height_mm * image_y_in_array;
  return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

bool ViewVolume::Contains(const Eigen::Vector3d& point_in_array_mm) const {
  const Eigen::Vector3d offset_mm = point_in_array_mm - center_in_array_mm;
  return std::abs(offset_mm.dot(image_x_in_array)) <= 0.5 * width_mm &&
         std::abs(offset_mm.dot(image_y_in_array)) <= 0.5 * height_mm &&
         std::abs(offset_mm.dot(axis_in_array)) <= 0.5 * depth_of_field_mm;
}

std::vector<std::string> Scene::Groups() const {
  std::vector<std::string> groups;
  for (const ViewVolume& view : views)
    if (std::find(groups.begin(), groups.end(), view.group) == groups.end())
      groups.push_back(view.group);
  return groups;
}

const PointValues* Surface::Find(const std::string& key) const {
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const PointValues& v) { return v.quantity.key == key; });
  return found == values.end() ? nullptr : &*found;
}

SceneAxes AxesOf(const Scene& scene) {
  Eigen::Vector3d towards_cameras = Eigen::Vector3d::Zero();
  for (const ViewVolume& view : scene.views) towards_cameras -= view.axis_in_array;
  SceneAxes axes;
  towards_cameras -= towards_cameras.dot(axes.along) * axes.along;
  // Views that surround the pipe have no common side; the array's z is as good as any then.
  if (towards_cameras.norm() > 1e-3) axes.up = towards_cameras.normalized();
  axes.across = axes.up.cross(axes.along);
  return axes;
}

}  // namespace telestrain::viz
