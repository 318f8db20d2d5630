#pragma once

#include "base/gray_image.h"
#include "correlation/always_inline.h"

namespace telestrain::correlation {

// Quintic B-spline interpolation: s(x) = sum_k c_k beta5(x - k), c from the recursive filter of
// Unser, Aldroubi and Eden (1993). The border is mirrored about the outermost pixel centres.

// Pixels that the coefficients of a PreparedImage are continued by on every side: three for the
// spline, the rest for lanes of a vector that lie beyond the end of a subset's row (seven pixels,
// each at most two further when the gradient is below one).
inline constexpr int kSplinePadding = 24;
// A position must keep this distance from the region's border, where mirrored pixels count.
inline constexpr int kSplineMargin = 3;

// Index of the pixel that stands for `index` in a row of `count` mirrored pixels.
int MirroredIndex(int index, int count);

// Replaces grey levels by B-spline coefficients.
void ToSplineCoefficients(GrayImage& image);

// Weights of the six coefficients around a position `fraction` beyond the third of them. Each is
// even(s) +- z odd(s) with z = fraction - 1/2 and s = z^2, a quintic piece of beta5.
template <class Value>
TELESTRAIN_INLINE void QuinticWeights(const Value& fraction, Value (&weight)[6]) {
  const Value z = fraction - 0.5f;
  const Value s = z * z;
  const Value even0 = (s * (1.f / 48) + 1.f / 96) * s + 1.f / 3840;
  const Value even1 = (s * (-1.f / 16) + 7.f / 32) * s + 79.f / 1280;
  const Value even2 = 0.5f - even0 - even1;  // the weights sum to one
  const Value odd0 = z * ((s * (1.f / 120) + 1.f / 48) * s + 1.f / 384);
  const Value odd1 = z * ((s * (-1.f / 24) + 1.f / 16) * s + 25.f / 128);
  const Value odd2 = z * ((s * (1.f / 12) - 7.f / 24) * s + 77.f / 192);
  weight[0] = even0 - odd0;
  weight[1] = even1 - odd1;
  weight[2] = even2 - odd2;
  weight[3] = even2 + odd2;
  weight[4] = even1 + odd1;
  weight[5] = even0 + odd0;
}

}  // namespace telestrain::correlation
