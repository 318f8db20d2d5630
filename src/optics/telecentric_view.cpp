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
  return lens.PixelFromIdeal(view.Ideal(point_in_array_mm));
}

Eigen::Matrix<double, 2, 3> ProjectJacobian(const TelecentricLens& lens,
                                            const TelecentricView& view,
                                            const Eigen::Vector3d& point_in_array_mm) {
  return lens.magnification_px_per_mm * lens.DistortJacobian(view.Ideal(point_in_array_mm)) *
         view.axes_in_array;
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
  return view;
}

}  // namespace telestrain
