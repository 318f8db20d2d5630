#pragma once

#include <Eigen/Core>
#include <cmath>

namespace telestrain {

// What blurs the image of one view, in image-plane coordinates q (mm on the object side).
struct ViewBlur {
  // Lens, diffraction, pixel aperture and vibration, taken as one Gaussian.
  Eigen::Matrix2d cov_fixed_mm2 = Eigen::Matrix2d::Zero();
  // Standard deviation, per axis, of the slopes (a, b) of the rays through a Gaussian pupil: half
  // the numerical aperture, the variance of a uniform disc. 0: no defocus.
  double pupil_sigma = 0;

  // On a surface that faces the camera, this far beyond the focus plane.
  Eigen::Matrix2d CovAt_mm2(double depth_mm) const {
    const double defocus_mm = pupil_sigma * depth_mm;
    return cov_fixed_mm2 + defocus_mm * defocus_mm * Eigen::Matrix2d::Identity();
  }
};

// The blur of a plane (plate): how uncertain its two coordinates are at one pixel.
//
// A pixel whose chief ray meets the plane at q, the depth z beyond focus, has the pupil rays
//   q + lambda (a, b),  lambda = z / (1 - tau.(a, b))
// where tau = dz/dq is the plane's slope. Such a ray lands beyond the edge n.q = const, which is
// the distance D ahead, exactly when (z n + D tau).(a, b) > D. For a Gaussian pupil the edge is
// therefore blurred by the variance pupil_sigma^2 |z n + D tau|^2, without any approximation, and
// two edges by the covariance of their linear forms; the fixed blur adds n^T C n. Residual
// telecentricity changes these widths by less than |q| |tau| of its value per mm, neglected.
class PlaneBlur {
 public:
  // Beyond it the blur of an edge is below 6e-7 of the contrast.
  static constexpr double kFarFromEdge_sigma = 5;

  // `plane_from_ideal` has the rows n of the two plane coordinates.
  PlaneBlur(const ViewBlur& blur, const Eigen::Matrix2d& plane_from_ideal,
            const Eigen::Vector2d& depth_gradient)
      : cov_fixed_mm2_(plane_from_ideal * blur.cov_fixed_mm2 * plane_from_ideal.transpose()),
        normals_(blur.pupil_sigma * plane_from_ideal.transpose()),
        slope_(blur.pupil_sigma * depth_gradient),
        fixed_reach_mm_(kFarFromEdge_sigma * cov_fixed_mm2_.diagonal().cwiseSqrt()),
        reach_per_mm_(kFarFromEdge_sigma * normals_.colwise().norm().transpose()),
        stretch_(1 / (1 - kFarFromEdge_sigma * slope_.norm())) {}

  // Of coordinate `axis` (0, 1) for an edge `distance_mm` ahead.
  double Variance_mm2(int axis, double depth_mm, double distance_mm) const {
    return cov_fixed_mm2_(axis, axis) + Form(axis, depth_mm, distance_mm).squaredNorm();
  }
  // Edges farther than this are not seen in the pixel: more than kFarFromEdge_sigma away.
  double Reach_mm(int axis, double depth_mm) const {
    return stretch_ * (fixed_reach_mm_[axis] + std::abs(depth_mm) * reach_per_mm_[axis]);
  }
  // Between the coordinates, for an edge of either.
  double Covariance_mm2(double depth_mm, double distance_x_mm, double distance_y_mm) const {
    return cov_fixed_mm2_(0, 1) +
           Form(0, depth_mm, distance_x_mm).dot(Form(1, depth_mm, distance_y_mm));
  }

 private:
  Eigen::Vector2d Form(int axis, double depth_mm, double distance_mm) const {
    return depth_mm * normals_.col(axis) + distance_mm * slope_;
  }

  Eigen::Matrix2d cov_fixed_mm2_;
  Eigen::Matrix2d normals_;  // columns, in pupil sigmas
  Eigen::Vector2d slope_;
  Eigen::Vector2d fixed_reach_mm_, reach_per_mm_;
  double stretch_;  // of the reach, by the blur that grows with the distance
};

}  // namespace telestrain
