#pragma once

#include "simulation/random_stream.h"

namespace telestrain {

// What a random number is for. Every purpose has its own key, so that an option which changes how
// many numbers one of them needs does not change the others.
enum class RandomPurpose : std::uint64_t {
  kLens = 1,
  kViews,
  kStage,
  kBoardPoses,
  kRulerPoses,
  kPipe,
  kGauges,
  kSpeckle,
  kPixelNoise,
  kMirrors,
  kDust,
  kVibration,
  kWarmUp,
};

inline std::uint64_t RandomKey(std::uint64_t seed, RandomPurpose purpose) {
  return CombineKeys(seed, static_cast<std::uint64_t>(purpose));
}

}  // namespace telestrain
