#pragma once

#include <Eigen/Core>
#include <optional>

#include "correlation/subset_correlation.h"
#include "correlation/subset_moments.h"

namespace telestrain::correlation {

// What a matching is made of: the subset, the image and the limits.
struct SubsetProblem {
  SubsetView subset;
  SubsetView noise_subset;  // the same pixels with the gradients blurred once more
  // What the blur leaves of a noise variance of one.
  double reference_noise_variance = 1;
  double image_noise_variance = 1;
  SplineView spline;
  Eigen::Vector2d center_px;  // counted from the region of the other image
  Eigen::Vector2d size_px;    // of that region
  const CorrelationOptions* options;
};

// Inverse-compositional Gauss-Newton on the zero-mean normalised sum of squared differences
//   C = sum (F - s T)^2 with s = |F| / |T|, F and T without their means,
// over the six parameters (u, v, du/dx, du/dy, dv/dx, dv/dy) of a warp that is first applied to the
// reference and then inverted (Pan, Li and Tong 2013). The Hessian H = sum J J^T of the reference
// serves all iterations.
class SubsetSolver {
 public:
  explicit SubsetSolver(const SubsetProblem& problem);

  // From `start`; when that fails, once more from the best whole-pixel offset around it.
  SubsetMatch Solve(const ShapeFunction& start) const;

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  SubsetMatch Iterate(const ShapeFunction& start) const;
  std::optional<ShapeFunction> BestOffset(const ShapeFunction& start) const;
  std::optional<MatchStatus> WhyUnusable(const ShapeFunction& shape) const;
  WarpedMoments Measure(const ShapeFunction& shape) const;
  Vector6 Step(const WarpedMoments& moments) const;
  ShapeFunction Compose(const ShapeFunction& shape, const Vector6& step) const;
  // Correlation, noise and covariance at the end of the iterations.
  void Assess(const WarpedMoments& moments, SubsetMatch& match) const;

  SubsetProblem problem_;
  double half_side_px_, pixels_;
  ReferenceMoments reference_;
  bool has_contrast_ = false;
  Matrix6 inverse_hessian_ = Matrix6::Zero();  // offsets in half sides
};

}  // namespace telestrain::correlation
