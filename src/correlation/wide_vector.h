#pragma once

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include <cstring>

#include "correlation/float_vector.h"

// Sixteen floats handled at once, for the files that are compiled once for every instruction set
// (kernels_*.cpp). With AVX-512 they are one register, else two of Float8. Products are added by
// fused operations where the instruction set has them (AVX2 and AVX-512) and by two operations
// elsewhere. Lanes and the order of all sums are the same, so AVX2 and AVX-512 give the same bits.
// Everything has internal linkage: no function of one instruction set can stand in for another's.
namespace telestrain::correlation {
namespace {

constexpr int kWide = 16;

TELESTRAIN_INLINE Float8 Fma(const Float8& a, const Float8& b, const Float8& c) {
#if defined(__FMA__)
  return (Float8)_mm256_fmadd_ps((__m256)a, (__m256)b, (__m256)c);
#else
  return a * b + c;
#endif
}

#if defined(__AVX512F__)

using Float16 [[gnu::vector_size(64)]] = float;
using LaneMask = __mmask16;

TELESTRAIN_INLINE Float16 Fma(const Float16& a, const Float16& b, const Float16& c) {
  return (Float16)_mm512_fmadd_ps((__m512)a, (__m512)b, (__m512)c);
}
TELESTRAIN_INLINE Float16 Spread(float value) { return (Float16)_mm512_set1_ps(value); }
TELESTRAIN_INLINE LaneMask MaskOf(unsigned bits) { return static_cast<LaneMask>(bits); }
TELESTRAIN_INLINE Float16 Keep(const LaneMask& mask, const Float16& value) {
  return (Float16)_mm512_maskz_mov_ps(mask, (__m512)value);
}
TELESTRAIN_INLINE Float8 AddHalves(const Float16& v) {
  return __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7) +
         __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
}
TELESTRAIN_INLINE Float16 LoadWide(const float* from) { return (Float16)_mm512_loadu_ps(from); }
TELESTRAIN_INLINE void Store(const Float16& value, float* to) {
  _mm512_storeu_ps(to, (__m512)value);
}
TELESTRAIN_INLINE Float16 Join(const Float8& low, const Float8& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

#else

struct Float16 {
  Float8 low, high;
};
struct LaneMask {
  Int8 low, high;
};

TELESTRAIN_INLINE Float16 operator+(const Float16& a, const Float16& b) {
  return {a.low + b.low, a.high + b.high};
}
TELESTRAIN_INLINE Float16 operator-(const Float16& a, const Float16& b) {
  return {a.low - b.low, a.high - b.high};
}
TELESTRAIN_INLINE Float16 operator*(const Float16& a, const Float16& b) {
  return {a.low * b.low, a.high * b.high};
}
TELESTRAIN_INLINE Float16 operator*(const Float16& a, float b) { return {a.low * b, a.high * b}; }
TELESTRAIN_INLINE Float16 operator-(const Float16& a, float b) { return {a.low - b, a.high - b}; }
TELESTRAIN_INLINE Float16& operator+=(Float16& a, const Float16& b) { return a = a + b; }
TELESTRAIN_INLINE Float16 Fma(const Float16& a, const Float16& b, const Float16& c) {
  return {Fma(a.low, b.low, c.low), Fma(a.high, b.high, c.high)};
}
TELESTRAIN_INLINE Float16 Spread(float value) { return {Float8{} + value, Float8{} + value}; }
TELESTRAIN_INLINE LaneMask MaskOf(unsigned bits) {
  constexpr Int8 kLow = {1, 2, 4, 8, 16, 32, 64, 128};
  const int all = static_cast<int>(bits);
  return {(kLow & all) != 0, ((kLow << 8) & all) != 0};
}
TELESTRAIN_INLINE Float16 Keep(const LaneMask& mask, const Float16& value) {
  return {mask.low ? value.low : Float8{}, mask.high ? value.high : Float8{}};
}
TELESTRAIN_INLINE Float8 AddHalves(const Float16& v) { return v.low + v.high; }
TELESTRAIN_INLINE Float16 Join(const Float8& low, const Float8& high) { return {low, high}; }
// Half by half: copied as a whole, the value would stay in memory.
TELESTRAIN_INLINE Float16 LoadWide(const float* from) { return {Load(from), Load(from + kLanes)}; }
TELESTRAIN_INLINE void Store(const Float16& value, float* to) {
  std::memcpy(to, &value.low, sizeof(value.low));
  std::memcpy(to + kLanes, &value.high, sizeof(value.high));
}

#endif

// Sum of the lanes, in a fixed order.
TELESTRAIN_INLINE double SumWide(const Float16& v) { return SumLanes(AddHalves(v)); }

TELESTRAIN_INLINE Float16 WideLaneNumbers() {
  constexpr Float8 kLow = {0, 1, 2, 3, 4, 5, 6, 7};
  return Join(kLow, kLow + 8.f);
}

}  // namespace
}  // namespace telestrain::correlation
