#pragma once

#include "correlation/kernels.h"
#include "correlation/spline.h"
#include "correlation/wide_vector.h"

// A separable filter over a strip of columns. Only for kernels_*.cpp.
namespace telestrain::correlation {
namespace {

// Vectors that are summed at once: as many sums as hide the latency of one, half the registers.
#if defined(__AVX512F__)
constexpr int kSums = 8;
#else
constexpr int kSums = 4;
#endif
static_assert(kStripColumns % (kSums * kWide) == 0);

// out[i] = sum_k kernel[k] rows[k][i] over a strip; `Row` gives the address of row k.
template <class Row>
TELESTRAIN_INLINE void SumRows(const float* kernel, int taps, const Row& row, float* out) {
  for (int i = 0; i < kStripColumns; i += kSums * kWide) {
    Float16 sums[kSums];
    for (Float16& sum : sums) sum = Spread(0);
    for (int k = 0; k < taps; ++k) {
      const Float16 weight = Spread(kernel[k]);
      const float* from = row(k) + i;
      for (int r = 0; r < kSums; ++r) sums[r] = Fma(weight, LoadWide(from + r * kWide), sums[r]);
    }
    for (int r = 0; r < kSums; ++r) Store(sums[r], out + i + r * kWide);
  }
}

// The pixels that a strip needs of a row: where they are, or mirrored in a copy.
class StripRows {
 public:
  TELESTRAIN_INLINE explicit StripRows(const FilterStrip& strip)
      : strip_(strip),
        first_(strip.first_column - strip.reach_x),
        inside_(first_ >= 0 && strip.first_column + kStripColumns + strip.reach_x <= strip.width) {}

  TELESTRAIN_INLINE const float* Row(int row) {
    const float* from = strip_.image + MirroredIndex(row, strip_.height) * strip_.stride;
    if (inside_) return from + first_;
    const int count = strip_.columns + 2 * strip_.reach_x;
    for (int k = 0; k < count; ++k) copy_[k] = from[MirroredIndex(first_ + k, strip_.width)];
    return copy_;
  }

 private:
  const FilterStrip& strip_;
  int first_;
  bool inside_;
  alignas(64) float copy_[kStripColumns + 2 * kLargestReach + kWide] = {};
};

// Rows filtered along x wait in a ring until all are there that an output row needs.
void Filter(const FilterStrip& strip) {
  constexpr int kRing = 2 * kLargestReach + 1;
  alignas(64) float ring[kRing][kStripColumns];
  alignas(64) float sums[kStripColumns];
  StripRows rows(strip);
  const int taps = 2 * strip.reach_y + 1;
  const int origin = strip.first_row - strip.reach_y;
  int filtered = origin;
  for (int y = strip.first_row; y < strip.last_row; ++y) {
    for (; filtered <= y + strip.reach_y; ++filtered) {
      const float* from = rows.Row(filtered);
      SumRows(
          strip.kernel_x, 2 * strip.reach_x + 1, [&](int k) { return from + k; },
          ring[(filtered - origin) % taps]);
    }
    // The oldest row stands where the next one will.
    const int oldest = (y - strip.first_row) % taps;
    const auto row = [&](int k) {
      return ring[k < taps - oldest ? oldest + k : oldest + k - taps];
    };
    float* out = strip.out + (y - strip.first_row) * strip.out_stride;
    SumRows(strip.kernel_y, taps, row, strip.columns == kStripColumns ? out : sums);
    if (strip.columns == kStripColumns) continue;
    std::memcpy(out, sums, static_cast<std::size_t>(strip.columns) * sizeof(float));
  }
}

}  // namespace
}  // namespace telestrain::correlation
