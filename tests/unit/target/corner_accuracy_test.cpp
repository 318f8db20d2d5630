#include <gtest/gtest.h>

#include <iostream>

#include "random_view.h"
#include "target/target_detector.h"

namespace telestrain {
namespace {

using testing::RandomView;
using testing::ViewLimits;

// Errors of all corners of several views and how they compare with the stated covariances.
struct ErrorStatistics {
  double squares_px2 = 0;    // of the error's norm
  double normalised = 0;     // e^T cov^-1 e, expectation 2
  double predicted_px2 = 0;  // trace of the covariance
  int count = 0;

  double Rms_px() const { return std::sqrt(squares_px2 / count); }
  double PredictedRms_px() const { return std::sqrt(predicted_px2 / count); }
  double NormalisedPerCoordinate() const { return normalised / (2 * count); }
};

void Add(const RandomView& view, std::uint32_t seed, ErrorStatistics* statistics) {
  const auto observation = DetectBoard(testing::Render(view, seed), view.search);
  ASSERT_EQ(observation.rejected_because, "") << seed;
  for (int i = 0; i < view.scene.columns * view.scene.rows; ++i) {
    const auto& corner = observation.corners[static_cast<std::size_t>(i)];
    if (!corner) continue;
    const Eigen::Vector2d error =
        corner->pixel - view.scene.Corner(i % view.scene.columns, i / view.scene.columns);
    statistics->squares_px2 += error.squaredNorm();
    statistics->normalised += error.dot(corner->covariance_px2.inverse() * error);
    statistics->predicted_px2 += corner->covariance_px2.trace();
    ++statistics->count;
  }
}

void Report(const char* what, const ErrorStatistics& statistics) {
  std::cout << what << ": rms " << statistics.Rms_px() << " px, predicted "
            << statistics.PredictedRms_px() << " px, normalised "
            << statistics.NormalisedPerCoordinate() << " (" << statistics.count << ")\n";
}

ErrorStatistics Measure(const char* what, const ViewLimits& limits, int views,
                        std::uint32_t first_seed) {
  ErrorStatistics statistics;
  std::uint32_t seed = first_seed;
  for (int done = 0; done < views; ++seed) {
    RandomView view = testing::MakeRandomView(limits, seed);
    if (view.LeastDistanceToEdge_px(0.5) < 0) continue;
    view.scene.dark_gray = 30;
    view.scene.bright_gray = 220;
    view.scene.gradient *= 0.4;  // keeps the levels off 0 and 255
    Add(view, seed, &statistics);
    ++done;
  }
  Report(what, statistics);
  return statistics;
}

// The mean of n squared normal numbers scatters by sqrt(2/n): with n > 1000 coordinates 0.15 is
// more than three standard deviations.
constexpr double kHonesty = 0.15;

TEST(CornerAccuracy, IsThreeHundredthsOfATenthOfAPixelForABoardSeenFrontally) {
  RandomView view = testing::MakeRandomView({}, 1);
  view.scene.side_px = 68 * Eigen::Rotation2Dd(0.1).toRotationMatrix();
  view.search.nominal_px_per_mm = 68 / 0.3 * Eigen::Matrix2d::Identity();
  view.scene.origin_px =
      view.search.region.Middle() - view.scene.side_px * Eigen::Vector2d(6.03, 4.02);
  view.scene.dark_gray = 30;
  view.scene.bright_gray = 220;
  view.scene.gradient.setZero();
  view.scene.blur_px = 0.8;
  ErrorStatistics statistics;
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    view.scene.origin_px += Eigen::Vector2d(0.37, 0.21);
    Add(view, seed, &statistics);
  }
  Report("frontal", statistics);
  EXPECT_LT(statistics.Rms_px(), 0.0035);  // Cramer-Rao bound 0.0027
  EXPECT_NEAR(statistics.NormalisedPerCoordinate(), 1, kHonesty);
}

TEST(CornerAccuracy, CovarianceIsHonestForObliqueViews) {
  ViewLimits limits;
  limits.least_blur_px = 0.7;
  limits.largest_blur_px = 1.5;
  limits.turn_rad = 0.3;
  const auto statistics = Measure("oblique", limits, 6, 100);
  EXPECT_LT(statistics.Rms_px(), 0.007);
  EXPECT_NEAR(statistics.NormalisedPerCoordinate(), 1, kHonesty);
}

TEST(CornerAccuracy, CovarianceIsHonestForABinnedSensor) {
  ViewLimits limits;
  limits.side_px = 17;
  limits.region = {0, 0, 324, 243};
  limits.shift_px = 5;
  limits.least_blur_px = 0.6;
  limits.largest_blur_px = 0.9;
  limits.turn_rad = 0.3;
  const auto statistics = Measure("binned", limits, 20, 200);
  EXPECT_LT(statistics.Rms_px(), 0.02);
  EXPECT_NEAR(statistics.NormalisedPerCoordinate(), 1, kHonesty);
}

TEST(CornerAccuracy, CovarianceIsHonestOutOfFocusAndWithNoise) {
  ViewLimits limits;
  limits.least_blur_px = 2.5;
  limits.largest_blur_px = 3;
  limits.turn_rad = 0.3;
  limits.noise_gray = 5;
  const auto statistics = Measure("blurred, noise 5", limits, 4, 300);
  EXPECT_NEAR(statistics.NormalisedPerCoordinate(), 1, kHonesty);
}

}  // namespace
}  // namespace telestrain
