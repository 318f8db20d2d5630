#pragma once

#include "correlation/kernels.h"
#include "correlation/spline.h"
#include "correlation/wide_vector.h"

// A separable filter over a strip of columns. Only for kernels_*.cpp.
namespace telestrain::correlation {
namespace {

constexpr int kRegisters = 4;  // vectors that are summed at once

// out[i] = sum_k kernel[k] rows[k][i] for whole groups of vectors; `Row` gives the address of row
// k.
template <class Row>
TELESTRAIN_INLINE void SumRows(const float* kernel, int taps, const Row& row, float* out) {
  for (int i = 0; i < kStripColumns; i += kRegisters * kWide) {
    Float16 sums[kRegisters];
    for (Float16& sum : sums) sum = Spread(0);
    for (int k = 0; k < taps; ++k) {
      const Float16 weight = Spread(kernel[k]);
      const float* from = row(k) + i;
      for (int r = 0; r < kRegisters; ++r)
        sums[r] = Fma(weight, LoadWide(from + r * kWide), sums[r]);
    }
    for (int r = 0; r < kRegisters; ++r) Store(sums[r], out + i + r * kWide);
  }
}

// The mirrored pixels that a strip needs of a row.
TELESTRAIN_INLINE void CopyMirrored(const FilterStrip& strip, int row, float* to) {
  const float* from = strip.image + MirroredIndex(row, strip.height) * strip.stride;
  const int first = strip.first_column - strip.reach_x;
  const int end = strip.first_column + strip.columns + strip.reach_x;
  if (first >= 0 && end <= strip.width) {
    std::memcpy(to, from + first, static_cast<std::size_t>(end - first) * sizeof(float));
    return;
  }
  for (int x = first; x < end; ++x) *to++ = from[MirroredIndex(x, strip.width)];
}

// Rows filtered along x wait in a ring until all are there that an output row needs.
void Filter(const FilterStrip& strip) {
  constexpr int kRing = 2 * kLargestReach + 1;
  alignas(64) float ring[kRing][kStripColumns];
  alignas(64) float padded[kStripColumns + 2 * kLargestReach + kWide] = {};
  alignas(64) float sums[kStripColumns];
  const int taps = 2 * strip.reach_y + 1;
  int filtered = strip.first_row - strip.reach_y;
  const int origin = filtered;
  for (int y = strip.first_row; y < strip.last_row; ++y) {
    for (; filtered <= y + strip.reach_y; ++filtered) {
      CopyMirrored(strip, filtered, padded);
      SumRows(
          strip.kernel_x, 2 * strip.reach_x + 1, [&](int k) { return padded + k; },
          ring[(filtered - origin) % taps]);
    }
    SumRows(
        strip.kernel_y, taps, [&](int k) { return ring[(y - strip.reach_y + k - origin) % taps]; },
        sums);
    std::memcpy(strip.out + (y - strip.first_row) * strip.out_stride, sums,
                static_cast<std::size_t>(strip.columns) * sizeof(float));
  }
}

}  // namespace
}  // namespace telestrain::correlation
