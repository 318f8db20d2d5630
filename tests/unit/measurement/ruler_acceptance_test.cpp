#include "measurement/ruler_acceptance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::MakeSyntheticArray;
using testing_support::Random;
using testing_support::SyntheticArray;

constexpr double kNoise_um = 0.4, kRulerSigma_um = 0.25;

struct Bench {
  Session session;
  ArrayCalibration array;
};

Bench MakeBench() {
  SyntheticArray synthetic = MakeSyntheticArray({});
  Bench bench;
  bench.session = synthetic.session;
  bench.session.ruler = {27.6, kRulerSigma_um};
  bench.session.acceptance.ruler_mpe_um = 3;
  bench.array.lenses = {synthetic.lens};
  bench.array.views = synthetic.views;
  return bench;
}

// A ruler somewhere in the field whose error is noise, what all rulers share, and
// `error_of_middle`.
template <typename ErrorOfMiddle>
std::vector<RulerLength> Measure(int count, double shared_um, const ErrorOfMiddle& error_of_middle,
                                 Random& random) {
  std::vector<RulerLength> lengths;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d middle(random.Uniform(-1, 1), random.Uniform(-1, 1),
                                 random.Uniform(-1, 1));
    const Eigen::Vector3d direction =
        Eigen::Vector3d(1, random.Uniform(-0.02, 0.02), random.Uniform(-0.02, 0.02)).normalized();
    RulerLength length;
    length.image = "ruler_" + std::to_string(i);
    length.error_um = shared_um + error_of_middle(middle) + random.Normal(kNoise_um);
    length.length_mm = 27.6 + 1e-3 * length.error_um;
    length.end_a_in_array_mm = middle - 13.8 * direction;
    length.end_b_in_array_mm = middle + 13.8 * direction;
    length.budget = {{kCrossPositions, kNoise_um},
                     {kCalibrationNoise, 0},
                     {kTargetCertificate, 0},
                     {kRulerCertificate, kRulerSigma_um}};
    length.standard_uncertainty_um = Combine(length.budget);
    lengths.push_back(length);
  }
  return lengths;
}

double NoTrend(const Eigen::Vector3d&) { return 0; }

const ErrorTrend& TrendOn(const RulerAcceptance& acceptance, const std::string& on) {
  for (const ErrorTrend& trend : acceptance.trends)
    if (trend.on == on) return trend;
  throw std::logic_error("no trend on " + on);
}

TEST(RulerAcceptance, FindsASlopeACurvatureAndNothingElse) {
  const Bench bench = MakeBench();
  Random random(1);
  const Eigen::Vector3d axis = MeanViewingDirection(bench.array);
  const auto lengths = Measure(
      80, 0, [&](const Eigen::Vector3d& m) { return 1.5 * m.dot(axis) + 2 * m.x() * m.x(); },
      random);
  const RulerAcceptance acceptance = AcceptRuler(bench.session, bench.array, lengths);
  EXPECT_EQ(acceptance.trends.size(), 8u);
  const ErrorTrend& depth = TrendOn(acceptance, "depth");
  EXPECT_TRUE(depth.significant);
  EXPECT_NEAR(depth.slope.value, 1.5, 4 * depth.slope.standard_uncertainty);
  EXPECT_NEAR(depth.effect_um.value, depth.slope.value * depth.range, 1e-12);
  const ErrorTrend& bow = TrendOn(acceptance, "x²");
  EXPECT_TRUE(bow.significant);
  EXPECT_NEAR(bow.slope.value, 2, 4 * bow.slope.standard_uncertainty);
  for (const char* on : {"y", "y²", "yaw", "pitch"})
    EXPECT_FALSE(TrendOn(acceptance, on).significant) << on;
}

TEST(RulerAcceptance, NoiseAloneIsRarelyATrendAndTheBiasIsCovered) {
  const Bench bench = MakeBench();
  constexpr int kRuns = 400;
  int any = 0, bias_within = 0;
  for (int run = 0; run < kRuns; ++run) {
    Random random(static_cast<std::uint64_t>(200 + run));
    const double certificate_error_um = random.Normal(kRulerSigma_um);
    const auto lengths = Measure(20, certificate_error_um, NoTrend, random);
    const RulerAcceptance acceptance = AcceptRuler(bench.session, bench.array, lengths);
    bool significant = false;
    for (const ErrorTrend& trend : acceptance.trends) significant |= trend.significant;
    any += significant;
    bias_within += std::abs(acceptance.bias_um.value) < ExpandedUncertainty(acceptance.bias_um, 2);
  }
  // At most 4.55 % of 400 = 18.2 and three binomial sigmas (Bonferroni is an upper bound).
  EXPECT_LE(any, 31);
  EXPECT_GE(bias_within, 369);  // 95.45 % of 400 = 381.8, three sigmas 12.5
  EXPECT_LE(bias_within, 395);
}

