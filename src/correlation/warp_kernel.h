#pragma once

#include "correlation/column_sums.h"
#include "correlation/interpolation_kernel.h"

// The moments of a warped band. Only for kernels_*.cpp.
namespace telestrain::correlation {
namespace {

template <int kOrder>
struct WarpedSums {
  Float16 t, tt, tf;
  Float16 tjx[kLargestBasis], tjy[kLargestBasis];

  TELESTRAIN_INLINE WarpedSums() {
    t = tt = tf = Spread(0);
    Clear(tjx), Clear(tjy);
  }

  // `Interpolate` gives the warped grey levels of the column's pixels in a row.
  // A pixel of the reference that does not count may be no number: a zero factor does not remove
  // it.
  template <Counting kCounting, class Interpolate>
  TELESTRAIN_INLINE void AddColumn(const SubsetView& subset, float mean, int column, int first,
                                   int end, const Interpolate& interpolate) {
    constexpr int kAhead = kMostVectors * kWide;  // the strip after this one
    const float* const fields[] = {subset.gray, subset.gradient_x, subset.gradient_y};
    const WideColumn<kCounting> pixels(subset, column);
    PowersOfY<kOrder> gx_sums, gy_sums;
    Float16 column_t = Spread(0), column_tt = Spread(0), column_tf = Spread(0);
    const Float16 mean_wide = Spread(mean);
    const bool far = subset.side_px > kNear_px;
    for (int row = first; row < end; ++row) {
      if (far)
        for (const float* field : fields) Prefetch(field + row * subset.stride + column + kAhead);
      const Float16 value = pixels.Counted(row, interpolate(row) - mean_wide);
      const Float16 f = pixels.At(subset.gray, row) - mean_wide;
      const float y = OffsetOfRow(row, subset.side_px);
      column_t += value;
      column_tt = Fma(value, value, column_tt);
      column_tf = Fma(value, pixels.Counted(row, f), column_tf);
      gx_sums.Add(value * pixels.Counted(row, pixels.At(subset.gradient_x, row)), y);
      gy_sums.Add(value * pixels.Counted(row, pixels.At(subset.gradient_y, row)), y);
    }
    const Float16 x = pixels.Offsets();
    t += column_t, tt += column_tt, tf += column_tf;
    gx_sums.AddTo(x, tjx), gy_sums.AddTo(x, tjy);
  }

  TELESTRAIN_INLINE void AddTotals(WarpedMoments& out) const {
    out.t += SumWide(t);
    out.tt += SumWide(tt);
    out.tf += SumWide(tf);
    correlation::AddTotals<kOrder>(tjx, out.tjx), correlation::AddTotals<kOrder>(tjy, out.tjy);
  }
};

// A band, strip by strip of columns: the narrower the strip, the larger the gradients that the fast
// interpolation bears. Pixels of a strip for which it is not exact enough are interpolated one by
// one.
template <int kDegree, int kOrder, bool kMasked>
WarpedMoments Warped(const SubsetView& subset, float mean, const SplineView& spline,
                     const SubsetWarp& warp, int band) {
  const int side = subset.side_px;
  const int first = FirstRowOfBand(side, band), end = FirstRowOfBand(side, band + 1);
  WarpedSums<kOrder> sums;
  const int width = StripWidth<kDegree, kOrder>(warp, side);
  StripBuffer buffer;
  for (int column = 0; column < side; column += width) {
    const int vectors = (Lesser(width, side - column) + kWide - 1) / kWide;
    const WarpedStrip<kDegree, kOrder> strip(spline, warp, side, column, vectors);
    const int terms = strip.Prepare(first, end, buffer);
    const auto add = [&](const auto& interpolate) __attribute__((always_inline)) {
      for (int v = 0; v < vectors; ++v)
        WithCounting<kMasked>(
            side, column + v * kWide, [&](auto counting) __attribute__((always_inline)) {
              sums.template AddColumn<counting.value>(
                  subset, mean, column + v * kWide, first,
                  end, [&](int row) __attribute__((always_inline)) { return interpolate(v, row); });
            });
    };
    const auto fast = [&](auto count) __attribute__((always_inline)) {
      add([&](int v, int row) __attribute__((always_inline)) {
        return strip.template Fast<count.value>(buffer, v, row - first);
      });
    };
    if (terms == 1) fast(Terms<1>());
    if (terms == 2) fast(Terms<2>());
    if (terms == 3) fast(Terms<3>());
    if (terms == 4) fast(Terms<4>());
    if (terms == 0)
      add([&](int v, int row) __attribute__((always_inline)) { return strip.OneByOne(v, row); });
  }
  WarpedMoments out;
  sums.AddTotals(out);
  return out;
}

}  // namespace
}  // namespace telestrain::correlation
