#pragma once

#include <Eigen/Core>

#include "correlation/subset_correlation.h"

namespace telestrain::correlation {

// A material point of the first reference on the current one. Covariances are those of
// (u, v, du/dx, du/dy, dv/dx, dv/dy) between the first and the current reference.
struct ChainedPoint {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  bool known = true;  // where it lies
  Eigen::Vector2i first_center_px = Eigen::Vector2i::Zero();
  Eigen::Vector2i center_px = Eigen::Vector2i::Zero();  // nearest pixel of the current reference
  Eigen::Vector2d offset_px = Eigen::Vector2d::Zero();  // of the point from that pixel
  ShapeFunction from_first;                             // displacement so far
  Matrix6 covariance = Matrix6::Zero();
  // The part of it that the noise of the current reference made when it was the target.
  Matrix6 target_noise = Matrix6::Zero();
  // Share of the noise that the point's subset now has in common with the one before, as a
  // correlation coefficient.
  double shared = 0;
};

// A point of the first reference itself.
ChainedPoint FirstLink(const Eigen::Vector2i& center_px);

// From the first reference to the image, of a match of the point's subset on the current reference.
// With d the offset, the point goes to center + d + u + G d + curvature(d); deformation gradients
// multiply. Of covariances, J_b those so far and J_m that of the match, the sum is
//   J_b C J_b' + J_m M J_m' - shared (J_b T J_b' + J_m M/2 J_m'):
// noise of the current reference moved the point one way when it was the target (T) and moves it
// back now (half of the match's noise M), as far as both subsets hold the same pixels.
SubsetMatch Compose(const ChainedPoint& point, const SubsetMatch& match);

// The point on a new reference, the image of `match`.
ChainedPoint NextLink(const ChainedPoint& point, const SubsetMatch& match, int subset_px);

// The shape function on the current reference that composes to `total`.
ShapeFunction StartFor(const ChainedPoint& point, const ShapeFunction& total);

// Correlation of the noise in a square subset and in one that `gradient` deformed, both about the
// same point but for `offset_px`: common area over the root of the product of both areas.
double SharedNoise(const Eigen::Matrix2d& gradient, const Eigen::Vector2d& offset_px,
                   int subset_px);

}  // namespace telestrain::correlation
