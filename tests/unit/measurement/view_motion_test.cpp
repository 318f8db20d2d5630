#include "measurement/view_motion.h"

#include <gtest/gtest.h>

#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kWidth = 520, kHeight = 400;
const PixelRegion kRegion{0, 0, kWidth, kHeight};

struct Pattern {
  CorrelationOptions options;
  Speckle speckle{3, kWidth, kHeight, 2.0};
  GrayImage reference = speckle.Render(kWidth, kHeight);
  std::vector<Eigen::Vector2i> centers = GridOfCenters(kRegion, 28, 30);

  Pattern() { options.subset_px = 31; }

  FoundMotion Find(const GrayImage& image, const ViewMotion& predicted) const {
    const CorrelationReference prepared_reference(reference, kRegion, options);
    const PreparedImage prepared(image, kRegion, options);
    return FindMotion({prepared_reference, prepared, reference, image}, centers, predicted);
  }
  GrayImage Moved(const ViewMotion& motion) const {
    return speckle.Render(kWidth, kHeight, {motion.shift_px, motion.gradient}, kRegion.Middle());
  }
};

// 16 seeds fix the shift to better than a hundredth of a pixel.
void ExpectMotion(const ViewMotion& found, const ViewMotion& wanted) {
  EXPECT_LT((found.shift_px - wanted.shift_px).norm(), 0.01);
  EXPECT_LT((found.gradient - wanted.gradient).norm() * kWidth / 2, 0.05);
}

ViewMotion Turned(double x_px, double y_px, double angle_rad) {
  ViewMotion motion;
  motion.shift_px = {x_px, y_px};
  motion.gradient << 0, -angle_rad, angle_rad, 0;
  return motion;
}

TEST(ViewMotion, ASmallMoveNeedsNoSearch) {
  const Pattern pattern;
  for (const ViewMotion& motion : {Turned(0.3, -0.7, 0), Turned(-1.4, 2.1, 0.0035)}) {
    const FoundMotion found = pattern.Find(pattern.Moved(motion), {});
    EXPECT_TRUE(found.sure);
    EXPECT_FALSE(found.by_search);
    ExpectMotion(found.motion, motion);
  }
}

TEST(ViewMotion, AFarMoveIsSearchedForAndThenPredicted) {
  const Pattern pattern;
  const ViewMotion motion = Turned(33.4, -18.8, 0.003);
  const GrayImage image = pattern.Moved(motion);
  const FoundMotion found = pattern.Find(image, {});
  EXPECT_TRUE(found.sure);
  EXPECT_TRUE(found.by_search);
  ExpectMotion(found.motion, motion);
  EXPECT_FALSE(pattern.Find(image, found.motion).by_search);
}

TEST(ViewMotion, AnotherPatternIsNotFound) {
  const Pattern pattern;
  const GrayImage other = Speckle(4, kWidth, kHeight, 2.0).Render(kWidth, kHeight);
  const ViewMotion predicted = Turned(5, 6, 0);
  const FoundMotion found = pattern.Find(other, predicted);
  EXPECT_FALSE(found.sure);
  EXPECT_TRUE(found.motion == predicted);
}

TEST(ViewMotion, AFalseMatchDoesNotDrawTheMotion) {
  std::vector<Eigen::Vector2i> centers = GridOfCenters(kRegion, 50, 50);
  std::vector<SubsetMatch> matches(centers.size());
  const ViewMotion motion = Turned(4, -3, 0.002);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    matches[i].status = i % 7 == 3 ? MatchStatus::kLowCorrelation : MatchStatus::kConverged;
    matches[i].shape.displacement_px =
        i % 5 == 2 ? Eigen::Vector2d(40, 40)
                   : motion.At(centers[i].cast<double>() - kRegion.Middle());
  }
  const ViewMotion fitted = FitMotion(kRegion, centers, matches, Turned(4.5, -3, 0.002));
  EXPECT_LT((fitted.shift_px - motion.shift_px).norm(), 1e-9);
  EXPECT_LT((fitted.gradient - motion.gradient).norm(), 1e-11);
}

}  // namespace
}  // namespace telestrain
