#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "geometry/mirror.h"
#include "optics/telecentric_lens.h"

namespace telestrain {

// One virtual telecentric camera: parallel rays, no centre of projection (but see ImageRay).
//
// A point P (array frame, mm) has the image-plane coordinates
//   ideal_mm = axes_in_array P + offset_mm
// where the rows of axes_in_array are the orthonormal object directions along which u and v grow.
// The position along the viewing axis has no effect on any pixel of a telecentric lens. For a lens
// that is not quite telecentric the view also knows which way depth grows and where it is zero.
struct TelecentricView {
  std::string name;
  std::string group;
  Eigen::Matrix<double, 2, 3> axes_in_array = Eigen::Matrix<double, 2, 3>::Identity();
  Eigen::Vector2d offset_mm = Eigen::Vector2d::Zero();
  double depth_sense = 1;      // +1 where r1 x r2 points from the camera to the object, else -1
  double depth_offset_mm = 0;  // depth of the array's origin; the nominal centre has depth 0

  // Rotation with rows r1, r2, r1 x r2. The third row is the direction of the rays up to its sign:
  // an odd number of mirrors makes it point from the object to the camera (MODEL.md 1.3).
  Eigen::Matrix3d Rotation() const;
  Eigen::Vector3d RayDirection() const { return Rotation().row(2).transpose(); }
  // Unit, from the camera to the object: the way depth grows.
  Eigen::Vector3d ViewingDirection() const { return depth_sense * RayDirection(); }

  Eigen::Vector2d Ideal(const Eigen::Vector3d& point_in_array_mm) const {
    return axes_in_array * point_in_array_mm + offset_mm;
  }
  // Distance beyond the plane of unit scale, away from the camera.
  double Depth_mm(const Eigen::Vector3d& point_in_array_mm) const {
    return depth_sense * RayDirection().dot(point_in_array_mm) + depth_offset_mm;
  }
  // A point on the ray of these image-plane coordinates: the one nearest to the array's origin.
  Eigen::Vector3d PointOnRay(const Eigen::Vector2d& ideal_mm) const {
    return axes_in_array.transpose() * (ideal_mm - offset_mm);
  }
};

Eigen::Vector2d Project(const TelecentricLens& lens, const TelecentricView& view,
                        const Eigen::Vector3d& point_in_array_mm);

// d(pixel)/d(point), 2x3, px per mm.
Eigen::Matrix<double, 2, 3> ProjectJacobian(const TelecentricLens& lens,
                                            const TelecentricView& view,
                                            const Eigen::Vector3d& point_in_array_mm);

// All points that one pixel shows. Rays of a telecentric lens are parallel; with a residual
// telecentricity kappa they lean with the distance from the lens's axis. From MODEL.md Eq. 3
//   P(z) = A^T (q (1 + kappa z) - t) + s r3 (z - depth_offset),    q: the ideal image of the pixel
// is linear in the depth z (mm, TelecentricView::Depth_mm).
struct ImageRay {
  Eigen::Vector3d point_in_array_mm;   // in the plane across the viewing direction and the origin
  double depth_mm;                     // of that point
  Eigen::Vector3d direction_in_array;  // away from the camera, one mm of depth long

  Eigen::Vector3d At(double depth_mm_of_point) const {
    return point_in_array_mm + (depth_mm_of_point - depth_mm) * direction_in_array;
  }
};

// Project() puts every point of the ray at `pixel`.
ImageRay RayOfPixel(const TelecentricLens& lens, const TelecentricView& view,
                    const Eigen::Vector2d& pixel);

// The physical camera in front of the mirrors: a point `position_mm` on its optical axis, the
// viewing direction and the object directions along which u and v grow without mirrors.
struct PhysicalCamera {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d image_x = Eigen::Vector3d::UnitX();
  Eigen::Vector3d image_y = Eigen::Vector3d::UnitY();
};

// The virtual camera that `camera` becomes behind `mirrors`, in the order in which light meets them
// on its way from the lens to the object (MODEL.md 1.3: Householder reflections).
PhysicalCamera ReflectCamera(PhysicalCamera camera, const std::vector<Mirror>& mirrors);

// The view of a camera whose optical axis passes through camera.position_mm.
TelecentricView ViewOfCamera(const PhysicalCamera& camera);

}  // namespace telestrain
