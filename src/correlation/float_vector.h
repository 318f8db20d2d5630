#pragma once

#include <cstring>

#include "correlation/always_inline.h"

namespace telestrain::correlation {

// Eight floats handled at once, in the vector extension that GCC and Clang share. Every operation
// is the same IEEE operation on each lane, so the result does not depend on the instruction set
// that the compiler picks. Everything here is inlined: the calling convention of 32-byte vectors
// differs between instruction sets.
using Float8 [[gnu::vector_size(32)]] = float;
using Float4 [[gnu::vector_size(16)]] = float;
using Int8 [[gnu::vector_size(32)]] = int;
inline constexpr int kLanes = 8;

TELESTRAIN_INLINE Float8 LaneNumbers() { return Float8{0, 1, 2, 3, 4, 5, 6, 7}; }

TELESTRAIN_INLINE Float8 Load(const float* from) {
  Float8 value;
  std::memcpy(&value, from, sizeof(value));
  return value;
}

// Zero from lane `count` on.
TELESTRAIN_INLINE void KeepFirstLanes(int count, Float8& value) {
  const Int8 lane = {0, 1, 2, 3, 4, 5, 6, 7};
  value = lane < count ? value : Float8{};
}

// Sum of the lanes, in a fixed order.
TELESTRAIN_INLINE float SumLanes(const Float8& v) {
  const Float4 half =
      __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
  const Float4 pair = half + __builtin_shufflevector(half, half, 2, 3, 0, 1);
  return pair[0] + pair[1];
}

// Turns eight vectors as rows of a matrix into its columns.
TELESTRAIN_INLINE void Transpose(Float8 (&m)[8]) {
  Float8 a[8], b[8];
  for (int i = 0; i < 4; ++i) {
    a[2 * i] = __builtin_shufflevector(m[2 * i], m[2 * i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
    a[2 * i + 1] = __builtin_shufflevector(m[2 * i], m[2 * i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
  }
  for (int i = 0; i < 8; i += 4) {
    for (int k = 0; k < 2; ++k) {
      b[i + 2 * k] = __builtin_shufflevector(a[i + k], a[i + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      b[i + 2 * k + 1] =
          __builtin_shufflevector(a[i + k], a[i + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (int i = 0; i < 4; ++i) {
    m[i] = __builtin_shufflevector(b[i], b[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    m[i + 4] = __builtin_shufflevector(b[i], b[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

}  // namespace telestrain::correlation
