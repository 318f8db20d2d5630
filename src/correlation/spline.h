#pragma once

#include "correlation/always_inline.h"

namespace telestrain::correlation {

// B-spline interpolation of degree 3 or 5: s(x) = sum_k c_k beta(x - k) (Unser, Aldroubi and Eden
// 1993). Where a position lies `fraction` beyond a coefficient, degree + 1 of them count: those
// from degree / 2 before it on. The border is mirrored about the outermost pixel centres.

// Pixels that the coefficients of a PreparedImage are continued by on every side: three for the
// spline, the rest for lanes of a vector beyond the end of a subset's row.
inline constexpr int kSplinePadding = 24;
// Further coefficients after the last, readable but never used.
inline constexpr int kSplineTail = 128;
// A position must keep this distance from the region's border, where mirrored pixels count.
inline constexpr int kSplineMargin = 3;

// Index of the pixel that stands for `index` in a row of `count` mirrored pixels.
int MirroredIndex(int index, int count);

// Weight k is sum_p kSplinePieces[k][p] z^p with z = fraction - 1/2; weight degree - k the same
// with the odd powers negated. The pieces of beta3 and beta5.
inline constexpr float kCubicPieces[2][6] = {{1.f / 48, -1.f / 8, 1.f / 4, -1.f / 6, 0, 0},
                                             {23.f / 48, -5.f / 8, -1.f / 4, 1.f / 2, 0, 0}};
inline constexpr float kQuinticPieces[3][6] = {
    {1.f / 3840, -1.f / 384, 1.f / 96, -1.f / 48, 1.f / 48, -1.f / 120},
    {79.f / 1280, -25.f / 128, 7.f / 32, -1.f / 16, -1.f / 16, 1.f / 24},
    {841.f / 1920, -77.f / 192, -11.f / 48, 7.f / 24, 1.f / 24, -1.f / 12}};

template <int kDegree>
TELESTRAIN_INLINE constexpr float SplinePiece(int k, int power) {
  return kDegree == 3 ? kCubicPieces[k % 2][power] : kQuinticPieces[k][power];
}

// The degree + 1 weights at a position in a cell; `Value` is a float or a vector of them, `fma`
// gives a b + c, `spread` turns a float into a Value.
template <int kDegree, class Value, class Fma, class Spread>
TELESTRAIN_INLINE void SplineWeights(const Value& fraction, const Fma& fma, const Spread& spread,
                                     Value (&weight)[kDegree + 1]) {
  const Value z = fraction - spread(0.5f);
  const Value s = z * z;
  for (int k = 0; k <= kDegree / 2; ++k) {
    Value even = fma(s, spread(SplinePiece<kDegree>(k, 2)), spread(SplinePiece<kDegree>(k, 0)));
    Value odd = fma(s, spread(SplinePiece<kDegree>(k, 3)), spread(SplinePiece<kDegree>(k, 1)));
    if constexpr (kDegree == 5) {
      even = fma(s * s, spread(SplinePiece<kDegree>(k, 4)), even);
      odd = fma(s * s, spread(SplinePiece<kDegree>(k, 5)), odd);
    }
    weight[k] = fma(z, odd, even);
    weight[kDegree - k] = even - z * odd;
  }
}

}  // namespace telestrain::correlation
