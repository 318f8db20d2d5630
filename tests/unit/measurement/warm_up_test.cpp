#include "measurement/warm_up.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::Random;

// Zero states every minute of an instrument that approaches its end by `size` with the time
// constant `tau_s`.
std::vector<ZeroReading> Warming(int count, double size, double tau_s, double sigma,
                                 std::uint64_t seed) {
  Random random(seed);
  std::vector<ZeroReading> zeros;
  for (int i = 0; i < count; ++i)
    zeros.push_back(
        {60.0 * i, -size * std::exp(-60.0 * i / tau_s) + sigma * random.Normal(1), sigma});
  return zeros;
}

TEST(WarmUp, AColdInstrumentIsStillDrifting) {
  const WarmUp warm_up = CheckWarmUp(Warming(12, 20, 600, 0.2, 1), 2);
  EXPECT_TRUE(warm_up.still_drifting);
  EXPECT_FALSE(warm_up.settled_since_s);
  EXPECT_EQ(warm_up.window_s, 600);
  // From 60 s to 660 s the approach goes from -18.1 to -6.7: 11.4 in ten minutes.
  EXPECT_NEAR(warm_up.drift_per_10_min->value, 11.4, 0.6);  // the secant's difference to the slope
  EXPECT_NE(warm_up.sentence.find("Still drifting"), std::string::npos);
}

TEST(WarmUp, AWarmInstrumentIsSettledAndItsTimeConstantKnown) {
  const WarmUp warm_up = CheckWarmUp(Warming(90, 20, 600, 0.2, 2), 2);
  EXPECT_FALSE(warm_up.still_drifting);
  ASSERT_TRUE(warm_up.settled_since_s);
  // 20 exp(-t / 600) is below 0.2 from 2763 s on and above 2 until 1382 s.
  EXPECT_GT(*warm_up.settled_since_s, 1382);
  EXPECT_LT(*warm_up.settled_since_s, 4000);
  ASSERT_TRUE(warm_up.time_constant_s);
  EXPECT_NEAR(warm_up.time_constant_s->value, 600,
              4 * warm_up.time_constant_s->standard_uncertainty);
  EXPECT_LT(warm_up.time_constant_s->standard_uncertainty, 30);
}

TEST(WarmUp, TimeConstantsCover) {
  constexpr int kRuns = 400;
  int within = 0, total = 0;
  for (int run = 0; run < kRuns; ++run) {
    const WarmUp warm_up =
        CheckWarmUp(Warming(60, 10, 500, 0.3, static_cast<std::uint64_t>(100 + run)), 2);
    ASSERT_TRUE(warm_up.time_constant_s);
    ++total;
    within += std::abs(warm_up.time_constant_s->value - 500) <
              ExpandedUncertainty(*warm_up.time_constant_s, 2);
  }
  EXPECT_EQ(total, kRuns);
  EXPECT_GE(within, 369);  // three binomial sigmas about 95.45 % of 400
  EXPECT_LE(within, 395);
}

TEST(WarmUp, NoiseAloneDriftsAsOftenAsItsCoverageSays) {
  constexpr int kRuns = 400;
  int drifting = 0, constants = 0;
  for (int run = 0; run < kRuns; ++run) {
    const WarmUp warm_up =
        CheckWarmUp(Warming(30, 0, 600, 0.3, static_cast<std::uint64_t>(700 + run)), 2);
    drifting += warm_up.still_drifting;
    constants += warm_up.time_constant_s.has_value();
  }
  EXPECT_GE(drifting, 5);  // 4.55 % of 400 = 18.2, three binomial sigmas 12.5
  EXPECT_LE(drifting, 31);
  EXPECT_LE(constants, 31);  // no more than that either
}

TEST(WarmUp, TooFewReadingsAreSaidSo) {
  for (int count = 0; count < 3; ++count) {
    const WarmUp warm_up = CheckWarmUp(Warming(count, 1, 600, 0.2, 4), 2);
    EXPECT_FALSE(warm_up.drift_per_10_min);
    EXPECT_NE(warm_up.sentence.find("cannot be told"), std::string::npos);
  }
  auto together = Warming(4, 1, 600, 0.2, 4);
  for (ZeroReading& zero : together) zero.time_s = 7;
  EXPECT_FALSE(CheckWarmUp(together, 2).drift_per_10_min);
}

}  // namespace
}  // namespace telestrain
