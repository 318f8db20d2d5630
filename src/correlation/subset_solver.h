#pragma once

#include <Eigen/Core>

#include "correlation/saturation.h"
#include "correlation/subset_correlation.h"
#include "correlation/subset_moments.h"

namespace telestrain::correlation {

// What a matching is made of: the subset, the image and the limits.
struct SubsetProblem {
  SubsetView subset;
  Eigen::Vector2d noise_shares;  // see NoiseShares
  // What the blur leaves of a noise variance of one.
  double reference_noise_variance = 1;
  double image_noise_variance = 1;
  SplineView spline;
  Eigen::Vector2d center_px;  // counted from the region of the other image
  Eigen::Vector2d size_px;    // of that region
  bool white = false;         // the subset is saturated at the upper end
  bool saturated = false;     // or at either one
  const Saturation* image_saturation = nullptr;
  const CorrelationOptions* options = nullptr;
  int threads = 1;  // that share the rows
};

// Inverse-compositional Gauss-Newton on the zero-mean normalised sum of squared differences
//   C = sum (F - s T)^2 with s = |F| / |T|, F and T without their means,
// over the parameters of a warp that is first applied to the reference and then inverted (Pan, Li
// and Tong 2013; second order: Gao et al. 2015). The Hessian H = sum J J^T of the reference serves
// all iterations. From `start`; when that fails, once more from the best whole-pixel offset around
// it.
SubsetMatch SolveSubset(const SubsetProblem& problem, const ShapeFunction& start);

}  // namespace telestrain::correlation
