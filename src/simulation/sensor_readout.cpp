#include "simulation/sensor_readout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "simulation/random_stream.h"

namespace telestrain {
namespace {

constexpr std::size_t kBlock = 65536;  // pixels that one thread reads out in one go; even

// Read noise in levels of the format, so that noise and quantisation add up to `total_levels`.
double ReadNoise(double total_levels) {
  return std::sqrt(std::max(0.0, total_levels * total_levels - 1.0 / 12.0));
}

}  // namespace

GrayImage ReadOut(const GrayImage& ideal, const SensorModel& sensor, std::uint64_t key,
                  int threads) {
  const int stored_bits = sensor.bit_depth == 8 ? 8 : 16;
  const double top_level = (1 << sensor.bit_depth) - 1,
               shift = 1 << (stored_bits - sensor.bit_depth);
  const double levels_per_gray = top_level / 255;
  const double read = ReadNoise(sensor.noise_gray * levels_per_gray);
  // Variance of the shot noise per level.
  const double shot = sensor.full_well_electrons > 0 ? top_level / sensor.full_well_electrons : 0;
  GrayImage image = ideal;
  image.max_gray = stored_bits == 8 ? 255 : 65535;
  const std::size_t count = image.pixels.size();
  const auto blocks = static_cast<int>((count + kBlock - 1) / kBlock);
  ParallelFor(blocks, threads, [&](int block) {
    const std::size_t first = static_cast<std::size_t>(block) * kBlock;
    std::array<double, 2> pair{};
    for (std::size_t i = first; i < std::min(first + kBlock, count); ++i) {
      if (i % 2 == 0 && (read > 0 || shot > 0)) pair = NormalPair(key, i / 2);
      const double level = ideal.pixels[i] * levels_per_gray;
      const double noise = shot > 0 ? std::sqrt(read * read + shot * std::max(level, 0.0)) : read;
      const double whole = std::floor(level + noise * pair[i % 2] + 0.5);
      image.pixels[i] = static_cast<float>(shift * std::clamp(whole, 0.0, top_level));
    }
  });
  return image;
}

}  // namespace telestrain
