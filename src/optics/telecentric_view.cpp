#include "optics/telecentric_view.h"

#include <Eigen/Geometry>

#include "geometry/rotation.h"

namespace telestrain {

Eigen::Matrix3d TelecentricView::Rotation() const {
  Eigen::Matrix3d rotation;
  rotation.topRows<2>() = axes_in_array;
  rotation.row(2) = rotation.row(0).cross(rotation.row(1));
  return rotation;
}

Eigen::Vector2d Project(const TelecentricLens& lens, const TelecentricView& view,
                        const Eigen::Vector3d& point_in_array_mm) {
  const double shrink = 1 + lens.telecentricity_per_mm * view.Depth_mm(point_in_array_mm);
  return lens.PixelFromIdeal(view.Ideal(point_in_array_mm) / shrink);
}

Eigen::Matrix<double, 2, 3> ProjectJacobian(const TelecentricLens& lens,
                                            const TelecentricView& view,
                                            const Eigen::Vector3d& point_in_array_mm) {
  const double shrink = 1 + lens.telecentricity_per_mm * view.Depth_mm(point_in_array_mm);
  const Eigen::Vector2d ideal = view.Ideal(point_in_array_mm) / shrink;
  const Eigen::Matrix<double, 2, 3> ideal_by_point =
      (view.axes_in_array -
       lens.telecentricity_per_mm * ideal * view.ViewingDirection().transpose()) /
      shrink;
  return lens.Scales_px_per_mm().asDiagonal() * lens.DistortJacobian(ideal) * ideal_by_point;
}

ImageRay RayOfPixel(const TelecentricLens& lens, const TelecentricView& view,
                    const Eigen::Vector2d& pixel) {
  const double kappa = lens.telecentricity_per_mm;
  const Eigen::Vector2d ideal = lens.IdealFromPixel(pixel);
  return {view.PointOnRay(ideal * (1 + kappa * view.depth_offset_mm)), view.depth_offset_mm,
          view.ViewingDirection() + kappa * view.axes_in_array.transpose() * ideal};
}

PhysicalCamera ReflectCamera(PhysicalCamera camera, const std::vector<Mirror>& mirrors) {
  for (const Mirror& mirror : mirrors) {
    camera.position_mm = mirror.ReflectPoint(camera.position_mm);
    camera.axis = mirror.ReflectDirection(camera.axis);
    camera.image_x = mirror.ReflectDirection(camera.image_x);
    camera.image_y = mirror.ReflectDirection(camera.image_y);
  }
  return camera;
}

TelecentricView ViewOfCamera(const PhysicalCamera& camera) {
  TelecentricView view;
  view.axes_in_array = RotationFromRows(camera.image_x, camera.image_y).topRows<2>();
  view.offset_mm = -view.axes_in_array * camera.position_mm;
  view.depth_sense = view.RayDirection().dot(camera.axis) < 0 ? -1 : 1;
  return view;
}

}  // namespace telestrain
