#include "diagnostics/pinhole_comparison.h"

#include <gtest/gtest.h>

#include <numeric>

#include "unit/diagnostics/pinhole_array.h"

namespace telestrain {
namespace {

using testing_support::MakeCase;
using testing_support::PinholeCase;
using testing_support::SyntheticOptions;

class PinholeComparisonTest : public testing::Test {
 protected:
  PinholeComparisonTest() : made_(Made()), crosses_(MakeRulers(made_.array, 4)) {}

  static PinholeCase Made() {
    SyntheticOptions options;
    options.poses = 5;
    return MakeCase(options);
  }
  PinholeComparison Compare(const PinholeComparisonOptions& options) const {
    return ComparePinhole(made_.array.session, made_.data, made_.telecentric, crosses_, options)
        .value();
  }

  PinholeCase made_;
  std::vector<CrossObservation> crosses_;
};

TEST_F(PinholeComparisonTest, ErrorsFallWithTheDistanceDownToTheTelecentricOnes) {
  const PinholeComparison found = Compare({});
  ASSERT_EQ(found.arms.size(), 7u);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_LT(found.arms[i].reprojection.rms_px, found.arms[i - 1].reprojection.rms_px);
    EXPECT_GT(found.arms[i].working_distance_mm, found.arms[i - 1].working_distance_mm);
  }
  // Perspective of the paper's array: 1.3 px at 100 mm, an eighth of the noise at 10 m.
  EXPECT_GT(found.arms[0].ruler_rmse_um, 20 * found.arms[3].ruler_rmse_um);
  ASSERT_TRUE(found.AsGoodFrom_mm());
  EXPECT_EQ(*found.AsGoodFrom_mm(), 1e4);
}

TEST_F(PinholeComparisonTest, FiveCoefficientsDoNotMakeAPinholeTelecentric) {
  const PinholeComparison found = Compare({});
  const PinholeArm &plain = found.arms[0], &distorted = found.arms[4];
  ASSERT_EQ(plain.working_distance_mm, distorted.working_distance_mm);
  EXPECT_TRUE(distorted.five_coefficients);
  EXPECT_LT(distorted.reprojection.rms_px, plain.reprojection.rms_px);
  EXPECT_GT(distorted.reprojection.rms_px, 10 * found.telecentric.rms_px);
}

TEST_F(PinholeComparisonTest, EveryCornerAndRulerIsCounted) {
  PinholeComparisonOptions options;
  options.distances_mm = {1000};
  options.distorted_distances_mm = {};
  const PinholeComparison found = Compare(options);
  const auto counted = [](const std::vector<int>& histogram) {
    return std::accumulate(histogram.begin(), histogram.end(), 0);
  };
  EXPECT_EQ(counted(found.telecentric_histogram), made_.data.CornerCount());
  EXPECT_EQ(counted(found.arms[0].histogram), made_.data.CornerCount());
  EXPECT_EQ(found.arms[0].ruler_error_um.size(), 4u);
  EXPECT_GE(found.arms[0].ruler_max_um, found.arms[0].ruler_rmse_um);
  EXPECT_TRUE(found.arms[0].converged);
}

TEST_F(PinholeComparisonTest, SeedsNearTheSolutionReturnToItAndFarOnesDoNotAll) {
  PinholeComparisonOptions options;
  options.distances_mm = {1000};
  options.distorted_distances_mm = {};
  options.seeds = 8;
  options.seed_turn_deg = 2;
  EXPECT_EQ(Compare(options).arms[0].wrong_minima, 0);
  // Beyond a right angle half of the views look from behind.
  options.seed_turn_deg = 120;
  const PinholeArm far = Compare(options).arms[0];
  EXPECT_EQ(far.starts, 8);
  EXPECT_GT(far.wrong_minima, 0);
}

TEST_F(PinholeComparisonTest, TheThreadsDoNotChangeTheBytes) {
  PinholeComparisonOptions options;
  options.threads = 1;
  const PinholeComparison first = Compare(options);
  options.threads = 4;
  const PinholeComparison second = Compare(options);
  for (std::size_t i = 0; i < first.arms.size(); ++i) {
    EXPECT_EQ(first.arms[i].reprojection.rms_px, second.arms[i].reprojection.rms_px);
    EXPECT_EQ(first.arms[i].ruler_error_um, second.arms[i].ruler_error_um);
  }
}

}  // namespace
}  // namespace telestrain
