#pragma once

#include <array>

namespace telestrain::correlation {

// The one pass over a subset that the matching spends its time in, for the reference and for the
// warped image. Offsets from the subset's centre are given in units of its half side, so that all
// parameters have the same scale. Rows are summed in float, the rows in double, always in the same
// order: the sums do not depend on the thread or the instruction set.

// A square subset of the reference: pointers to its top left pixel, a row is `stride` floats. Rows
// must be readable for kLanes - 1 floats beyond the subset.
struct SubsetView {
  const float* gray;
  const float* gradient_x;
  const float* gradient_y;
  int stride;
  int side_px;
};

// Spline coefficients with padding. Positions count from the first padding coefficient.
struct SplineView {
  const float* coefficients;
  int stride;
};

// Where the subset's pixels lie in the other image.
struct SubsetWarp {
  double top_left_x_px, top_left_y_px;  // of the first pixel
  double du_dx, du_dy, dv_dx, dv_dy;
};

// Sums over gradient products: of g_a g_b times (1, x, y, x^2, x y, y^2).
using ProductMoments = std::array<double, 6>;
struct GradientMoments {
  ProductMoments xx{}, xy{}, yy{};
};

// F is the grey level minus its mean, J = (gx, gy, gx x, gx y, gy x, gy y).
struct ReferenceMoments {
  double mean = 0;
  double ff = 0;
  std::array<double, 6> j{}, fj{};
};

// T is the grey level of the warped image minus the mean of the reference.
struct WarpedMoments {
  double t = 0, tt = 0, tf = 0;
  std::array<double, 6> tj{};
};

ReferenceMoments MeasureReference(const SubsetView& subset);
GradientMoments MeasureGradients(const SubsetView& subset);
// Every pixel must keep kSplineMargin from the border and the gradients must be below one.
WarpedMoments MeasureWarped(const SubsetView& subset, float mean, const SplineView& spline,
                            const SubsetWarp& warp);

}  // namespace telestrain::correlation
