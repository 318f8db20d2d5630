#pragma once

#include <array>
#include <cstdint>

namespace telestrain {

// Random numbers that are a pure function of a key and a counter, so that a virtual experiment
// does not depend on thread order, and none of the library's unspecified distributions, so that it
// does not depend on the standard library.

// Finaliser of splitmix64 (Steele, Lea, Flood 2014): a bijection that scatters nearby numbers.
std::uint64_t ScatterBits(std::uint64_t bits);

// One key from two numbers; a chain of calls gives a key from any number of them.
std::uint64_t CombineKeys(std::uint64_t a, std::uint64_t b);

// Two independent standard normal deviates for this key and counter: the quantiles of 32 random
// bits each. The same bits on every machine.
std::array<double, 2> NormalPair(std::uint64_t key, std::uint64_t counter);

// The numbers of one key in sequence.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t key) : key_(key) {}
  double Uniform();  // in [0, 1), 53 bits
  double Uniform(double minimum, double maximum) {
    return minimum + (maximum - minimum) * Uniform();
  }
  double Normal();
  int Poisson(double mean);  // by inversion; for means of a few

 private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace telestrain
