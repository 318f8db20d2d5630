// Sequences: starts from the state before, replacement of the reference, points lost and found.
#include "correlation/field_tracker.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kSide = 320;
const Eigen::Vector2d kAbout(159.5, 159.5);

FieldOptions Options() {
  FieldOptions options;
  options.correlation.subset_px = 33;
  options.step_px = 12;
  options.region = PixelRegion{80, 80, 160, 160};
  return options;
}

FieldTracker StartOn(const GrayImage& reference, const FieldOptions& options) {
  auto tracker = FieldTracker::Start(reference, options);
  EXPECT_TRUE(tracker.ok()) << (tracker.ok() ? "" : tracker.error().message);
  return std::move(*tracker);
}

ShapeFunction Turn(double angle_deg) {
  const double c = std::cos(angle_deg * M_PI / 180), s = std::sin(angle_deg * M_PI / 180);
  ShapeFunction map;
  map.gradient << c - 1, -s, s, c - 1;
  return map;
}

ShapeFunction Stretch(double by) {
  ShapeFunction map;
  map.gradient << by, 0, 0, -0.3 * by;
  return map;
}

// A pattern that changes: with `share` of another one that moves along.
GrayImage Mixed(const Speckle& one, const Speckle& two, double share, const ShapeFunction& map) {
  GrayImage image = one.Render(kSide, kSide, map, kAbout);
  const GrayImage other = two.Render(kSide, kSide, map, kAbout);
  for (std::size_t k = 0; k < image.pixels.size(); ++k)
    image.pixels[k] += static_cast<float>(share) * (other.pixels[k] - image.pixels[k]);
  return image;
}

class Tracker : public testing::Test {
 protected:
  const Speckle speckle_{61, kSide, kSide, 1.8}, other_{62, kSide, kSide, 1.8};

  // Ten images; the pattern turns into another one meanwhile.
  template <class Map>
  CorrelationField TrackTo(const Map& map, double change, const FieldOptions& options) const {
    FieldTracker tracker = StartOn(Mixed(speckle_, other_, 0, {}), options);
    CorrelationField field;
    for (int k = 1; k <= 10; ++k)
      field = tracker.Track(Mixed(speckle_, other_, change * k / 10, map(k / 10.0)));
    return field;
  }

  // Largest error of displacement (px) and gradient; every point must be there.
  static Eigen::Vector2d Errors(const CorrelationField& field, const ShapeFunction& map) {
    Eigen::Vector2d worst = Eigen::Vector2d::Zero();
    for (const FieldPoint& point : field.points) {
      EXPECT_TRUE(point.match.ok()) << point.center_px.transpose();
      const ShapeFunction truth = TruthAt(map, kAbout, point.center_px);
      const double u = (point.match.shape.displacement_px - truth.displacement_px).norm();
      const double g = (point.match.shape.gradient - truth.gradient).norm();
      worst = worst.cwiseMax(Eigen::Vector2d(u, g));
    }
    return worst;
  }
};

// Without noise; what is left is the interpolation, 1 mpx a link.
TEST_F(Tracker, FollowsLargeRotationAndStretchOnOneReference) {
  const auto turn = [](double share) { return Turn(20 * share); };
  const auto stretch = [](double share) { return Stretch(0.3 * share); };
  const CorrelationField turned = TrackTo(turn, 0, Options());
  EXPECT_EQ(turned.reference_updates, 0);
  EXPECT_LT(Errors(turned, turn(1))[0], 3e-3);
  const CorrelationField stretched = TrackTo(stretch, 0, Options());
  EXPECT_EQ(stretched.reference_updates, 0);
  EXPECT_LT(Errors(stretched, stretch(1))[0], 1e-2);  // a pixel becomes 1.3: a coarser image
  const FieldPoint& middle = stretched.points[stretched.points.size() / 2];
  EXPECT_NEAR(middle.strain(0, 0), 0.3 + 0.045, 1e-4);
  EXPECT_NEAR(middle.strain(1, 1), -0.09 + 0.00405, 1e-4);
}

// The last image shows nothing of the first pattern. The mixing is no displacement, but the other
// pattern pulls at the match. The covariance takes this misfit for white noise, while its values
// are correlated over an area of 4 pi s^2 = 41 px for spots of s = 1.8 px: its standard deviation
// is larger by the root of it. 4.4 is the 99.99 % point of two normal errors.
TEST_F(Tracker, ReplacesTheReferenceWhenThePatternChanges) {
  for (const bool turning : {true, false}) {
    const auto map = [&](double share) {
      return turning ? Turn(20 * share) : Stretch(0.3 * share);
    };
    const CorrelationField field = TrackTo(map, 1, Options());
    EXPECT_GE(field.reference_updates, 1);
    EXPECT_LE(field.reference_updates, 9);
    double worst = 0;
    for (const FieldPoint& point : field.points) {
      ASSERT_TRUE(point.match.ok()) << point.center_px.transpose();
      const Eigen::Vector2d error = point.match.shape.displacement_px -
                                    TruthAt(map(1), kAbout, point.center_px).displacement_px;
      const Eigen::Matrix2d covariance = point.match.covariance.topLeftCorner<2, 2>();
      worst = std::max(worst, std::sqrt(error.dot(covariance.inverse() * error)));
    }
    EXPECT_LT(worst, 4.4 * std::sqrt(4 * M_PI) * 1.8) << turning;
  }
}

