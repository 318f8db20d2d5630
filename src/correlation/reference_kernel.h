#pragma once

#include "correlation/column_sums.h"

// All moments of a reference subset in one pass. Only for kernels_*.cpp.
namespace telestrain::correlation {
namespace {

// Products of two gradients times x^a y^b, a + b <= 2 order.
template <int kOrder>
struct ProductSums {
  static constexpr int kPowers = 2 * kOrder + 1;
  Float16 sum[kPowers];

  TELESTRAIN_INLINE ProductSums() {
    for (Float16& s : sum) s = Spread(0);
  }
  TELESTRAIN_INLINE void Add(const Float16& value, const float (&y)[5]) {
    sum[0] += value;
    for (int k = 1; k < kPowers; ++k) sum[k] = Fma(value, Spread(y[k]), sum[k]);
  }
  TELESTRAIN_INLINE void AddTo(const Float16& x, Float16 (&out)[5][5]) const {
    Float16 power = Spread(1);
    for (int a = 0; a < kPowers; ++a, power = power * x)
      for (int b = 0; a + b < kPowers; ++b) out[a][b] = Fma(power, sum[b], out[a][b]);
  }
};

template <int kOrder>
struct ReferenceBand {
  Float16 count, f, ff;
  Float16 jx[kLargestBasis], jy[kLargestBasis], fjx[kLargestBasis], fjy[kLargestBasis];
  Float16 xx[5][5], xy[5][5], yy[5][5];

  TELESTRAIN_INLINE ReferenceBand() {
    count = f = ff = Spread(0);
    Clear(jx), Clear(jy), Clear(fjx), Clear(fjy);
    for (int a = 0; a < 5; ++a)
      for (int b = 0; b < 5; ++b) xx[a][b] = xy[a][b] = yy[a][b] = Spread(0);
  }

  template <Counting kCounting>
  TELESTRAIN_INLINE void AddColumn(const SubsetView& subset, float shift, int column, int first,
                                   int end) {
    const WideColumn<kCounting> pixels(subset, column);
    PowersOfY<kOrder> gx_sums, gy_sums, fgx_sums, fgy_sums;
    ProductSums<kOrder> xx_sums, xy_sums, yy_sums;
    Float16 column_f = Spread(0), column_ff = Spread(0), column_count = Spread(0);
    for (int row = first; row < end; ++row) {
      const Float16 raw = pixels.At(subset.gray, row) - Spread(shift);
      const Float16 value = pixels.Counted(row, raw);
      const Float16 gx = pixels.Counted(row, pixels.At(subset.gradient_x, row));
      const Float16 gy = pixels.Counted(row, pixels.At(subset.gradient_y, row));
      const float y = OffsetOfRow(row, subset.side_px);
      const float y_powers[5] = {1, y, y * y, y * y * y, y * y * y * y};
      if constexpr (kCounting == Counting::kMasked) column_count += pixels.Counted(row, Spread(1));
      column_f += value;
      column_ff = Fma(value, value, column_ff);
      gx_sums.Add(gx, y), gy_sums.Add(gy, y);
      fgx_sums.Add(value * gx, y), fgy_sums.Add(value * gy, y);
      xx_sums.Add(gx * gx, y_powers), xy_sums.Add(gx * gy, y_powers);
      yy_sums.Add(gy * gy, y_powers);
    }
    const Float16 x = pixels.Offsets();
    f += column_f, ff += column_ff, count += column_count;
    gx_sums.AddTo(x, jx), gy_sums.AddTo(x, jy);
    fgx_sums.AddTo(x, fjx), fgy_sums.AddTo(x, fjy);
    xx_sums.AddTo(x, xx), xy_sums.AddTo(x, xy), yy_sums.AddTo(x, yy);
  }

  TELESTRAIN_INLINE void AddTotals(ReferenceMoments& out) const {
    out.mean += SumWide(f);
    out.ff += SumWide(ff);
    out.pixels += SumWide(count);
    correlation::AddTotals<kOrder>(jx, out.jx), correlation::AddTotals<kOrder>(jy, out.jy);
    correlation::AddTotals<kOrder>(fjx, out.fjx), correlation::AddTotals<kOrder>(fjy, out.fjy);
    for (int a = 0; a <= 2 * kOrder; ++a) {
      for (int b = 0; a + b <= 2 * kOrder; ++b) {
        out.xx[a][b] += SumWide(xx[a][b]);
        out.xy[a][b] += SumWide(xy[a][b]);
        out.yy[a][b] += SumWide(yy[a][b]);
      }
    }
  }
};

// Grey levels are counted from that of the middle, so that a float holds the sums; the mean is
// taken out of them at the end. A masked middle may be anything, so there zero serves.
template <int kOrder, bool kMasked>
ReferenceMoments Reference(const SubsetView& subset) {
  const int side = subset.side_px, half = side / 2;
  constexpr Counting kCounting = kMasked ? Counting::kMasked : Counting::kTail;
  const unsigned middle = WideColumn<kCounting>(subset, half).Bits(half);
  const float shift = middle & 1u ? subset.gray[half * subset.stride + half] : 0.f;
  ReferenceMoments out;
  for (int band = 0; band < BandCount(side); ++band) {
    ReferenceBand<kOrder> sums;
    for (int column = 0; column < side; column += kWide)
      WithCounting<kMasked>(
          side, column, [&](auto counting) __attribute__((always_inline)) {
            sums.template AddColumn<counting.value>(
                subset, shift, column, FirstRowOfBand(side, band), FirstRowOfBand(side, band + 1));
          });
    sums.AddTotals(out);
  }
  if (!kMasked) out.pixels = static_cast<double>(side) * side;
  const double beyond = out.mean / out.pixels;  // the mean above the middle's grey level
  out.ff -= out.mean * beyond;
  for (int k = 0; k < BasisSize(kOrder); ++k) {
    out.fjx[k] -= beyond * out.jx[k];
    out.fjy[k] -= beyond * out.jy[k];
  }
  out.mean = shift + beyond;
  return out;
}

}  // namespace
}  // namespace telestrain::correlation
