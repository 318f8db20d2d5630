#pragma once

#include <cstddef>
#include <vector>

namespace telestrain {

// About `wanted` of the indices 0 to count - 1, spread evenly by the golden ratio so that no row or
// column of a grid is preferred; all of them when there are no more.
inline std::vector<std::size_t> SpreadSample(std::size_t count, std::size_t wanted) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double share = static_cast<double>(wanted) / static_cast<double>(count);
  std::vector<std::size_t> sample;
  for (std::size_t i = 0; i < count; ++i) {
    const double turns = static_cast<double>(i) * kGoldenRatio;
    if (turns - static_cast<double>(static_cast<long long>(turns)) < share) sample.push_back(i);
  }
  return sample;
}

}  // namespace telestrain
