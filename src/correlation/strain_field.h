#pragma once

#include <Eigen/Core>

#include "correlation/correlation_field.h"

namespace telestrain::correlation {

// Correlation of the noise of two displacements whose subsets are (dx, dy) px apart, because they
// share pixels. The displacement is a mean of (noise x gradient) over the subset, weighted by one
// for shape functions of order 0 and 1 and by 1 - 5/2 P2(x) - 5/2 P2(y) for order 2 (P2 the second
// Legendre polynomial, half sides as units); the correlation is that of the weights with
// themselves, for order 0 and 1 the share of the subset's area that both cover.
class SubsetOverlap {
 public:
  SubsetOverlap(int subset_px, int shape_order);
  double At(int dx_px, int dy_px) const;

 private:
  int side_px_, order_;
  std::vector<double> one_one_, one_two_, two_one_, two_two_;  // by shift, of P0 and P2
};

// Covariance of the two gradients (per px) of a plane fitted to displacements of unit variance on a
// whole window of `points` x `points` grid points.
Eigen::Matrix2d PlaneSlopeCovariance(int points, int step_px, const SubsetOverlap& overlap);

// Fills strain and sigma_strain of every point from the displacements and covariances of the
// points in its window: Green-Lagrange E = (F^T F - I) / 2 with F = I + gradient of the plane that
// fits best. NaN for points that failed and where fewer than options.min_strain_share of the
// window converged or all of them on one line.
void ComputeStrain(const FieldOptions& options, CorrelationField& field);

}  // namespace telestrain::correlation
