#pragma once

#include "correlation/column_sums.h"
#include "correlation/strip_plan.h"

// Interpolation of the warped pixels of a band, strip by strip of at most 64 columns. Only for
// kernels_*.cpp.
//
// In a row of a strip all pixels lie nearly on one row of the other image. The spline is first
// evaluated down the columns at the height of the row's middle, with as many terms of its Taylor
// series in y as the slope of the row needs, then along the row at every pixel: 6 (terms + terms)
// products a pixel instead of 36, and neighbouring coefficients serve as one load. A strip may
// reach out of the cell of the spline that its middle lies in: the polynomial piece is continued
// there, which differs from the spline by (way out)^degree / degree! times the (degree + 1)th
// difference of the coefficients.
namespace telestrain::correlation {
namespace {

template <int kDegree, int kOrder>
class WarpedStrip {
 public:
  static constexpr int kTaps = kDegree + 1;

  TELESTRAIN_INLINE WarpedStrip(const SplineView& spline, const SubsetWarp& warp, int side_px,
                                int column, int vectors)
      : spline_(spline),
        warp_(warp),
        half_(side_px / 2),
        side_(side_px),
        column_(column),
        vectors_(vectors),
        columns_((vectors + 1) * kWide),
        far_(side_px > kNear_px) {}

  // Fills the buffer for rows [first, end) and returns the number of terms, 0 where only OneByOne
  // is exact.
  TELESTRAIN_INLINE int Prepare(int first, int end, StripBuffer& buffer) const {
    const int rows = end - first;
    const int terms = PlaceRows(first, rows, buffer);
    if (terms == 0) return 0;
    WeighRows(rows, terms, buffer);
    for (int r = 0; r < rows; ++r) {
      if (terms == 1) AlongColumns<1>(r, buffer);
      if (terms == 2) AlongColumns<2>(r, buffer);
      if (terms == 3) AlongColumns<3>(r, buffer);
      if (terms == 4) AlongColumns<4>(r, buffer);
    }
    return terms;
  }

  // Grey levels of vector `v` in the band's row `r`.
  template <int kTerms>
  TELESTRAIN_INLINE Float16 Fast(const StripBuffer& buffer, int v, int r) const {
    const Float16 d =
        WideLaneNumbers() + Spread(static_cast<float>(v * kWide - vectors_ * kWide / 2));
    Float16 fraction = Fma(d, Spread(buffer.slope_x[r]), Spread(buffer.fraction_x[r]));
    if constexpr (kOrder == 2) fraction = Fma(d * d, Spread(Bend(warp_.u)), fraction);
    Float16 weight[kTaps];
    SplineWeights<kDegree>(fraction, WideFma(), WideSpread(), weight);
    const float* from = buffer.values + r * kTerms * columns_ + v * kWide;
    Float16 terms[kTerms];
    for (int term = 0; term < kTerms; ++term, from += columns_) {
      terms[term] = weight[0] * LoadWide(from);
      for (int k = 1; k < kTaps; ++k) terms[term] = Fma(weight[k], LoadWide(from + k), terms[term]);
    }
    Float16 way = d * Spread(buffer.slope_y[r]);
    if constexpr (kOrder == 2) way = Fma(d * d, Spread(Bend(warp_.v)), way);
    Float16 value = terms[kTerms - 1];
    for (int term = kTerms - 2; term >= 0; --term) value = Fma(value, way, terms[term]);
    return value;
  }

  // The same for any gradients. Lanes beyond the row stay at its end, inside the padding.
  TELESTRAIN_INLINE Float16 OneByOne(int v, int row) const {
    const double x_px = column_ + v * kWide - half_, y_px = row - half_;
    const Place x = PlaceOf<kOrder>(warp_.x_px + x_px, warp_.u, x_px, y_px);
    const Place y = PlaceOf<kOrder>(warp_.y_px + y_px, warp_.v, x_px, y_px);
    const int whole_x = static_cast<int>(x.at_px), whole_y = static_cast<int>(y.at_px);
    const int last = Lesser(side_ - column_ - v * kWide, kWide) - 1;
    alignas(64) float shift_x[kWide], shift_y[kWide];
    bool in_cell = true;
    for (int lane = 0; lane < kWide; ++lane) {
      const float d = static_cast<float>(Lesser(lane, last));
      shift_x[lane] = Shift(x, whole_x, d);
      shift_y[lane] = Shift(y, whole_y, d);
      in_cell = in_cell & (shift_x[lane] >= 0) & (shift_x[lane] < 1) & (shift_y[lane] >= 0) &
                (shift_y[lane] < 1);
    }
    const float* first = CoefficientsAt(whole_x, whole_y);
    return in_cell ? InOneCell(first, shift_x, shift_y) : Scattered(first, shift_x, shift_y, last);
  }

