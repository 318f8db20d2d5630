#pragma once

#include <Eigen/Core>
#include <array>

#include "calibration/corner_arrays.h"

// Private to the calibration module: the normal equations of one board, straight from its corners.
namespace telestrain {

// Relative magnification, aspect, k1 k2 p1 p2 k3 and telecentricity, the last six scaled.
inline constexpr int kLensSize = 8;

// Coefficients are estimated as k r0^n with r0 about the field's radius and the telecentricity as
// its effect over 1 mm of depth, so that all parameters have similar sizes (MODEL.md 1.2).
inline constexpr double kScaleRadius_mm = 8.0;
inline constexpr std::array<int, 5> kRadiusPower{2, 4, 1, 1, 6};

// Which columns the residuals of a board are differentiated by.
struct GramPlan {
  bool curved = false;  // the board bends: five basis functions instead of the plane's three
  bool depth = false;   // depth has an effect: three rows of the image instead of two
  std::array<bool, kLensSize> lens_free{};
  double robust_sigmas = 0;  // scale of Cauchy's loss of a corner's whitened length; 0: squares

  int BasisCount() const { return curved ? kBasisSize : 3; }
  int RowCount() const { return depth ? 3 : 2; }
  int ImageCount() const { return BasisCount() * RowCount(); }
  int LensCount() const;
  int ColumnCount() const { return ImageCount() + LensCount() + 1; }
};
inline constexpr int kMaxColumns = 3 * kBasisSize + kLensSize + 1;

// A lens as numbers, with what its parameter block means.
struct LensNumbers {
  double unit_px_per_mm = 1;  // what a relative magnification of 1 means
  double magnification_px_per_mm = 1, aspect = 1;
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  double telecentricity_per_mm = 0;
};

// The image of a board before the lens: rows x, y (mm) and depth (mm), columns the basis.
using ImageFromBasis = Eigen::Matrix<double, 3, kBasisSize>;

// Sum of the losses of all corners: twice the board's cost.
double LossOfBoard(const CornerArrays& corners, const GramPlan& plan, const LensNumbers& lens,
                   const ImageFromBasis& image);

// R (ColumnCount square) with R^T R = [J r]^T [J r], where J holds the derivatives of the whitened
// residuals by the image's elements (row by row), then by the free lens parameters, and r, the
// residuals, is the last column; with a robust loss both are weighted, and the last row, which
// holds nothing else, also has what makes |last column|^2 the sum of the losses. Columns that
// depend on others, as far as rounding lets it be seen, are 1e-7 of their length too long.
using GramFactor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor,
                                 kMaxColumns, kMaxColumns>;
GramFactor FactorOfBoard(const CornerArrays& corners, const GramPlan& plan, const LensNumbers& lens,
                         const ImageFromBasis& image);

// [J r] itself, two rows per corner (u, v): what FactorOfBoard condenses.
Eigen::MatrixXd ColumnsOfBoard(const CornerArrays& corners, const GramPlan& plan,
                               const LensNumbers& lens, const ImageFromBasis& image);

}  // namespace telestrain