TEST(RulerAcceptance, EveryValueIsDecidedAndTheWorstComeFirst) {
  const Bench bench = MakeBench();
  Random random(3);
  auto lengths = Measure(12, 0, NoTrend, random);
  lengths[4].error_um = -2.5;  // 2.5 + 2 · 0.47 is beyond 3
  lengths[7].error_um = 5;
  lengths[2].rejected_because = "no cross";
  const RulerAcceptance acceptance = AcceptRuler(bench.session, bench.array, lengths);
  ASSERT_EQ(acceptance.decisions.size(), 11u);
  ASSERT_EQ(acceptance.worst.size(), 5u);
  const auto& first = acceptance.decisions[acceptance.worst[0]];
  const auto& second = acceptance.decisions[acceptance.worst[1]];
  EXPECT_EQ(first.length, 7u);
  EXPECT_EQ(first.decision->verdict, Verdict::kFail);
  EXPECT_EQ(second.length, 4u);
  EXPECT_EQ(second.decision->verdict, Verdict::kDoubt);
  EXPECT_NE(acceptance.count_sentence.find("24 more are wanted"), std::string::npos);
  const auto json = RulerAcceptanceJson(acceptance, lengths, 2);
  EXPECT_EQ(json["worst"][0], "ruler_7");
  EXPECT_EQ(json["images"].size(), 11u);
  EXPECT_EQ(json["images"][0]["budget"].size(), 4u);
}

TEST(RulerAcceptance, RepeatedPosesGiveTheRepeatability) {
  const Bench bench = MakeBench();
  Random random(4);
  auto lengths = Measure(
      20, 0, [](const Eigen::Vector3d& m) { return 5 * m.y(); }, random);
  const auto once = AcceptRuler(bench.session, bench.array, lengths).repeatability;
  EXPECT_EQ(once.degrees_of_freedom, 14);  // 20 images, mean and five coordinates
  // Relative standard deviation 1 / sqrt(2 · 14), four of them.
  EXPECT_NEAR(once.sd_um, kNoise_um, 4 * kNoise_um / std::sqrt(28.0));
  for (std::size_t i = 0; i < 20; i += 2) {  // pairs of one pose: the trend cancels
    lengths[i + 1].end_a_in_array_mm = lengths[i].end_a_in_array_mm;
    lengths[i + 1].end_b_in_array_mm = lengths[i].end_b_in_array_mm;
    lengths[i].error_um = 5.0 * static_cast<double>(i) + random.Normal(kNoise_um);
    lengths[i + 1].error_um = 5.0 * static_cast<double>(i) + random.Normal(kNoise_um);
  }
  const auto repeated = AcceptRuler(bench.session, bench.array, lengths).repeatability;
  EXPECT_EQ(repeated.degrees_of_freedom, 10);
  EXPECT_NEAR(repeated.sd_um, kNoise_um, 4 * kNoise_um / std::sqrt(20.0));
  EXPECT_NE(repeated.method.find("10 poses"), std::string::npos);
}

TEST(RulerAcceptance, PosesAreRightForEitherOrderOfTheGroups) {
  RulerLength length;
  length.end_a_in_array_mm = {-13.8, 0, 0.2};
  length.end_b_in_array_mm = {13.8, 0.5, -0.2};
  const RulerPose pose = PoseOf(length, -Eigen::Vector3d::UnitZ());
  std::swap(length.end_a_in_array_mm, length.end_b_in_array_mm);
  const RulerPose turned = PoseOf(length, -Eigen::Vector3d::UnitZ());
  constexpr double kDegPerRad = 57.29577951308232;
  EXPECT_NEAR(pose.pitch_deg, kDegPerRad * std::asin(0.4 / std::hypot(27.6, 0.5, 0.4)), 1e-9);
  EXPECT_NEAR(std::abs(pose.yaw_deg), kDegPerRad * std::atan(0.5 / 27.6), 1e-9);
  EXPECT_NEAR(turned.pitch_deg, pose.pitch_deg, 1e-12);
  EXPECT_NEAR(turned.yaw_deg, pose.yaw_deg, 1e-12);
  EXPECT_NEAR(pose.depth_mm, 0, 1e-12);
}

TEST(RulerAcceptance, MissingCertificatesAreSaid) {
  Bench bench = MakeBench();
  Random random(5);
  bench.session.target.sigma_separation_um = bench.session.target.sigma_square_um = 0.1;
  const auto lengths = Measure(3, 0, NoTrend, random);
  EXPECT_TRUE(AcceptRuler(bench.session, bench.array, lengths).not_in_budget.empty());
  bench.session.ruler.sigma_length_um = 0;
  bench.session.target.sigma_separation_um = 0;
  EXPECT_EQ(AcceptRuler(bench.session, bench.array, lengths).not_in_budget.size(), 2u);
  EXPECT_TRUE(AcceptRuler(bench.session, bench.array, {}).decisions.empty());
}

TEST(RulerAcceptance, ARulerThatTheCalibrationSawIsRefused) {
  Session session;
  session.calibration_images = {{"calibration/a.png", "1", 0}, {"calibration/b.png", "2", 0}};
  session.ruler_images = {"ruler/r.png", "ruler/s.png"};
  std::map<std::string, std::string> hashes = {{"calibration/a.png", "aa"},
                                               {"calibration/b.png", "bb"},
                                               {"ruler/r.png", "cc"},
                                               {"ruler/s.png", "dd"}};
  EXPECT_TRUE(RequireUnseenRuler(session, hashes));
  hashes["ruler/s.png"] = "bb";
  const Status status = RequireUnseenRuler(session, hashes);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::kBadInput);
  EXPECT_NE(status.error().message.find("ruler/s.png"), std::string::npos);
  EXPECT_NE(status.error().message.find("calibration/b.png"), std::string::npos);
  hashes.erase("calibration/b.png");  // corners given: the image is not there
  EXPECT_TRUE(RequireUnseenRuler(session, hashes));
}

}  // namespace
}  // namespace telestrain
