#pragma once

#include <Eigen/Core>

namespace telestrain {

// Strains of the outer surface: along the fibre that was parallel to the axis, along the one around
// the pipe, and the change of the right angle between them (positive when points turn to larger
// angles with growing x). All relative to the same pipe without load.
struct SurfaceStrain {
  double axial = 0, hoop = 0, shear = 0;
};

// A straight or bent pipe, loaded and moved.
//
// Pipe frame: x along the axis, origin on the axis in the middle between the two groups, z through
// the line that faces the instrument. A material point is named by where it is on the straight,
// unloaded pipe: p = (s, R sin theta, R cos theta). Loads add up their displacements:
//   tension e and bending k (curvature in the plane at the angle `curvature_angle_rad`; here 0, the
//   x-z plane), Saint-Venant, Poisson's ratio n:
//     u = (e s - k s z,  -n e y + n k y z,  -n e z + k s^2 / 2 + n k (z^2 - y^2) / 2)
//   pressure inside closed ends, Lame's thick wall at the outer surface (PressureStrains):
//     u = (a s, h y, h z)
//   free thermal expansion t:
//     u = t p
//   torsion, Saint-Venant: every section turns rigidly by phi = twist s, so that the surface shears
//   by R twist (as a finite rotation: an infinitesimal one would widen the pipe by phi^2 / 2)
//     u = (0, y cos phi + z sin phi - y, z cos phi - y sin phi - z)
// A bent pipe then lays its axis along the arc c(s) = (B sin(s/B), 0, B (1 - cos(s/B))), its
// sections across it, and the pipe moves rigidly:
//   p_array = array_from_pipe Bend(p + u) + origin.
struct DeformedPipe {
  double radius_mm = 0;
  double poisson_ratio = 0;
  double bend_radius_mm = 0;  // B; 0: straight, positive: towards the instrument
  double membrane_strain = 0;
  double curvature_per_mm = 0;
  double curvature_angle_rad = 0;  // of the direction to which the axis bends, as theta above
  double pressure_axial_strain = 0, pressure_hoop_strain = 0;
  double thermal_strain = 0;
  double twist_rad_per_mm = 0;
  Eigen::Matrix3d array_from_pipe = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin_in_array_mm = Eigen::Vector3d::Zero();

  Eigen::Vector3d Material(double along_mm, double angle_rad) const;
  Eigen::Vector3d Displacement_mm(const Eigen::Vector3d& material_mm) const;
  Eigen::Vector3d Bend(const Eigen::Vector3d& straight_mm) const;
  // Columns: along the bent axis, across the plane of bending, towards the arc's centre if B > 0.
  Eigen::Matrix3d BendRotation(double along_mm) const;
  Eigen::Vector3d InPipe(const Eigen::Vector3d& material_mm) const {
    return Bend(material_mm + Displacement_mm(material_mm));
  }
  Eigen::Vector3d InArray(const Eigen::Vector3d& material_mm) const {
    return array_from_pipe * InPipe(material_mm) + origin_in_array_mm;
  }
  // From the exact gradient of the map above, not linearised.
  SurfaceStrain StrainAt(double along_mm, double angle_rad) const;
  // What a gauge in the middle of the pipe reads; thermal expansion included (apparent strain).
  double AxialStrain(double angle_rad) const { return StrainAt(0, angle_rad).axial; }

  // Rigid motion from `reference` to this state: p_array = rotation p_reference + translation.
  Eigen::Matrix3d RotationFrom(const DeformedPipe& reference) const {
    return array_from_pipe * reference.array_from_pipe.transpose();
  }
  Eigen::Vector3d TranslationFrom_mm(const DeformedPipe& reference) const {
    return origin_in_array_mm - RotationFrom(reference) * reference.origin_in_array_mm;
  }

 private:
  // Columns: x, then y and z of a pipe that is turned so that it bends in its x-z plane.
  Eigen::Matrix3d BendingAxes() const;
  Eigen::Vector3d BendingDisplacement_mm(const Eigen::Vector3d& material_mm) const;
  Eigen::Matrix3d DisplacementGradient(const Eigen::Vector3d& material_mm) const;
  double UniformAxial() const { return membrane_strain + pressure_axial_strain + thermal_strain; }
  double UniformAcross() const {
    return -poisson_ratio * membrane_strain + pressure_hoop_strain + thermal_strain;
  }
};

}  // namespace telestrain
