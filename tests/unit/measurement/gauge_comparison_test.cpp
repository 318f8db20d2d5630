#include "measurement/gauge_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/measurement/load_sequence.h"

namespace telestrain {
namespace {

using testing_support::Random;

constexpr double kSigma = 1;

// Four gauges around a pipe that is stretched to 750 and bent to `bending`, both with the load.
Session LoadedPipe(double bending, Random& random) {
  Session session;
  session.gauge_columns = {"gauge_1", "gauge_2", "gauge_3", "gauge_4"};
  session.pipe.sigma_gauge_microstrain = kSigma;
  for (int i = 0; i <= 10; ++i) {
    const double share = (i <= 5 ? i : 10 - i) / 5.0;
    PipeState& state = session.pipe_states.emplace_back();
    state.image = "state_" + std::to_string(i);
    for (int gauge = 0; gauge < 4; ++gauge) {
      const double around = bending * std::cos(1.5707963267948966 * gauge + 0.3);
      state.gauges_microstrain.push_back(40 * gauge + share * (750 + around) +
                                         random.Normal(kSigma));
    }
  }
  return session;
}

TEST(GaugeComparison, BendingIsNoOutlier) {
  int named = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    named += static_cast<int>(FindGaugeOutliers(LoadedPipe(150, random)).size());
  }
  // 2000 readings beyond four sigma: 0.13 by chance.
  EXPECT_LE(named, 2);
}

TEST(GaugeComparison, AGaugeThatJumpsIsNamed) {
  Random random(7);
  Session session = LoadedPipe(150, random);
  *session.pipe_states[4].gauges_microstrain[2] += 15;
  const auto outliers = FindGaugeOutliers(session);
  ASSERT_EQ(outliers.size(), 1u);
  EXPECT_EQ(outliers[0].column, "gauge_3");
  EXPECT_EQ(outliers[0].image, "state_4");
  // Of a change, its proportion and the others: 15 within four of that.
  EXPECT_NEAR(outliers[0].deviation_microstrain, 15, 4 * outliers[0].sigma_microstrain);
  EXPECT_GT(outliers[0].sigma_microstrain, std::sqrt(2.0) * kSigma);
}

TEST(GaugeComparison, ABendingThatCameForOnceIsNoGaugesFault) {
  Random random(8);
  Session session = LoadedPipe(0, random);
  *session.pipe_states[5].gauges_microstrain[0] += 40;
  *session.pipe_states[5].gauges_microstrain[2] -= 40;
  EXPECT_TRUE(FindGaugeOutliers(session).empty());
}

TEST(GaugeComparison, NobodyIsNamedWithoutAnUncertainty) {
  Random random(9);
  Session session = LoadedPipe(0, random);
  *session.pipe_states[4].gauges_microstrain[2] += 50;
  session.pipe.sigma_gauge_microstrain.reset();
  EXPECT_TRUE(FindGaugeOutliers(session).empty());
}

TEST(GaugeComparison, TheMeanHasTheUncertaintyOfThoseThatRead) {
  PipeState reference, state;
  reference.gauges_microstrain = {10.0, 20.0, std::nullopt, 30.0};
  state.gauges_microstrain = {110.0, 130.0, 5.0, std::nullopt};
  EXPECT_EQ(ChangeOfGauges(reference, state), 105.0);
  EXPECT_EQ(MeanOfGauges(state), (110.0 + 130.0 + 5.0) / 3);
  EXPECT_DOUBLE_EQ(*SigmaOfGauges(reference, state, {3.0, 4.0, 7.0, 7.0}), 2.5);
  EXPECT_FALSE(SigmaOfGauges(reference, state, {3.0, std::nullopt, 7.0, 7.0}));
  EXPECT_FALSE(ChangeOfGauges(reference, {}));
}

TEST(GaugeComparison, TheErrorsUncertaintyHoldsBoth) {
  testing_support::SequenceFaults faults;
  Random random(10);
  auto states = MakeSequence(faults, random);
  auto comparison = CompareWithGauges(states);
  ASSERT_TRUE(comparison);
  EXPECT_EQ(comparison->count, 30);
  EXPECT_NEAR(comparison->standard_uncertainty_microstrain, std::sqrt(2.0) * 0.2, 1e-12);
  ASSERT_TRUE(comparison->error_uncertainty_microstrain);
  EXPECT_NEAR(*comparison->error_uncertainty_microstrain, std::sqrt(2 * (0.04 + 0.25)), 1e-12);
  states[3].gauge_sigma_microstrain.reset();
  EXPECT_FALSE(CompareWithGauges(states)->error_uncertainty_microstrain);
}

}  // namespace
}  // namespace telestrain