 private:
  TELESTRAIN_INLINE static float Bend(const double (&w)[kLargestBasis]) {
    return static_cast<float>(0.5 * w[3]);
  }
  TELESTRAIN_INLINE static float Shift(const Place& place, int whole, float d) {
    return static_cast<float>(place.at_px - whole) +
           d * (static_cast<float>(place.slope) + d * static_cast<float>(place.bend));
  }
  TELESTRAIN_INLINE const float* CoefficientsAt(int x, int y) const {
    return spline_.coefficients + (y - kDegree / 2) * spline_.stride + (x - kDegree / 2);
  }

  TELESTRAIN_INLINE int PlaceRows(int first, int rows, StripBuffer& buffer) const {
    const double x_px = column_ + vectors_ * kWide / 2 - half_;
    const float reach = static_cast<float>(vectors_ * kWide / 2);
    float farthest = 0;
    bool in_cell = true;
    for (int r = 0; r < rows; ++r) {
      const double y_px = first + r - half_;
      const Place x = PlaceOf<kOrder>(warp_.x_px + x_px, warp_.u, x_px, y_px);
      const Place y = PlaceOf<kOrder>(warp_.y_px + y_px, warp_.v, x_px, y_px);
      // Positions are positive inside the padding: truncation rounds down.
      const int whole_x = static_cast<int>(x.at_px), whole_y = static_cast<int>(y.at_px);
      buffer.first[r] = CoefficientsAt(whole_x - vectors_ * kWide / 2, whole_y);
      buffer.fraction_x[r] = static_cast<float>(x.at_px - whole_x);
      buffer.fraction_y[r] = static_cast<float>(y.at_px - whole_y);
      buffer.slope_x[r] = static_cast<float>(x.slope);
      buffer.slope_y[r] = static_cast<float>(y.slope);
      in_cell = in_cell & NearCell(buffer.fraction_x[r], Way(x, reach)) &
                NearCell(buffer.fraction_y[r], Way(y, reach));
      farthest = Greater(farthest, Way(y, reach));
    }
    if (!in_cell) return 0;
    return TermsFor(farthest, vectors_);
  }
  TELESTRAIN_INLINE static float Way(const Place& place, float reach) {
    return reach * (Magnitude(static_cast<float>(place.slope)) +
                    reach * Magnitude(static_cast<float>(place.bend)));
  }
  TELESTRAIN_INLINE static bool NearCell(float fraction, float way) {
    return fraction - way >= -kWayOut_px<kDegree> && fraction + way <= 1 + kWayOut_px<kDegree>;
  }

  // Weights of the rows' Taylor terms: sum_p C(p, m) piece_p z^(p - m).
  TELESTRAIN_INLINE void WeighRows(int rows, int terms, StripBuffer& buffer) const {
    constexpr float kBinomials[kMostTerms][6] = {
        {1, 1, 1, 1, 1, 1}, {0, 1, 2, 3, 4, 5}, {0, 0, 1, 3, 6, 10}, {0, 0, 0, 1, 4, 10}};
    for (int r = 0; r < rows; r += kWide) {
      const Float16 z = LoadWide(buffer.fraction_y + r) - Spread(0.5f);
      for (int term = 0; term < terms; ++term) {
        for (int k = 0; k < kTaps; ++k) {
          Float16 weight = Spread(0);
          for (int power = kDegree; power >= term; --power)
            weight = Fma(weight, z, Spread(kBinomials[term][power] * Piece(k, power)));
          Store(weight, buffer.weights[term][k] + r);
        }
      }
    }
  }
  TELESTRAIN_INLINE static float Piece(int k, int power) {
    if (k <= kDegree / 2) return SplinePiece<kDegree>(k, power);
    const float piece = SplinePiece<kDegree>(kDegree - k, power);
    return power % 2 ? -piece : piece;
  }

