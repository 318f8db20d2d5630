#include "viz/scene/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/check.h"

namespace telestrain::viz {

ParallelCamera FitCamera(const std::vector<Eigen::Vector3d>& points_in_array_mm,
                         const SceneAxes& axes, const ViewDirection& direction, const PixelBox& box,
                         double margin_px) {
  TELESTRAIN_CHECK(!points_in_array_mm.empty(), "a camera needs something to look at");
  const double azimuth = direction.azimuth_deg * std::numbers::pi / 180;
  const double elevation = direction.elevation_deg * std::numbers::pi / 180;
  ParallelCamera camera;
  const Eigen::Vector3d level = -std::cos(azimuth) * axes.across + std::sin(azimuth) * axes.along;
  camera.towards_viewer = std::cos(elevation) * level + std::sin(elevation) * axes.up;
  camera.up = std::cos(elevation) * axes.up - std::sin(elevation) * level;
  Eigen::Matrix3d picture_from_array;
  picture_from_array << camera.up.cross(camera.towards_viewer).transpose(), camera.up.transpose(),
      camera.towards_viewer.transpose();
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& point : points_in_array_mm)
    bounds.extend(Eigen::Vector3d(picture_from_array * point));
  const Eigen::Vector3d size_mm = bounds.sizes();
  const double mm_per_px =
      std::max({size_mm.x() / std::max(1.0, box.width - 2 * margin_px),
                size_mm.y() / std::max(1.0, box.height - 2 * margin_px), 1e-9});
  camera.focal_in_array_mm = picture_from_array.transpose() * bounds.center();
  camera.half_height_mm = 0.5 * box.height * mm_per_px;
  camera.depth_mm = 0.5 * size_mm.z() + 0.5 * size_mm.norm() + 1.0;
  return camera;
}

}  // namespace telestrain::viz
