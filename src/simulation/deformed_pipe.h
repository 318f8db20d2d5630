#pragma once

#include <Eigen/Core>

namespace telestrain {

// A straight pipe, stretched, bent and moved.
//
// Pipe frame: x along the axis, origin on the axis in the middle between the two groups, z through
// the line that faces the instrument. A material point is named by where it is in the reference
// state: p = (s, R sin theta, R cos theta). Under the membrane strain e and the curvature k in the
// x-z plane it moves by (Saint-Venant's pure tension and bending, Poisson's ratio n)
//   u_x = e s - k s p_z
//   u_y = -n e p_y + n k p_y p_z
//   u_z = -n e p_z + k s^2 / 2 + n k (p_z^2 - p_y^2) / 2
// so that the axial strain is e - k R cos theta, and the pipe moves rigidly:
//   p_array = array_from_pipe (p + u) + origin.
struct DeformedPipe {
  double radius_mm = 0;
  double poisson_ratio = 0;
  double membrane_strain = 0;
  double curvature_per_mm = 0;
  Eigen::Matrix3d array_from_pipe = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin_in_array_mm = Eigen::Vector3d::Zero();

  Eigen::Vector3d Material(double along_mm, double angle_rad) const;
  Eigen::Vector3d Displacement_mm(const Eigen::Vector3d& material_mm) const;
  Eigen::Vector3d InArray(const Eigen::Vector3d& material_mm) const {
    return array_from_pipe * (material_mm + Displacement_mm(material_mm)) + origin_in_array_mm;
  }
  double AxialStrain(double angle_rad) const;

  // Rigid motion from `reference` to this state: p_array = rotation p_reference + translation.
  Eigen::Matrix3d RotationFrom(const DeformedPipe& reference) const {
    return array_from_pipe * reference.array_from_pipe.transpose();
  }
  Eigen::Vector3d TranslationFrom_mm(const DeformedPipe& reference) const {
    return origin_in_array_mm - RotationFrom(reference) * reference.origin_in_array_mm;
  }
};

// Where a ray meets the deformed surface.
struct SurfaceHit {
  Eigen::Vector3d material_mm = Eigen::Vector3d::Zero();
  double cos_incidence = 0;  // between the outward normal and the way back to the camera
  // Distance of the ray from the pipe's axis minus its radius: positive where the ray misses; the
  // hit is then the point of the silhouette beside it.
  double miss_mm = 0;
};

// Follows parallel rays onto a pipe, one after the other.
class PipeRays {
 public:
  // `direction_in_array` from the camera to the object.
  PipeRays(const DeformedPipe& pipe, const Eigen::Vector3d& direction_in_array);

  // The hit of the ray through this point: fixed-point iteration on the displacement until it
  // changes by less than 1e-10 mm. `displacement_mm` is the start and becomes the displacement at
  // the hit; handing on the neighbour's saves iterations.
  SurfaceHit Hit(const Eigen::Vector3d& point_in_array_mm, Eigen::Vector3d& displacement_mm) const;

 private:
  SurfaceHit HitUndeformed(const Eigen::Vector3d& point_in_pipe_mm) const;

  const DeformedPipe& pipe_;
  Eigen::Vector3d direction_in_pipe_;
  double across2_;  // squared length of the direction's part across the axis
};

}  // namespace telestrain
