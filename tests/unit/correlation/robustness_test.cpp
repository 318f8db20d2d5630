// Hard starts, hopeless points, borders: every point ends with the right status.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kSide = 300;
const PixelRegion kRegion{0, 0, kSide, kSide};
const Eigen::Vector2d kAbout = kRegion.Middle();
const Eigen::Vector2i kCenter{150, 150};

class Robustness : public testing::Test {
 protected:
  const Speckle speckle_{7, kSide, kSide, 2.0};
  const CorrelationOptions options_{};
  const GrayImage before_ = speckle_.Render(kSide, kSide);
  const CorrelationReference reference_{before_, kRegion, options_};
  const PreparedImage same_{before_, kRegion, options_};
};

// Stereo views across 60 degrees: entries to 0.5, starts wrong by 2 px and 0.05.
TEST_F(Robustness, StrongGradientsConvergeFromCoarseStarts) {
  const std::array<std::array<double, 4>, 5> gradients = {{{0.4, 0, 0, 0},
                                                           {-0.5, 0, 0, 0},
                                                           {0.5, 0.1, -0.1, 0.1},
                                                           {0.05, 0.4, -0.1, 0.05},
                                                           {-0.4, 0.1, 0.2, -0.1}}};
  for (const auto& g : gradients) {
    ShapeFunction map;
    map.displacement_px = {0.3, -0.4};
    map.gradient << g[0], g[1], g[2], g[3];
    const PreparedImage image(speckle_.Render(kSide, kSide, map, kAbout), kRegion, options_);
    for (int k = 0; k < 16; ++k) {
      const Eigen::Vector2i center = kCenter + Eigen::Vector2i(9 * (k % 4) - 15, 9 * (k / 4) - 15);
      const ShapeFunction truth = TruthAt(map, kAbout, center);
      ShapeFunction start = truth;
      const double angle = 0.4 * k;
      start.displacement_px += 2 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      start.gradient.array() += k % 2 ? 0.05 : -0.05;
      const SubsetMatch match = reference_.Match(center, image, start);
      EXPECT_TRUE(match.ok()) << g[0] << " " << g[1] << " " << k << ToText(match.status);
      EXPECT_NEAR((match.shape.displacement_px - truth.displacement_px).norm(), 0, 0.02);
      EXPECT_NEAR((match.shape.gradient - truth.gradient).norm(), 0, 2e-3);
    }
  }
}

TEST_F(Robustness, ABadStartIsReported) {
  ShapeFunction start;
  start.displacement_px = {23, -17};
  const SubsetMatch match = reference_.Match(kCenter, same_, start);
  EXPECT_FALSE(match.ok());
}

// Whatever a start says, no pixel outside the image is read (the sanitizers see it) and the point
// ends with a status: converged only where the image is truly correlated.
TEST_F(Robustness, GarbageStartsEndWithAStatus) {
  const double garbage[] = {std::nan(""),
                            std::numeric_limits<double>::infinity(),
                            -1e300,
                            1e9,
                            -1e9,
                            1e5,
                            0.999,
                            -0.999,
                            150,
                            -150,
                            0};
  std::mt19937 random(9);
  const auto any = [&] { return garbage[random() % std::size(garbage)]; };
  for (int order = 0; order <= 2; ++order) {
    CorrelationOptions options;
    options.shape_order = order;
    const CorrelationReference reference(before_, kRegion, options);
    for (int k = 0; k < 2000; ++k) {
      ShapeFunction start;
      start.displacement_px = {any(), any()};
      for (double& entry : start.gradient.reshaped()) entry = any();
      for (double& entry : start.curvature_per_px.reshaped()) entry = any() / 1000;
      const SubsetMatch match = reference.Match(kCenter, same_, start);
      if (!match.ok()) continue;
      EXPECT_GT(match.zncc, options.min_zncc);
      EXPECT_TRUE(match.shape.displacement_px.allFinite());
    }
  }
}

TEST_F(Robustness, AnotherPatternIsReported) {
  const PreparedImage other(Speckle(8, kSide, kSide, 2.0).Render(kSide, kSide), kRegion, options_);
  for (const auto& match :
       CorrelatePoints(reference_, GridOfCenters(kRegion, 40, 30), other, {ShapeFunction()}))
    EXPECT_FALSE(match.ok()) << match.zncc;
}

TEST_F(Robustness, LowContrastIsReported) {
  GrayImage flat = before_;
  for (float& value : flat.pixels) value = 100 + 0.01f * value;
  const CorrelationReference reference(flat, kRegion, options_);
  EXPECT_EQ(reference.Match(kCenter, same_, {}).status, MatchStatus::kLowContrast);
  const PreparedImage black({kSide, kSide, 255, std::vector<float>(kSide * kSide)}, kRegion, {});
  EXPECT_FALSE(reference_.Match(kCenter, black, {}).ok());
}

