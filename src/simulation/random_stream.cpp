#include "simulation/random_stream.h"

#include <bit>
#include <cmath>
#include <numbers>

namespace telestrain {
namespace {

constexpr std::uint64_t kGoldenGamma = 0x9E3779B97F4A7C15u;  // splitmix64's increment

double UnitInterval(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

// Natural logarithm of a positive normal number from exact operations only, to 1e-13: the library's
// differs in the last bit between machines.
double PortableLog(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  double exponent = static_cast<double>(bits >> 52) - 1023;
  double mantissa = std::bit_cast<double>((bits & 0xFFFFFFFFFFFFFu) | 0x3FF0000000000000u);
  if (mantissa > std::numbers::sqrt2) {
    mantissa *= 0.5;
    exponent += 1;
  }
  const double s = (mantissa - 1) / (mantissa + 1), s2 = s * s;  // log = 2 artanh s, s < 0.172
  const double series =
      1 +
      s2 * (1.0 / 3 + s2 * (1.0 / 5 + s2 * (1.0 / 7 + s2 * (1.0 / 9 + s2 * (1.0 / 11 + s2 / 13)))));
  return exponent * std::numbers::ln2 + 2 * s * series;
}

// The standard normal deviate below which the share (bits + 1/2) / 2^32 lies: Wichura's PPND7
// (algorithm AS 241, 1988; 1e-7), whose far tail begins beyond what 32 bits reach (6.2 sigma).
double NormalQuantile(std::uint32_t bits) {
  const double share = (bits + 0.5) * 0x1p-32, q = share - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * (((59.109374720 * r + 159.29113202) * r + 50.434271938) * r + 3.3871327179) /
           (((67.187563600 * r + 78.757757664) * r + 17.895169469) * r + 1);
  }
  const double r = std::sqrt(-PortableLog(q < 0 ? share : 1 - share)) - 1.6;
  const double deviate =
      (((0.17023821103 * r + 1.3067284816) * r + 2.7568153900) * r + 1.4234372777) /
      ((0.12021132975 * r + 0.73700164250) * r + 1);
  return q < 0 ? -deviate : deviate;
}

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
  const std::uint64_t bits = ScatterBits(key + kGoldenGamma * (counter + 1));
  return {NormalQuantile(static_cast<std::uint32_t>(bits)),
          NormalQuantile(static_cast<std::uint32_t>(bits >> 32))};
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
