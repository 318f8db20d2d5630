#pragma once

#include <Eigen/Core>
#include <optional>

#include "base/gray_image.h"
#include "session/session.h"
#include "target/board_observation.h"

namespace telestrain {

// Where a corner is thought to be and which pixels may be used: a parallelogram about `pixel` whose
// half axes lie along the corner's two edge lines (px). It must not reach the next edge.
struct SaddleStart {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d half_axis_u_px = Eigen::Vector2d::UnitX();
  Eigen::Vector2d half_axis_v_px = Eigen::Vector2d::UnitY();
  double blur_px = 1.2;
  // Directions of the two lines when they are better known than by the half axes.
  std::optional<Eigen::Vector2d> angles_rad;
};

// A corner measured by maximum likelihood.
struct SaddleFit {
  ImagePoint point;
  double contrast_gray = 0;  // half the difference between the bright and the dark squares; its
                             // sign is that of the sector between +half_axis_u and +half_axis_v
  double level_gray = 0;     // midway between the bright and the dark squares, at the corner
  double blur_px = 0;        // standard deviation of the edges' Gaussian profile
  double sigma_gray = 0;     // standard deviation of the residuals
  double angle_u_rad = 0;    // directions of the two lines
  double angle_v_rad = 0;
  int pixels = 0;
};

// Least squares of
//   I = a + g . x + (c + c' . x) E(d1/s, d2/s, n1 . n2)
// (blurred_saddle.h) over the corner's position, the two lines' directions, the blur and the six
// linear parameters: with white noise the maximum-likelihood estimate. The covariance is
// sigma^2 (J^T J)^-1 with sigma from the residuals, at least 0.3 grey (the quantisation).
// Only pixels of `region` are used. Nothing when it does not converge or leaves its window.
std::optional<SaddleFit> FitSaddle(const GrayImage& image, const PixelRegion& region,
                                   const SaddleStart& start);

}  // namespace telestrain