// Sums over images with a reference replaced: 25 points that do not overlap x 20 runs, u and v,
// know the standard deviation to 2.2 %: four of these. The noise that the interpolation smooths
// makes the prediction low by a further 3 % (SubsetMatch::sigma_gray).
TEST_F(Tracker, ComposedUncertaintyIsHonest) {
  FieldOptions options = Options();
  options.step_px = 36;
  options.update_below_zncc = 0.9999;
  std::vector<GrayImage> clean;
  for (int k = 0; k < 4; ++k) {
    ShapeFunction map = Turn(1.5 * k);
    map.displacement_px = {0.37 * k, -0.21 * k};
    clean.push_back(Mixed(speckle_, other_, 0.03 * k, map));
  }
  constexpr int kRuns = 20;
  std::mt19937 random(3);
  std::vector<std::vector<Eigen::Vector2d>> found;
  double predicted = 0, count = 0;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<GrayImage> noisy = clean;
    for (GrayImage& image : noisy) AddNoise(6, random, image);
    FieldTracker tracker = StartOn(noisy[0], options);
    CorrelationField field;
    for (int k = 1; k < 4; ++k) field = tracker.Track(noisy[k]);
    EXPECT_GE(field.reference_updates, 1);
    found.emplace_back();
    for (const FieldPoint& point : field.points) {
      ASSERT_TRUE(point.match.ok());
      found.back().push_back(point.match.shape.displacement_px);
      predicted += point.match.covariance.topLeftCorner<2, 2>().trace();
      ++count;
    }
  }
  double observed = 0;
  for (std::size_t i = 0; i < found[0].size(); ++i) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& run : found) mean += run[i] / kRuns;
    for (const auto& run : found) observed += (run[i] - mean).squaredNorm();
  }
  observed *= kRuns / (kRuns - 1.0);
  EXPECT_NEAR(std::sqrt(predicted / observed), 1, 4 * 0.022 + 0.03) << count;
}

// Covered in one image, there again in the next, also when the reference is replaced meanwhile.
TEST_F(Tracker, CoveredPointsComeBack) {
  for (const double change : {0.0, 0.9}) {
    FieldTracker tracker = StartOn(Mixed(speckle_, other_, 0, {}), Options());
    CorrelationField field;
    int covered = 0;
    for (int k = 1; k <= 6; ++k) {
      ShapeFunction map;
      map.displacement_px = {1.3 * k, 0.8 * k};
      GrayImage image = Mixed(speckle_, other_, change * k / 6, map);
      if (k == 3)
        for (int y = 150; y < 200; ++y)
          for (int x = 150; x < 200; ++x) image.At(x, y) = 5;
      field = tracker.Track(image);
      if (k != 3) continue;
      for (const FieldPoint& point : field.points) covered += !point.match.ok();
    }
    EXPECT_GE(covered, 4);
    for (const FieldPoint& point : field.points)
      EXPECT_TRUE(point.match.ok()) << change << ": " << point.center_px.transpose();
  }
}

// Eighty pixels between two images: the search begins anew.
TEST_F(Tracker, AJumpIsSearched) {
  FieldTracker tracker = StartOn(speckle_.Render(kSide, kSide), Options());
  for (const double jump : {0.0, 60.0, -60.0}) {
    ShapeFunction map;
    map.displacement_px = {jump, 0.5 * jump};
    const CorrelationField field = tracker.Track(speckle_.Render(kSide, kSide, map, kAbout));
    EXPECT_LT(Errors(field, map)[0], 2e-3);
  }
}

TEST_F(Tracker, UnusableOptionsAreExplained) {
  const GrayImage image = speckle_.Render(kSide, kSide);
  FieldOptions options = Options();
  options.correlation.subset_px = 32;
  EXPECT_EQ(FieldTracker::Start(image, options).error().kind, ErrorKind::kBadInput);
  options = Options();
  options.region = PixelRegion{400, 400, 20, 20};
  EXPECT_EQ(FieldTracker::Start(image, options).error().kind, ErrorKind::kBadInput);
  options = Options();
  options.mask = PixelMask{10, 10, std::vector<unsigned char>(100, 1)};
  EXPECT_EQ(FieldTracker::Start(image, options).error().kind, ErrorKind::kBadInput);
  options = Options();
  options.strain_window_points = 4;
  EXPECT_EQ(FieldTracker::Start(image, options).error().kind, ErrorKind::kBadInput);
}

}  // namespace
}  // namespace telestrain
