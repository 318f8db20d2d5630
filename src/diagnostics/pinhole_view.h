#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibration/array_calibration.h"

namespace telestrain {

// One virtual camera as a conventional pinhole camera would describe it: all rays meet in one
// point, at about `working_distance_mm` before the object.
//
// A point P (array frame, mm) is at (X, Y, Z) = camera_from_array P + origin_in_camera_mm, Z > 0
// from the camera to the object. With the coordinates (x, y) = D (X / Z, Y / Z) in the plane at the
// working distance D
//   pixel = principal_px + scale_px_per_mm S Brown(x, y),    S = diag(-1, 1) when flipped, else 1
// so that the focal length is scale_px_per_mm D, and D to infinity is the telecentric view.
//
// Flip: behind an odd number of mirrors u and v are left-handed about the viewing direction. A
// telecentric view does not notice (MODEL.md 1.3), a camera with a centre of projection is no
// rotation then: u is reversed about the principal point first.
struct PinholeView {
  std::string name;
  std::string group;
  bool flipped = false;
  double working_distance_mm = 0;  // D, what the start stated; a unit for the numbers below
  double scale_px_per_mm = 0;      // focal length / D
  Eigen::Vector2d principal_px = Eigen::Vector2d::Zero();
  // Brown's k1 mm^-2, k2 mm^-4, p1 mm^-1, p2 mm^-1, k3 mm^-6 in the plane at D.
  std::array<double, 5> distortion{};
  Eigen::Matrix3d camera_from_array = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin_in_camera_mm = Eigen::Vector3d::Zero();

  double FocalLength_px() const { return scale_px_per_mm * working_distance_mm; }
  // The coefficients as OpenCV states them: without unit, of (X / Z, Y / Z).
  std::array<double, 5> DistortionOfOpenCv() const;
  void SetDistortionOfOpenCv(const std::array<double, 5>& of_slopes);
  // Nothing for a point behind the camera.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point_in_array_mm) const;
  // (x, y) of a pixel: the distortion and the flip are taken off.
  Eigen::Vector2d PlaneFromPixel(const Eigen::Vector2d& pixel) const;
};

// A view's measurement of a point.
struct PinholeMeasurement {
  int view = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// The point whose projections are nearest to the pixels (least squares, distortion taken off the
// pixels first, all pixels weighted alike): linear start, then Gauss-Newton. Nothing when the rays
// do not determine a point in front of the cameras. Throws std::logic_error for fewer than two.
std::optional<Eigen::Vector3d> Triangulate(const std::vector<PinholeView>& views,
                                           const std::vector<PinholeMeasurement>& measurements);

}  // namespace telestrain
