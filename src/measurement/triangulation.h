#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/array_calibration.h"

namespace telestrain {

// One view's measurement of a point: pixel on the whole sensor and its covariance.
struct ViewMeasurement {
  int view = 0;  // index into ArrayCalibration::views
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
};

struct TriangulatedPoint {
  Eigen::Vector3d in_array_mm = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_mm2 = Eigen::Matrix3d::Zero();  // from the pixels alone
  // Largest distance of a measured pixel from the point's projection. With two views this is half
  // the epipolar error, the only redundancy that telecentric stereo has (MODEL.md 7).
  double residual_px = 0;
};

// Least-squares intersection of the rays of two or more views (MODEL.md Eq. 13), in mm of the
// object: all pixels weighted alike where all views have one scale, so that displacements are
// linear in the pixels. With a residual telecentricity kappa the equations stay linear in the
// point,
//   (A - kappa s q r3^T) P = q (1 + kappa depth_offset) - t,    q: the ideal image of the pixel
// and a view counts by 1 + kappa depth, which is the same for all views to 1e-3. Throws
// std::logic_error for fewer than two measurements or views that look along the same direction.
TriangulatedPoint Triangulate(const ArrayCalibration& array,
                              const std::vector<ViewMeasurement>& measurements);

}  // namespace telestrain
