#pragma once

#include "correlation/subset_moments.h"
#include "correlation/wide_vector.h"

// What the passes share: rows of a subset, offsets, masks and the basis. Only for kernels_*.cpp.
namespace telestrain::correlation {
namespace {

// Not those of the standard library: an out-of-line copy made for one instruction set could stand
// in for another's.
template <class Value>
TELESTRAIN_INLINE Value Lesser(Value a, Value b) {
  return b < a ? b : a;
}
template <class Value>
TELESTRAIN_INLINE Value Greater(Value a, Value b) {
  return a < b ? b : a;
}

// A larger subset does not stay in the first cache from one iteration to the next.
constexpr int kNear_px = 128;
TELESTRAIN_INLINE void Prefetch(const float* from) { __builtin_prefetch(from); }

struct WideFma {
  template <class Value>
  TELESTRAIN_INLINE Value operator()(const Value& a, const Value& b, const Value& c) const {
    return Fma(a, b, c);
  }
};
struct WideSpread {
  TELESTRAIN_INLINE Float16 operator()(float value) const { return Spread(value); }
};

TELESTRAIN_INLINE unsigned BitsFrom(const std::uint64_t* words, int first) {
  const int shift = first % 64;
  std::uint64_t bits = words[first / 64] >> shift;
  if (shift > 48) bits |= words[first / 64 + 1] << (64 - shift);
  return static_cast<unsigned>(bits & 0xffff);
}

// Which pixels of sixteen count: all of them, the first ones of a row's end, or those of a mask.
enum class Counting { kAll, kTail, kMasked };

// One column of sixteen pixels of a subset.
template <Counting kCounting>
class WideColumn {
 public:
  TELESTRAIN_INLINE WideColumn(const SubsetView& subset, int column)
      : subset_(subset), column_(column), rest_(subset.side_px - column) {
    tail_bits_ = rest_ >= kWide ? 0xffffu : (1u << rest_) - 1;
    tail_ = MaskOf(tail_bits_);
  }
  TELESTRAIN_INLINE Float16 Offsets() const {
    const int half = subset_.side_px / 2;
    return (WideLaneNumbers() + Spread(static_cast<float>(column_ - half))) *
           Spread(1.f / static_cast<float>(half));
  }
  TELESTRAIN_INLINE Float16 At(const float* field, int row) const {
    return LoadWide(field + row * subset_.stride + column_);
  }
  // Zero where the pixel does not count.
  TELESTRAIN_INLINE Float16 Counted(int row, const Float16& value) const {
    if constexpr (kCounting == Counting::kMasked) return Keep(MaskOf(Bits(row)), value);
    if constexpr (kCounting == Counting::kTail) return Keep(tail_, value);
    return value;
  }
  TELESTRAIN_INLINE unsigned Bits(int row) const {
    if constexpr (kCounting != Counting::kMasked) return tail_bits_;
    return tail_bits_ &
           BitsFrom(subset_.mask + row * subset_.mask_words, subset_.left_px + column_);
  }

 private:
  const SubsetView& subset_;
  int column_, rest_;
  unsigned tail_bits_;
  LaneMask tail_;
};

// Calls `work` with the way of counting, a Counting in a type, that a column needs.
template <Counting kValue>
struct CountingBy {
  static constexpr Counting value = kValue;
};
template <bool kMasked, class Work>
TELESTRAIN_INLINE void WithCounting(int side_px, int column, const Work& work) {
  if constexpr (kMasked)
    work(CountingBy<Counting::kMasked>());
  else if (column + kWide <= side_px)
    work(CountingBy<Counting::kAll>());
  else
    work(CountingBy<Counting::kTail>());
}

TELESTRAIN_INLINE float OffsetOfRow(int row, int side_px) {
  const int half = side_px / 2;
  return static_cast<float>(row - half) / static_cast<float>(half);
}

// Sums over the rows of one column of values times the powers 1, y, y^2, as far as the order needs.
template <int kOrder>
struct PowersOfY {
  Float16 sum[kOrder + 1];
  TELESTRAIN_INLINE PowersOfY() {
    for (Float16& s : sum) s = Spread(0);
  }
  TELESTRAIN_INLINE void Add(const Float16& value, float y) {
    sum[0] += value;
    if constexpr (kOrder > 0) sum[1] = Fma(value, Spread(y), sum[1]);
    if constexpr (kOrder > 1) sum[2] = Fma(value, Spread(y * y), sum[2]);
  }
  // Adds the sums over the basis; x is the same in all rows.
  TELESTRAIN_INLINE void AddTo(const Float16& x, Float16 (&out)[kLargestBasis]) const {
    out[0] += sum[0];
    if constexpr (kOrder > 0) {
      out[1] = Fma(x, sum[0], out[1]);
      out[2] += sum[1];
    }
    if constexpr (kOrder > 1) {
      out[3] = Fma(x * x * Spread(0.5f), sum[0], out[3]);
      out[4] = Fma(x, sum[1], out[4]);
      out[5] = Fma(Spread(0.5f), sum[2], out[5]);
    }
  }
};

template <int kOrder>
TELESTRAIN_INLINE void AddTotals(const Float16 (&sums)[kLargestBasis],
                                 double (&totals)[kLargestBasis]) {
  for (int k = 0; k < BasisSize(kOrder); ++k) totals[k] += SumWide(sums[k]);
}

TELESTRAIN_INLINE void Clear(Float16 (&sums)[kLargestBasis]) {
  for (Float16& sum : sums) sum = Spread(0);
}

}  // namespace
}  // namespace telestrain::correlation