  template <int kTerms>
  TELESTRAIN_INLINE void AlongColumns(int r, StripBuffer& buffer) const {
    Float16 weight[kTerms][kTaps];
    for (int term = 0; term < kTerms; ++term)
      for (int k = 0; k < kTaps; ++k) weight[term][k] = Spread(buffer.weights[term][k][r]);
    float* to = buffer.values + r * kTerms * columns_;
    for (int i = 0; i < columns_; i += kWide) {
      const float* from = buffer.first[r] + i;
      if (far_) Prefetch(from + columns_);
      Float16 sums[kTerms];
      const Float16 top = LoadWide(from);
      for (int term = 0; term < kTerms; ++term) sums[term] = weight[term][0] * top;
      for (int k = 1; k < kTaps; ++k) {
        from += spline_.stride;
        const Float16 value = LoadWide(from);
        for (int term = 0; term < kTerms; ++term)
          sums[term] = Fma(weight[term][k], value, sums[term]);
      }
      for (int term = 0; term < kTerms; ++term) Store(sums[term], to + term * columns_ + i);
    }
  }

  // All lanes between the same rows and one pixel apart.
  TELESTRAIN_INLINE Float16 InOneCell(const float* first, const float* shift_x,
                                      const float* shift_y) const {
    Float16 weight[kTaps], along[kTaps];
    SplineWeights<kDegree>(LoadWide(shift_y), WideFma(), WideSpread(), weight);
    for (int k = 0; k < kTaps; ++k) along[k] = weight[0] * LoadWide(first + k);
    for (int j = 1; j < kTaps; ++j) {
      first += spline_.stride;
      for (int k = 0; k < kTaps; ++k) along[k] = Fma(weight[j], LoadWide(first + k), along[k]);
    }
    SplineWeights<kDegree>(LoadWide(shift_x), WideFma(), WideSpread(), weight);
    Float16 value = along[0] * weight[0];
    for (int k = 1; k < kTaps; ++k) value = Fma(along[k], weight[k], value);
    return value;
  }

  // Each lane its own coefficients. The same operations in the same order as above.
  TELESTRAIN_INLINE Float16 Scattered(const float* first, const float* shift_x,
                                      const float* shift_y, int last) const {
    alignas(64) float fraction_x[kWide], fraction_y[kWide];
    const float* from[kWide];
    for (int lane = 0; lane < kWide; ++lane) {
      const int x = RoundDown(shift_x[lane]), y = RoundDown(shift_y[lane]);
      fraction_x[lane] = shift_x[lane] - static_cast<float>(x);
      fraction_y[lane] = shift_y[lane] - static_cast<float>(y);
      from[lane] = first + y * spline_.stride + x + Lesser(lane, last);
    }
    Float16 weight[kTaps];
    alignas(64) float weights_x[kTaps][kWide], weights_y[kTaps][kWide];
    SplineWeights<kDegree>(LoadWide(fraction_x), WideFma(), WideSpread(), weight);
    for (int k = 0; k < kTaps; ++k) Store(weight[k], weights_x[k]);
    SplineWeights<kDegree>(LoadWide(fraction_y), WideFma(), WideSpread(), weight);
    for (int k = 0; k < kTaps; ++k) Store(weight[k], weights_y[k]);
    Float8 half[2];
    for (int h = 0; h < 2; ++h) {
      Float8 along[kLanes];
      for (int lane = 0; lane < kLanes; ++lane) {
        const int at = h * kLanes + lane;
        along[lane] = Load(from[at]) * weights_y[0][at];
        for (int j = 1; j < kTaps; ++j)
          along[lane] =
              Fma(Load(from[at] + j * spline_.stride), Float8{} + weights_y[j][at], along[lane]);
      }
      Transpose(along);
      half[h] = along[0] * Load(weights_x[0] + h * kLanes);
      for (int k = 1; k < kTaps; ++k)
        half[h] = Fma(along[k], Load(weights_x[k] + h * kLanes), half[h]);
    }
    return Join(half[0], half[1]);
  }
  TELESTRAIN_INLINE static int RoundDown(float value) {
    const int whole = static_cast<int>(value);
    return whole - (value < static_cast<float>(whole));
  }

  const SplineView& spline_;
  const SubsetWarp& warp_;
  int half_, side_, column_, vectors_, columns_;
  bool far_;
};

}  // namespace
}  // namespace telestrain::correlation
