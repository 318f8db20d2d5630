#include "simulation/random_stream.h"

#include <cmath>
#include <numbers>

namespace telestrain {
namespace {

constexpr std::uint64_t kGoldenGamma = 0x9E3779B97F4A7C15u;  // splitmix64's increment

double UnitInterval(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

}  // namespace

std::uint64_t ScatterBits(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9u;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBu;
  return bits ^ (bits >> 31);
}

std::uint64_t CombineKeys(std::uint64_t a, std::uint64_t b) {
  return ScatterBits(ScatterBits(a + kGoldenGamma) + kGoldenGamma * (b + 1));
}

std::array<double, 2> NormalPair(std::uint64_t key, std::uint64_t counter) {
  const std::uint64_t first = ScatterBits(key + kGoldenGamma * (2 * counter + 1));
  const std::uint64_t second = ScatterBits(key + kGoldenGamma * (2 * counter + 2));
  const double radius = std::sqrt(-2.0 * std::log(1.0 - UnitInterval(first)));
  const double angle = 2.0 * std::numbers::pi * UnitInterval(second);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

double RandomStream::Uniform() {
  return UnitInterval(ScatterBits(key_ + kGoldenGamma * ++counter_));
}

double RandomStream::Normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * Uniform());
}

int RandomStream::Poisson(double mean) {
  const double uniform = Uniform();
  double probability = std::exp(-mean);
  double cumulated = probability;
  int count = 0;
  while (uniform > cumulated && count < 100) {
    probability *= mean / ++count;
    cumulated += probability;
  }
  return count;
}

}  // namespace telestrain