// Stripes fix one direction only.
TEST_F(Robustness, StripesAreReported) {
  GrayImage stripes = before_;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      stripes.At(x, y) = static_cast<float>(100 + 50 * std::sin(0.7 * x));
  const CorrelationReference reference(stripes, kRegion, options_);
  EXPECT_EQ(reference.Match(kCenter, {stripes, kRegion, options_}, {}).status,
            MatchStatus::kLowContrast);
}

TEST_F(Robustness, SubsetsBeyondTheBorderAreReported) {
  EXPECT_TRUE(reference_.Match({33, 33}, same_, {}).ok());
  EXPECT_EQ(reference_.Match({32, 150}, same_, {}).status, MatchStatus::kOutside);
  EXPECT_EQ(reference_.Match({150, kSide - 33}, same_, {}).status, MatchStatus::kOutside);
  EXPECT_EQ(reference_.Match({-1000, 150}, same_, {}).status, MatchStatus::kOutside);
  ShapeFunction start;
  start.displacement_px.x() = 1e12;
  EXPECT_EQ(reference_.Match(kCenter, same_, start).status, MatchStatus::kOutside);
}

TEST_F(Robustness, StartsThatAreNoNumbersAreReported) {
  ShapeFunction start;
  start.displacement_px.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reference_.Match(kCenter, same_, start).status, MatchStatus::kNotConverged);
  start.displacement_px.x() = 0;
  start.gradient(0, 1) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(reference_.Match(kCenter, same_, start).status, MatchStatus::kNotConverged);
}

TEST_F(Robustness, PixelsThatAreNoNumbersAreReported) {
  GrayImage broken = before_;
  broken.At(150, 150) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(reference_.Match(kCenter, {broken, kRegion, options_}, {}).ok());
  const CorrelationReference reference(broken, kRegion, options_);
  EXPECT_FALSE(reference.Match(kCenter, same_, {}).ok());
}

// One good start spreads over a field whose other starts are all wrong.
TEST_F(Robustness, FailedPointsAreTakenUpFromTheirNeighbors) {
  ShapeFunction map;
  map.displacement_px = {12, -9};
  map.gradient << 0.02, 0.01, -0.015, 0.01;
  const PreparedImage image(speckle_.Render(kSide, kSide, map, kAbout), kRegion, options_);
  const auto centers = GridOfCenters(kRegion, 50, 20);
  std::vector<ShapeFunction> starts(centers.size());
  starts.front() = TruthAt(map, kAbout, centers.front());
  const auto matches = CorrelatePoints(reference_, centers, image, starts);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    ASSERT_TRUE(matches[i].ok()) << i;
    const ShapeFunction truth = TruthAt(map, kAbout, centers[i]);
    EXPECT_NEAR((matches[i].shape.displacement_px - truth.displacement_px).norm(), 0, 2e-3);
  }
}

TEST_F(Robustness, TheNumberOfThreadsChangesNoBit) {
  ShapeFunction map;
  map.displacement_px = {2.3, -1.6};
  map.gradient << 0.01, 0.005, -0.005, 0.02;
  const GrayImage after = speckle_.Render(kSide, kSide, map, kAbout);
  const auto centers = GridOfCenters(kRegion, 20, 12);  // some too close to the border
  std::vector<std::vector<SubsetMatch>> runs;
  for (int threads : {1, 2, 5}) {
    CorrelationOptions options = options_;
    options.threads = threads;
    const CorrelationReference reference(before_, kRegion, options);
    runs.push_back(
        CorrelatePoints(reference, centers, {after, kRegion, options}, {ShapeFunction()}));
  }
  for (const auto& run : runs) {
    for (std::size_t i = 0; i < centers.size(); ++i) {
      EXPECT_EQ(run[i].status, runs[0][i].status);
      EXPECT_EQ(run[i].iterations, runs[0][i].iterations);
      EXPECT_EQ(run[i].zncc, runs[0][i].zncc);
      EXPECT_EQ(run[i].shape.displacement_px, runs[0][i].shape.displacement_px);
      EXPECT_EQ(run[i].shape.gradient, runs[0][i].shape.gradient);
      EXPECT_EQ(run[i].covariance, runs[0][i].covariance);
    }
  }
}

TEST_F(Robustness, ThePlaceOfTheRegionsChangesNothing) {
  ShapeFunction map;
  map.displacement_px = {1.2, 0.7};
  const GrayImage after = speckle_.Render(kSide, kSide, map);
  const PixelRegion left{20, 30, 200, 200}, right{45, 40, 210, 205};
  const CorrelationReference reference(before_, left, options_);
  const SubsetMatch match = reference.Match({120, 120}, {after, right, options_}, {});
  ASSERT_TRUE(match.ok());
  EXPECT_NEAR((match.shape.displacement_px - map.displacement_px).norm(), 0, 1e-3);
}

}  // namespace
}  // namespace telestrain
