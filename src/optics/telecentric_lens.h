#pragma once

#include <Eigen/Core>
#include <array>

namespace telestrain {

// The physical lens.
//
// Object-side image-plane coordinates (x, y) are in mm from the optical axis; with r2 = x^2 + y^2
//   x' = x (1 + k1 r2 + k2 r2^2 + k3 r2^3) + 2 p1 x y + p2 (r2 + 2 x^2)
//   y' = y (1 + k1 r2 + k2 r2^2 + k3 r2^3) + p1 (r2 + 2 y^2) + 2 p2 x y
//   pixel = center_px + magnification_px_per_mm (x', aspect y')
// (MODEL.md Eq. 1, 2; the paper's Eq. 2 with Brown's coefficients, ideal to observed.) A lens that
// is not perfectly telecentric also scales with depth: (x, y) = (A P + t) / (1 + telecentricity z)
// with z beyond the view's plane of unit scale (TelecentricView::Depth_mm; MODEL.md Eq. 3).
struct TelecentricLens {
  double magnification_px_per_mm = 0;
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();  // middle of the sensor: fixed, a gauge
  std::array<double, 5> distortion{};  // k1 mm^-2, k2 mm^-4, p1 mm^-1, p2 mm^-1, k3 mm^-6
  double aspect = 1;                   // scale along v over scale along u
  double telecentricity_per_mm = 0;    // residual: relative change of the object side with depth

  Eigen::Vector2d Scales_px_per_mm() const {
    return {magnification_px_per_mm, magnification_px_per_mm * aspect};
  }
  Eigen::Vector2d Distort(const Eigen::Vector2d& ideal_mm) const;
  // Inverse of Distort by Newton's method; exact to 1e-13 mm for distortions below 10 %.
  Eigen::Vector2d Undistort(const Eigen::Vector2d& observed_mm) const;
  // d(Distort)/d(ideal), 2x2.
  Eigen::Matrix2d DistortJacobian(const Eigen::Vector2d& ideal_mm) const;

  Eigen::Vector2d PixelFromIdeal(const Eigen::Vector2d& ideal_mm) const {
    return center_px + Scales_px_per_mm().cwiseProduct(Distort(ideal_mm));
  }
  Eigen::Vector2d IdealFromPixel(const Eigen::Vector2d& pixel) const {
    return Undistort((pixel - center_px).cwiseQuotient(Scales_px_per_mm()));
  }
};

}  // namespace telestrain
