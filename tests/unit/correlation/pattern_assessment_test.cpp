#include "correlation/pattern_assessment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "correlation/noise_estimate.h"
#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kSide = 500;
const PixelRegion kRegion{0, 0, kSide, kSide};

GrayImage NoisySpeckle(double spot_px, double sigma_gray, unsigned seed) {
  GrayImage image = Speckle(seed, kSide, kSide, spot_px).Render(kSide, kSide);
  std::mt19937 random(seed);
  AddNoise(sigma_gray, random, image);
  return image;
}

// The bar of the project: 15 %, on fine and coarse speckle.
TEST(PatternAssessment, NoiseIsEstimatedFromTheImageItself) {
  for (const double spot_px : {1.3, 1.6, 2.5})
    for (const double sigma : {0.5, 1.0, 2.0})
      EXPECT_NEAR(
          correlation::EstimateNoise_gray(NoisySpeckle(spot_px, sigma, 71), kRegion) / sigma, 1,
          0.15)
          << spot_px << " " << sigma;
}

TEST(PatternAssessment, NoiseOfAFlatImageIsItsDeviation) {
  GrayImage flat{kSide, kSide, 255, std::vector<float>(kSide * kSide, 100.f)};
  std::mt19937 random(1);
  AddNoise(1.5, random, flat);
  // 225 tiles of 1024 pixels with 170 independent fourth differences or more each: below 1 %.
  EXPECT_NEAR(correlation::EstimateNoise_gray(flat, kRegion), 1.5, 0.05);
}

// Round Gaussian spots of radius s have an autocorrelation of radius sqrt(2) s, full width
// 2.355 sqrt(2) s. An image holds some 2000 of the spots: 5 %.
TEST(PatternAssessment, SpeckleSizeIsTheWidthOfTheAutocorrelation) {
  for (const double spot_px : {1.6, 2.5}) {
    const auto found = AssessPattern(NoisySpeckle(spot_px, 2, 72), {});
    ASSERT_TRUE(found.ok());
    const double expected = 2.3548 * std::sqrt(2) * spot_px;
    EXPECT_NEAR(found->speckle_px, expected, 0.05 * expected);
  }
}

// The scatter of a field of subsets that do not overlap: some 300 of them know it to 4 %, the
// pattern's gradient differs between them; 20 % is the bar of the project.
TEST(PatternAssessment, PredictedNoiseIsTheMeasuredScatter) {
  constexpr double kSigma_gray = 2;
  GrayImage before = Speckle(73, kSide, kSide).Render(kSide, kSide), after = before;
  std::mt19937 random(5);
  AddNoise(kSigma_gray, random, before);
  AddNoise(kSigma_gray, random, after);
  FieldOptions options;
  const auto found = AssessPattern(before, options);
  ASSERT_TRUE(found.ok());
  EXPECT_LE(found->expected_sigma_px, 0.01);
  EXPECT_GE(found->recommended_subset_px, 3 * found->speckle_px);
  EXPECT_EQ(found->recommended_subset_px % 2, 1);
  options.correlation.subset_px = options.step_px = found->recommended_subset_px;
  const CorrelationReference reference(before, kRegion, options.correlation);
  double sum = 0, count = 0;
  for (const FieldPoint& point : Correlate(reference, after, options).points) {
    ASSERT_TRUE(point.match.ok());
    sum += point.match.shape.displacement_px.squaredNorm();
    count += 2;
  }
  EXPECT_GT(count, 300);
  EXPECT_NEAR(found->expected_sigma_px / std::sqrt(sum / count), 1, 0.2);
}

// sqrt(1.44 x 4 spots a cell of 64 s^2 ...) is not needed: the same noise on twice the contrast
// needs half the subset.
TEST(PatternAssessment, MoreContrastNeedsASmallerSubset) {
  const GrayImage weak = NoisySpeckle(1.6, 0, 74);
  GrayImage strong = weak;
  for (float& value : strong.pixels) value = 128 + 2 * (value - 128);
  std::mt19937 random(6);
  GrayImage noise{kSide, kSide, 255, std::vector<float>(kSide * kSide, 0.f)};
  AddNoise(4, random, noise);
  GrayImage noisy_weak = weak, noisy_strong = strong;
  for (std::size_t k = 0; k < noise.pixels.size(); ++k) {
    noisy_weak.pixels[k] += noise.pixels[k];
    noisy_strong.pixels[k] += noise.pixels[k];
  }
  for (GrayImage* image : {&noisy_weak, &noisy_strong}) image->max_gray = 1000;
  const auto one = AssessPattern(noisy_weak, {}, 0.005);
  const auto two = AssessPattern(noisy_strong, {}, 0.005);
  ASSERT_TRUE(one.ok() && two.ok());
  EXPECT_NEAR(two->contrast_gray / one->contrast_gray, 2, 0.02);
  EXPECT_NEAR(two->gradient_gray_per_px / one->gradient_gray_per_px, 2, 0.02);
  EXPECT_NEAR(one->recommended_subset_px / 2.0, two->recommended_subset_px, 2.5);
}

bool Advises(const GrayImage& image, const char* what) {
  const auto found = AssessPattern(image, {});
  EXPECT_TRUE(found.ok());
  for (const std::string& sentence : found->advice)
    if (sentence.find(what) != std::string::npos) return true;
  return false;
}

TEST(PatternAssessment, AdviceNamesWhatIsWrong) {
  const GrayImage good = NoisySpeckle(1.6, 1, 75);
  EXPECT_TRUE(AssessPattern(good, {})->advice.empty());
  EXPECT_TRUE(Advises(NoisySpeckle(0.7, 1, 76), "too fine"));
  EXPECT_TRUE(Advises(NoisySpeckle(4, 1, 77), "too coarse"));
  GrayImage pale = good, bright = good;
  for (float& value : pale.pixels) value = 128 + 0.1f * (value - 128);
  EXPECT_TRUE(Advises(pale, "contrast is low"));
  for (float& value : bright.pixels) value = std::min(255.f, value + 90);
  EXPECT_TRUE(Advises(bright, "saturated"));
}

TEST(PatternAssessment, UnusableRegionsAreExplained) {
  FieldOptions options;
  options.region = PixelRegion{0, 0, 50, 50};
  EXPECT_EQ(AssessPattern(NoisySpeckle(1.6, 1, 78), options).error().kind, ErrorKind::kBadInput);
}

}  // namespace
}  // namespace telestrain
