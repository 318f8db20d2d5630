#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

#include "base/gray_image.h"
#include "session/session.h"
#include "target/corner_lattice.h"
#include "target/saddle_fit.h"

namespace telestrain {

// A grid whose corners have been measured and agree with each other; not yet labelled. Its origin,
// sense and order are those of the lattice that it was made from.
struct CornerGrid {
  std::map<LatticeIndex, SaddleFit> corners;
  LatticeIndex first{0, 0}, last{0, 0};  // bounding box of the corners
  // pixel = shape (1, i, j, i^2, i j, j^2) with (i, j) from the box's middle; affine with fewer
  // than 24 corners.
  Eigen::Matrix<double, 2, 6> shape = Eigen::Matrix<double, 2, 6>::Zero();
  // Medians over the corners; the contrast is half the difference bright - dark, positive.
  double contrast_gray = 0, sigma_gray = 0, blur_px = 0;
  // +1 when the square between the corners (i, j) and (i + 1, j + 1) is bright for even i + j.
  int phase = 1;

  int Count() const { return static_cast<int>(corners.size()); }
  int Width() const { return last.first - first.first + 1; }
  int Height() const { return last.second - first.second + 1; }
  int Extent(int axis) const { return axis == 0 ? Width() : Height(); }
  bool IsBright(int i, int j) const { return ((i + j) % 2 == 0 ? phase : -phase) > 0; }
  // Where the grid's point (i, j) is or should be, and the sides of a square there.
  Eigen::Vector2d At(double i, double j) const;
  Eigen::Matrix2d Axes_px() const { return shape.middleCols<2>(1); }
};

// Fits every place of the lattice's box, also those without a candidate. Fits that differ from the
// board's others in residual, contrast, polarity, blur or place are left out: dust, a cover's edge,
// a shadow's. End lines with fewer than three corners are left out too, since chance may make them.
CornerGrid MeasureGrid(const GrayImage& image, const PixelRegion& region,
                       const CornerLattice& lattice);

// Why the grid's corners cannot be used: too few, too blurred, saturated, or nothing that crossing
// edges explain; empty when they can.
std::string WhyUnfit(const GrayImage& image, const CornerGrid& grid);

}  // namespace telestrain
