#include <gtest/gtest.h>

#include <iostream>

#include "random_view.h"
#include "target/target_detector.h"

namespace telestrain {
namespace {

using testing::RandomView;
using testing::ViewLimits;

RandomView CrossView(const ViewLimits& limits, std::uint32_t seed) {
  RandomView view = testing::MakeRandomView(limits, seed);
  view.scene.columns = view.scene.rows = 1;
  view.search.columns = view.search.rows = 1;
  view.search.square_mm = 0;
  view.scene.origin_px = limits.region.Middle() + Eigen::Vector2d(0.3 * (seed % 7), 11.7);
  return view;
}

void RunMany(const char* what, const ViewLimits& limits, int count) {
  double squares = 0, normalised = 0;
  for (int i = 0; i < count; ++i) {
    const auto seed = static_cast<std::uint32_t>(500 + i);
    RandomView view = CrossView(limits, seed);
    if (i % 2 == 0) view.scene.plate_gray = view.scene.bright_gray;
    if (i % 4 == 1) view.scene.plate_gray = view.scene.dark_gray;
    const auto cross = DetectCross(testing::Render(view, seed), view.search);
    ASSERT_TRUE(cross.center.has_value())
        << what << " seed " << seed << ": " << cross.rejected_because;
    const Eigen::Vector2d error = cross.center->pixel - view.scene.Corner(0, 0);
    EXPECT_LT(error.norm(), 0.15) << what << " seed " << seed;
    squares += error.squaredNorm();
    normalised += error.dot(cross.center->covariance_px2.inverse() * error) / 2;
  }
  std::cout << what << ": rms " << std::sqrt(squares / count) << " px, normalised "
            << normalised / count << "\n";
  EXPECT_NEAR(normalised / count, 1, 4 / std::sqrt(count));  // 4 sigma of the mean
}

TEST(DetectCross, FindsCrossesOfAnySize) {
  ViewLimits limits;
  limits.region = {20, 10, 600, 450};
  for (const double side : {30.0, 68.0, 150.0}) {
    limits.side_px = side;
    limits.largest_blur_px = 2;
    RunMany("cross", limits, 40);
  }
}

TEST(DetectCross, FindsTheSmallCrossOfABinnedSensor) {
  ViewLimits limits;
  limits.region = {0, 243, 324, 243};
  limits.side_px = 16;
  limits.least_blur_px = 0.5;
  limits.largest_blur_px = 1;
  RunMany("binned cross", limits, 40);
}

TEST(DetectCross, RejectsAViewWithoutACross) {
  const RandomView view = CrossView({.region = {0, 0, 324, 243}}, 3);
  for (const double noise : {0.0, 1.5, 5.0}) {
    GrayImage image = testing::Blank(330, 250, 120);
    for (int y = 60; y < 180; ++y)
      for (int x = 90; x < 250; ++x) image.At(x, y) = 200;  // a plate
    testing::AddNoise(&image, noise, 3);
    const auto cross = DetectCross(image, view.search);
    EXPECT_FALSE(cross.center.has_value());
    EXPECT_FALSE(cross.rejected_because.empty());
  }
}

TEST(DetectCross, RejectsSpeckle) {
  const RandomView view = CrossView({.region = {0, 0, 324, 243}}, 3);
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    testing::Uniform uniform(seed);
    GrayImage image = testing::Blank(324, 243, 200);
    for (int spot = 0; spot < 1500; ++spot) {
      const double x = uniform(4, 319), y = uniform(4, 238), radius = uniform(1.5, 3.5);
      const auto gray = static_cast<float>(uniform(20, 120));
      for (int v = static_cast<int>(y - radius); v <= y + radius; ++v)
        for (int u = static_cast<int>(x - radius); u <= x + radius; ++u)
          if (std::hypot(u - x, v - y) < radius) image.At(u, v) = gray;
    }
    testing::AddNoise(&image, 1.5, seed);
    EXPECT_FALSE(DetectCross(image, view.search).center.has_value()) << seed;
  }
}

TEST(DetectCross, RejectsTwoLikeCrosses) {
  const ViewLimits limits{.side_px = 30, .region = {0, 0, 600, 450}};
  RandomView view = CrossView(limits, 3);
  GrayImage image = testing::Blank(600, 450, 120);
  view.scene.origin_px.x() = 150;
  testing::DrawBoard(view.scene, {0, 0, 300, 450}, &image);
  view.scene.origin_px.x() = 450;
  testing::DrawBoard(view.scene, {300, 0, 300, 450}, &image);
  testing::AddNoise(&image, 1, 5);
  const auto cross = DetectCross(image, view.search);
  EXPECT_NE(cross.rejected_because.find("ambiguous"), std::string::npos) << cross.rejected_because;
}

}  // namespace
}  // namespace telestrain
