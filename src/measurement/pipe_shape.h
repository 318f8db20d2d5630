#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/cylinder.h"

namespace telestrain {

// A straight pipe, or one whose axis is an arc of a circle, with a frame of its own (array frame,
// mm). `along` is the axis where it is nearest to the array's origin and points to the array's x;
// the angle about the axis is 0 towards `at_0` and 90 degrees towards `at_90`. At the place s along
// the axis and across it (y towards at_90, z towards at_0) the straight pipe has the coordinates
// (s, y, z).
struct PipeShape {
  Eigen::Vector3d origin_in_array_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  Eigen::Vector3d at_90 = Eigen::Vector3d::UnitY();
  Eigen::Vector3d at_0 = Eigen::Vector3d::UnitZ();
  double radius_mm = 0;
  // Of the axis, towards at_90 and at_0: the arc's middle lies there. Zero: straight.
  Eigen::Vector2d curvature_per_mm = Eigen::Vector2d::Zero();

  bool IsBent() const { return curvature_per_mm != Eigen::Vector2d::Zero(); }
  // From the array to (s, y, z), and back.
  Eigen::Vector3d Straighten(const Eigen::Vector3d& in_array_mm) const;
  Eigen::Vector3d InArray(const Eigen::Vector3d& straight_mm) const;
  // Columns: the directions of s, y and z in the array at this place along the axis.
  Eigen::Matrix3d AxesAt(double along_mm) const;
  // Directions in the array at the surface point with these coordinates: along the pipe, towards
  // growing angle, outwards; orthonormal.
  Eigen::Matrix3d SurfaceAxes(const Eigen::Vector3d& straight_mm) const;
  // Distance from the surface, positive outside.
  double Distance_mm(const Eigen::Vector3d& in_array_mm) const {
    return Straighten(in_array_mm).tail<2>().norm() - radius_mm;
  }
};

// The shape of a located cylinder. `viewing` is the mean viewing direction of the views (from the
// camera to the object): angle 0 faces the instrument, 90 degrees the array's y (or z, when the
// instrument looks along the array's y).
PipeShape ShapeOf(const Cylinder& cylinder, const Eigen::Vector3d& viewing);

// The shape that differs by `change`: shifts towards at_90 and at_0 (mm), tilts of the axis towards
// them (rad), radius (mm) and the two curvatures (1/mm).
PipeShape Changed(const PipeShape& shape, const Eigen::Matrix<double, 7, 1>& change);

struct ShapeFit {
  PipeShape shape;
  Eigen::Matrix<double, 7, 7> covariance;  // of `change` above; from the scatter about the fit
  double squares_mm2 = 0;                  // sum over the points used
  int used = 0;
  bool ok = false;
};

// Least squares through surface points from `start`; with `bent` the curvatures are estimated too,
// else they stay as they are. Points further off than `limit_mm` are left out. Not ok when the
// points do not determine the shape.
ShapeFit FitShape(const std::vector<Eigen::Vector3d>& points_in_array_mm, const PipeShape& start,
                  bool bent, double limit_mm);

}  // namespace telestrain
