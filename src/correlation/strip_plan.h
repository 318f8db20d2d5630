#pragma once

#include "correlation/column_sums.h"
#include "correlation/spline.h"

// How a subset is divided into strips for the interpolation, and what a strip is prepared in. Only
// for kernels_*.cpp.
namespace telestrain::correlation {
namespace {

constexpr int kMostVectors = 4;
constexpr int kMostTerms = 4;
// Way in y from a row's middle up to which 1, 2, 3 or 4 terms leave less than 1e-4 times the first
// neglected derivative: (limit)^terms / terms!.
constexpr float kTermLimits_px[kMostTerms] = {1e-5f, 0.01f, 0.05f, 0.2f};
// Way out of the cell: 0.15^5 / 5! and 0.02^3 / 3! are about 1e-6.
template <int kDegree>
constexpr float kWayOut_px = kDegree == 5 ? 0.15f : 0.02f;

template <int kValue>
struct Terms {
  static constexpr int value = kValue;
};

struct StripBuffer {
  alignas(64) float values[kBandRows * 3 * (kMostVectors + 1) * kWide];
  const float* first[kBandRows];
  alignas(64) float fraction_x[kBandRows + 8], fraction_y[kBandRows + 8];
  float slope_x[kBandRows + 8], slope_y[kBandRows + 8];
  alignas(64) float weights[kMostTerms][6][kBandRows + 8];
};

// Position, and how it changes along the row, of the pixel at an offset from the subset's centre.
struct Place {
  double at_px, slope, bend;  // at + d (1 + slope) + d^2 bend
};
template <int kOrder>
TELESTRAIN_INLINE Place PlaceOf(double at_px, const double (&w)[kLargestBasis], double x,
                                double y) {
  Place place{at_px, 0, 0};
  if constexpr (kOrder > 0) {
    place.at_px += w[1] * x + w[2] * y;
    place.slope = w[1];
  }
  if constexpr (kOrder > 1) {
    place.at_px += 0.5 * w[3] * x * x + w[4] * x * y + 0.5 * w[5] * y * y;
    place.slope += w[3] * x + w[4] * y;
    place.bend = 0.5 * w[3];
  }
  return place;
}

TELESTRAIN_INLINE float Magnitude(float value) { return value < 0 ? -value : value; }

// Terms for a way in y from the middle of a strip's row; 0 where none are enough.
TELESTRAIN_INLINE int TermsFor(float way_px, int vectors) {
  for (int terms = 1; terms <= (vectors == 1 ? kMostTerms : kMostTerms - 1); ++terms)
    if (way_px <= kTermLimits_px[terms - 1]) return terms;
  return 0;
}

// Along x, in any row of the subset.
template <int kOrder>
TELESTRAIN_INLINE float SteepestSlope(const double (&w)[kLargestBasis], int side_px) {
  float slope = kOrder > 0 ? Magnitude(static_cast<float>(w[1])) : 0.f;
  if (kOrder > 1)
    for (int k = 3; k <= 4; ++k)
      slope += static_cast<float>(side_px / 2) * Magnitude(static_cast<float>(w[k]));
  return slope;
}

// Columns of the strips that cost least: wide ones share the columns beyond their ends, narrow ones
// need fewer terms. Counted are the products for a pixel's vector, and as many as a strip's row
// costs by itself.
template <int kDegree, int kOrder>
TELESTRAIN_INLINE int StripWidth(const SubsetWarp& warp, int side_px) {
  constexpr float kProductsPerRow = 20;
  const float slope_x = SteepestSlope<kOrder>(warp.u, side_px);
  const float slope_y = SteepestSlope<kOrder>(warp.v, side_px);
  int best = 1;
  float least = 1e30f;
  for (int vectors = Lesser(kMostVectors, (side_px + kWide - 1) / kWide); vectors > 0; --vectors) {
    const float reach = static_cast<float>(vectors * kWide / 2);
    const int terms = TermsFor(slope_y * reach, vectors);
    if (terms == 0 || slope_x * reach > kTermLimits_px[2]) continue;
    const float strips = 1 / static_cast<float>(vectors);
    const float cost =
        static_cast<float>(terms * (kDegree + 1)) * (2 + strips) + kProductsPerRow * strips;
    if (cost < least) least = cost, best = vectors;
  }
  return best * kWide;
}

}  // namespace
}  // namespace telestrain::correlation
