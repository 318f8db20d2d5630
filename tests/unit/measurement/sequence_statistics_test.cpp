#include "measurement/sequence_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "unit/measurement/load_sequence.h"

namespace telestrain {
namespace {

using testing_support::MakeSequence;
using testing_support::Random;
using testing_support::SequenceFaults;

constexpr SequenceOptions kOptions{27.7, 2, 0.44e-3};
// Runs and the three-sigma binomial band of 95.45 % of them: 382 ± 12.5.
constexpr int kRuns = 400, kFewest = 369, kMost = 395;

// How often an estimate's interval holds its truth.
class Coverage {
 public:
  void Add(const Estimate& estimate, double truth) {
    within_ += std::abs(estimate.value - truth) < ExpandedUncertainty(estimate, 2);
    ++total_;
  }
  void Expect(const char* what) const {
    EXPECT_EQ(total_, kRuns) << what;
    EXPECT_GE(within_, kFewest) << what;
    EXPECT_LE(within_, kMost) << what;
  }

 private:
  int within_ = 0, total_ = 0;
};

TEST(SequenceStatistics, TheDriftOfZeroStatesIsCovered) {
  SequenceFaults faults;
  faults.cycles = 6;
  faults.drift_per_hour = 0.8;
  Coverage drift;
  for (int run = 0; run < kRuns; ++run) {
    Random random(static_cast<std::uint64_t>(5000 + run));
    const auto states = MakeSequence(faults, random);
    const auto statistics = AnalyseSequence(states, kOptions);
    ASSERT_TRUE(statistics.drift_per_hour);
    drift.Add(*statistics.drift_per_hour, 0.8);
  }
  drift.Expect("drift");
}

TEST(SequenceStatistics, SlopesAndInterceptsAreCovered) {
  SequenceFaults faults;
  faults.cycles = 2;
  faults.slope = 1.004;
  Coverage slope, intercept, cycle_slope, cycle_intercept, zero;
  for (int run = 0; run < kRuns; ++run) {
    Random random(static_cast<std::uint64_t>(1000 + run));
    const auto statistics = AnalyseSequence(MakeSequence(faults, random), kOptions);
    ASSERT_TRUE(statistics.regression);
    slope.Add(statistics.regression->line.slope, 1.004);
    intercept.Add(statistics.regression->line.intercept, 0);
    ASSERT_EQ(statistics.cycles.size(), 2u);
    ASSERT_TRUE(statistics.cycles[1].regression);
    cycle_slope.Add(statistics.cycles[1].regression->line.slope, 1.004);
    cycle_intercept.Add(statistics.cycles[1].regression->line.intercept, 0);
  }
  slope.Expect("slope");
  intercept.Expect("intercept");
  cycle_slope.Expect("slope of the second cycle");
  cycle_intercept.Expect("intercept of the second cycle");
}

TEST(SequenceStatistics, BiasHysteresisAndNoiseFloorCover) {
  SequenceFaults faults;
  faults.hysteresis = 2;
  faults.steps_up = 4;  // an unloading state stands at half load
  faults.cycles = 4;
  Coverage bias, floor;
  double mean_of_loop = 0;
  for (int run = 0; run < kRuns; ++run) {
    Random random(static_cast<std::uint64_t>(9000 + run));
    faults.hysteresis = 0;
    const auto level = AnalyseSequence(MakeSequence(faults, random), kOptions);
    bias.Add(level.regression->bias, 0);
    ASSERT_TRUE(level.moved || level.still);
    floor.Add(level.still->mean, 0);
    faults.hysteresis = 2;
    const auto loop = AnalyseSequence(MakeSequence(faults, random), kOptions);
    ASSERT_TRUE(loop.cycles[0].hysteresis);
    mean_of_loop += loop.cycles[0].hysteresis->mean.value / kRuns;
  }
  bias.Expect("bias");
  floor.Expect("noise floor");
  // The loop at 3/4, 1/2, 1/4 load: 1.5, 2, 1.5. An unloading state without load, at 0, counts
  // where noise puts it inside the loading branch: the mean of the two cases is what the runs
  // average to.
  EXPECT_GT(mean_of_loop, 1.25);  // (1.5 + 2 + 1.5 + 0) / 4
  EXPECT_LT(mean_of_loop, 5.0 / 3);
}

TEST(SequenceStatistics, KnownFaultsWithoutNoiseAreExact) {
  SequenceFaults faults;
  faults.slope = 1.01;
  faults.hysteresis = 3;
  faults.steps_up = 4;
  Random random(1);
  faults.camera_sigma = faults.gauge_sigma = 0;
  auto states = MakeSequence(faults, random);
  for (auto& state : states) {  // uncertain, though free of noise
    state.camera_sigma_microstrain = 0.1;
    state.gauge_sigma_microstrain = 0.1;
  }
  const auto statistics = AnalyseSequence(states, kOptions);
  ASSERT_EQ(statistics.cycles.size(), 3u);
  for (const CycleStatistics& cycle : statistics.cycles) {
    ASSERT_TRUE(cycle.hysteresis);
    // 1e-9: rounding of hundreds of microstrain.
    EXPECT_NEAR(cycle.hysteresis->largest.value, 3, 1e-9);
    EXPECT_NEAR(cycle.hysteresis->at_microstrain, 375, 1e-9);
    EXPECT_EQ(cycle.hysteresis->count, 4);
    ASSERT_TRUE(cycle.zero);
    EXPECT_NEAR(cycle.zero->value, 0, 1e-9);
  }
  EXPECT_EQ(statistics.zero_states, (std::vector<std::size_t>{8, 16, 24}));
  ASSERT_TRUE(statistics.repeatability);
  EXPECT_EQ(statistics.repeatability->groups, 8);
  EXPECT_NEAR(statistics.repeatability->sd, 0, 1e-9);
  EXPECT_NEAR(statistics.regression->line.slope.value, 1.01, 0.004);  // the loop tilts it a little
}

TEST(SequenceStatistics, RepeatabilityIsTheNoiseOfOneReading) {
  SequenceFaults faults;
  faults.cycles = 20;
  Random random(3);
  const auto statistics = AnalyseSequence(MakeSequence(faults, random), kOptions);
  ASSERT_TRUE(statistics.repeatability);
  const double expected = std::hypot(0.2, 0.5);
  EXPECT_NEAR(statistics.repeatability->stated_sd, expected, 1e-12);
  // Relative standard deviation 1 / sqrt(2 · 190), four of them.
  EXPECT_EQ(statistics.repeatability->degrees_of_freedom, 190);
  EXPECT_NEAR(statistics.repeatability->sd, expected, 4 * expected / std::sqrt(380.0));
}

TEST(SequenceStatistics, RigidMotionPartsTheNoiseFloors) {
  SequenceFaults faults;
  faults.camera_sigma = 0.2;
  Random random(4);
  auto states = MakeSequence(faults, random);
  states[10].translation_mm = {0.1, 0, 0};
  states[20].rotation_rad = {0, 0.001, 0};  // 13.85 mm away from the middle: 14 um
  const auto statistics = AnalyseSequence(states, kOptions);
  ASSERT_TRUE(statistics.still);
  ASSERT_TRUE(statistics.moved);
  EXPECT_EQ(statistics.still->count, 1);
  EXPECT_EQ(statistics.moved->count, 2);
  EXPECT_NEAR(statistics.moved->largest_motion_mm, 0.1, 1e-12);
  EXPECT_NEAR(statistics.moved->stated_sd, 0.2, 1e-12);
}

TEST(SequenceStatistics, WorksWithoutGaugesAndWithoutTimes) {
  SequenceFaults faults;
  Random random(5);
  auto states = MakeSequence(faults, random);
  for (auto& state : states) {
    state.gauge_microstrain.reset();
    state.gauge_sigma_microstrain.reset();
    state.time_s.reset();
  }
  states[10].step = "0";
  const auto statistics = AnalyseSequence(states, kOptions);
  EXPECT_FALSE(statistics.regression);
  EXPECT_FALSE(statistics.iso9513);
  EXPECT_FALSE(statistics.drift_per_hour);
  EXPECT_EQ(statistics.zero_states, std::vector<std::size_t>{10});
  EXPECT_NE(statistics.warm_up.sentence.find("cannot be told"), std::string::npos);
  const auto json = SequenceJson(statistics, states, 2);
  EXPECT_TRUE(json["regression"].is_null());
  EXPECT_EQ(json["zero_states"][0], "state_10");
  EXPECT_TRUE(AnalyseSequence({}, kOptions).cycles.empty());
  EXPECT_FALSE(AnalyseSequence({states[0]}, kOptions).regression);
}

// Images that are watched as they come have no labels: a loaded state must not count as a zero one.
TEST(SequenceStatistics, StatesWithoutLabelsAreNoZeroStates) {
  Random random(6);
  auto states = MakeSequence(SequenceFaults{}, random);
  for (auto& state : states) {
    state.gauge_microstrain.reset();
    state.gauge_sigma_microstrain.reset();
    state.step.clear();
  }
  const auto statistics = AnalyseSequence(states, kOptions);
  EXPECT_TRUE(statistics.zero_states.empty());
  EXPECT_FALSE(statistics.still);
  EXPECT_FALSE(statistics.moved);
  EXPECT_FALSE(statistics.repeatability);
  EXPECT_FALSE(statistics.drift_per_hour);
}

TEST(SequenceStatistics, ClassesAreThoseOfTheLargestError) {
  // 1 mm of base: a microstrain is a nanometre.
  const auto point = [](double indicated, double reference) {
    return ClassPoint{"s", indicated, reference, 0.0};
  };
  const auto iso = [&](double error_um, double reference_um) {
    const auto result =
        ClassifyIso9513({point(1e3 * (reference_um + error_um), 1e3 * reference_um)}, {}, 1.0);
    return result ? result->name : "no result";
  };
  EXPECT_EQ(iso(0.59, 20), "0.2");
  EXPECT_EQ(iso(0.61, 20), "0.5");
  EXPECT_EQ(iso(-1.49, 20), "0.5");
  EXPECT_EQ(iso(2.9, 20), "1");
  EXPECT_EQ(iso(5.9, 20), "2");
  EXPECT_EQ(iso(6.1, 20), "");
  EXPECT_EQ(iso(1.9, 1000), "0.2");  // 0.2 % of 1000
  const auto e83 = [&](double error, double reference) {
    return ClassifyAstmE83({point(reference + error, reference)}, {})->name;
  };
  EXPECT_EQ(e83(19.9, 500), "A");
  EXPECT_EQ(e83(20.1, 500), "B-1");
  EXPECT_EQ(e83(101, 500), "B-2");
  EXPECT_EQ(e83(201, 500), "C");
  EXPECT_EQ(e83(1001, 500), "D");
  EXPECT_EQ(e83(10001, 500), "");
  EXPECT_EQ(e83(29, 30000), "A");  // 0.1 %
}

TEST(SequenceStatistics, AClassNeedsItsResolutionAndIsProvenOnlyWithU) {
  const std::vector<ClassPoint> points{{"a", 505, 500, 18}};
  auto result = ClassifyAstmE83(points, 5);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->name, "A");
  EXPECT_EQ(result->proven, "B-1");  // 5 + 18 is beyond 20
  EXPECT_EQ(result->worst_error, 5);
  EXPECT_EQ(result->worst_limit, 20);
  EXPECT_EQ(ClassifyAstmE83(points, 11)->name, "B-1");
  EXPECT_EQ(ClassifyAstmE83(points, {})->not_covered.size(), 4u);
  EXPECT_FALSE(ClassifyAstmE83({}, 5));
  EXPECT_FALSE(ClassifyIso9513(points, 5, 0));
}

}  // namespace
}  // namespace telestrain
