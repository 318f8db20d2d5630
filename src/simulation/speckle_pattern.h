#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace telestrain {

// A rectangle of the pipe's unrolled surface: x along the pipe, y = radius * angle.
struct SurfacePatch {
  Eigen::Vector2d lower_mm = Eigen::Vector2d::Zero();
  Eigen::Vector2d upper_mm = Eigen::Vector2d::Zero();
};

// Sprayed paint: dark discs of slightly different size at random places of the unrolled surface,
// one pattern per key, covering about half of it. The discs of a square cell of the surface follow
// from the cell's number alone (Poisson, one on average), so a pattern has no border; those within
// ten diameters of a patch are gathered once.
class SpecklePattern {
 public:
  SpecklePattern(std::uint64_t key, const SurfacePatch& patch, double mean_diameter_mm);

  // Share of paint, 0 to 1, that the blurred image shows at a surface point of the patch; the blur
  // has this covariance C in surface coordinates. A disc's share is the probability that a point,
  // normal around the place p relative to the disc's middle, falls inside. Its squared distance has
  // the mean |p|^2 + tr C and the variance 2 tr C^2 + 4 p^T C p; its distance is taken as the
  // normal deviate whose square has the same two. For a straight edge of normal n this is exact,
  // with the variance n^T C n. Overlapping discs multiply.
  double Paint(const Eigen::Vector2d& point_mm, const Eigen::Matrix2d& cov_blur_mm2) const;

 private:
  void FillCell(std::uint64_t key, int column, int row);
  double mean_radius_mm_;
  double cell_mm_;
  int first_column_ = 0, first_row_ = 0, columns_ = 0, rows_ = 0;
  std::vector<int> first_;  // per cell, row by row, and one past the last: index of its first disc
  std::vector<double> x_mm_, y_mm_;  // per disc
  std::vector<float> radius_mm_;
};

}  // namespace telestrain
