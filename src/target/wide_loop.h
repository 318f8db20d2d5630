#pragma once

#include <bit>
#include <cstdint>

namespace telestrain {

// Loops over blocks of floats that the compiler turns into vector instructions. TELESTRAIN_WIDE
// before a function makes two versions of its loops, with the same operations in the same order;
// the processor chooses, every one gets the same bits. It does so before a sanitizer has begun.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TELESTRAIN_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define TELESTRAIN_WIDE
#endif

// Pixels handled at once.
inline constexpr int kBlock = 64;

// exp(a), relative error 2e-7; below -80 taken there.
[[gnu::always_inline]] inline float NegativeExp(float a) {
  constexpr float kMagic = 12582912.0F;  // its last bits hold the rounded number
  const float cut = a > -80.0F ? a : -80.0F;
  const float shifted = cut * 1.44269504F + kMagic;
  const float n = shifted - kMagic;
  const float t = (cut - n * 0.693359375F) + n * 2.12194440e-4F;
  const float series =
      1 +
      t * (1 + t * (0.5F + t * (0.166666667F +
                                t * (0.0416666667F + t * (8.33333333e-3F + t * 1.38888889e-3F)))));
  const std::int32_t power = (std::bit_cast<std::int32_t>(shifted) + 127) << 23;
  return series * std::bit_cast<float>(power);
}

// erf(x / sqrt 2) and exp(-x^2 / 2).
struct EdgeProfile {
  float erf = 0, gauss = 0;
};

// Abramowitz and Stegun 7.1.26, errors below 4e-7.
[[gnu::always_inline]] inline EdgeProfile EdgeProfileAt(float x) {
  const float distance = x < 0 ? -x : x, magnitude = distance < 9.0F ? distance : 9.0F;
  const float gauss = NegativeExp(-0.5F * magnitude * magnitude);
  const float t = 1 / (1 + 0.231641888F * magnitude);
  const float tail =
      t *
      (0.254829592F +
       t * (-0.284496736F + t * (1.421413741F + t * (-1.453152027F + t * 1.061405429F)))) *
      gauss;
  const float erf = 1 - tail;
  return {x < 0 ? -erf : erf, gauss};
}

}  // namespace telestrain
