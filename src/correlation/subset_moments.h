#pragma once

#include <cstddef>
#include <cstdint>

namespace telestrain::correlation {

// The passes over a subset that the matching spends its time in, for the reference and for the
// warped image. Offsets from the subset's centre are given in units of its half side, so that all
// parameters have the same scale. Bands of rows are summed in float, the bands in double, always in
// the same order: the sums do not depend on the thread, nor on AVX2 or AVX-512.

inline constexpr int kLargestBasis = 6;  // 1, x, y, x^2 / 2, x y, y^2 / 2
inline constexpr int kBandRows = 40;     // the most rows that are summed in float

// Number of terms of the basis that a shape function of the order has.
constexpr int BasisSize(int order) { return order == 0 ? 1 : order == 1 ? 3 : 6; }

// A square subset of the reference: pointers to its top left pixel, a row is `stride` floats and
// readable for 15 floats beyond the subset.
struct SubsetView {
  const float* gray;
  const float* gradient_x;
  const float* gradient_y;
  std::ptrdiff_t stride;
  int side_px;
  // Bit k of a row's words is the pixel k columns right of the region's border; null: all count.
  const std::uint64_t* mask;
  std::ptrdiff_t mask_words;  // of a row
  int left_px;                // of the subset in the region
};

// Spline coefficients with padding. Positions count from the first padding coefficient.
struct SplineView {
  const float* coefficients;
  std::ptrdiff_t stride;
  int degree;
};

// Where the subset's pixels lie in the other image: offset (x, y) from the centre, here in px, is
// found at x_px + x + u . (1, x, y, x^2 / 2, x y, y^2 / 2) without the first term, and so on.
struct SubsetWarp {
  double x_px, y_px;
  double u[kLargestBasis], v[kLargestBasis];
};

// F is the grey level minus `mean`, b the basis: sums over gx b, gy b, F gx b, F gy b, and of
// gx gx, gx gy and gy gy times x^a y^b, a + b <= 4.
struct ReferenceMoments {
  double pixels = 0, mean = 0, ff = 0;
  double jx[kLargestBasis] = {}, jy[kLargestBasis] = {};
  double fjx[kLargestBasis] = {}, fjy[kLargestBasis] = {};
  double xx[5][5] = {}, xy[5][5] = {}, yy[5][5] = {};
};

// T is the grey level of the warped image minus the mean of the reference.
struct WarpedMoments {
  double t = 0, tt = 0, tf = 0;
  double tjx[kLargestBasis] = {}, tjy[kLargestBasis] = {};
};

// Fixed division of a subset's rows.
constexpr int BandCount(int side_px) { return (side_px + kBandRows - 1) / kBandRows; }
constexpr int FirstRowOfBand(int side_px, int band) {
  return static_cast<int>(static_cast<std::int64_t>(side_px) * band / BandCount(side_px));
}

// What a shape function, a mask and an image's degree select among the compiled passes.
ReferenceMoments MeasureReference(const SubsetView& subset, int order);
// One band. Every pixel must keep kSplineMargin from the border.
WarpedMoments MeasureWarpedBand(const SubsetView& subset, float mean, const SplineView& spline,
                                const SubsetWarp& warp, int order, int band);
WarpedMoments operator+(const WarpedMoments& a, const WarpedMoments& b);

}  // namespace telestrain::correlation
