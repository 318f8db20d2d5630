#include "correlation/pattern_assessment.h"

#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "correlation/noise_estimate.h"
#include "correlation/pattern_statistics.h"
#include "correlation/strain_field.h"

namespace telestrain {

using namespace correlation;

namespace {

constexpr int kSmallestSide_px = 64;
constexpr double kSpecklesAcross = 3;  // of a subset
constexpr int kSmallestSubset_px = 11, kLargestSubset_px = 601;
// Below 3 px a speckle is sampled too coarsely for its interpolation; beyond 9 px it wastes
// resolution (Good Practices Guide of iDICs: 3 to 5 px).
constexpr double kFine_px = 3, kCoarse_px = 9;
constexpr double kLowContrast = 0.05;  // of the full scale, rms
constexpr double kSaturated = 0.01;    // share of the pixels
constexpr double kSmallestSignal = 3;  // contrast over noise

double ExpectedSigma_px(const PatternStatistics& pattern, int subset_px, int shape_order) {
  const double at_one_px = std::sqrt(2 * pattern.noise_gain) * pattern.noise_gray;
  return at_one_px * std::sqrt(OrderVariance(shape_order)) / subset_px;
}

int RecommendedSubset(const PatternStatistics& pattern, int shape_order, double target_px) {
  const double for_noise = ExpectedSigma_px(pattern, 1, shape_order) / target_px;
  const double wanted = std::ceil(std::max(for_noise, kSpecklesAcross * pattern.speckle_px));
  if (!(wanted < kLargestSubset_px)) return kLargestSubset_px;
  const int side = std::max(static_cast<int>(wanted), kSmallestSubset_px);
  return side + (side % 2 == 0);
}

std::vector<std::string> Advice(const PatternAssessment& found, double max_gray, double target_px) {
  std::vector<std::string> advice;
  const std::string speckle = FormatFixed(found.speckle_px, 1) + " px";
  if (found.speckle_px > 0 && found.speckle_px < kFine_px)
    advice.push_back("The speckles are too fine (" + speckle +
                     "): make them at least 3 px, or blur more before the correlation.");
  if (found.speckle_px > kCoarse_px)
    advice.push_back("The speckles are too coarse (" + speckle +
                     "): 3 to 5 px let a smaller subset reach the same noise.");
  if (found.contrast_gray < kLowContrast * max_gray ||
      found.contrast_gray < kSmallestSignal * found.noise_gray)
    advice.push_back("The contrast is low (" + FormatFixed(found.contrast_gray, 1) +
                     " grey levels rms): use more light, a longer exposure or a stronger paint.");
  if (found.saturated_share > kSaturated)
    advice.push_back(FormatFixed(100 * found.saturated_share, 1) +
                     " % of the pixels are saturated: use less light or avoid reflections.");
  if (found.expected_sigma_px > target_px)
    advice.push_back("Even the largest subset leaves a noise of " +
                     FormatFixed(found.expected_sigma_px, 4) +
                     " px: the pattern has too little gradient for its noise.");
  return advice;
}

}  // namespace

Result<PatternAssessment> AssessPattern(const GrayImage& image, const FieldOptions& options,
                                        double target_sigma_px) {
  const PixelRegion region = options.region.value_or(PixelRegion{0, 0, image.width, image.height});
  if (region.x < 0 || region.y < 0 || region.x + region.width > image.width ||
      region.y + region.height > image.height ||
      std::min(region.width, region.height) < kSmallestSide_px)
    return BadInput("the region to assess must lie in the image and measure at least 64 x 64 px");
  if (options.mask && (options.mask->width != image.width || options.mask->height != image.height))
    return BadInput("the mask must have the size of the image");
  if (!(target_sigma_px > 0)) return BadInput("the wanted noise must be more than 0 px");
  const PatternStatistics pattern =
      MeasurePattern(image, region, options.mask ? &*options.mask : nullptr,
                     options.correlation.prefilter_sigma_px);
  if (!(pattern.contrast_gray > 0) || !(pattern.gradient_gray_per_px > 0))
    return BadInput(
        "the region has no pattern (all pixels that count have one grey level); is it the right "
        "image, and neither black nor saturated?");
  const int order = options.correlation.shape_order;
  PatternAssessment found;
  found.speckle_px = pattern.speckle_px;
  found.contrast_gray = pattern.contrast_gray;
  found.noise_gray = pattern.noise_gray;
  found.saturated_share = pattern.saturated_share;
  found.gradient_gray_per_px = pattern.gradient_gray_per_px;
  found.recommended_subset_px = RecommendedSubset(pattern, order, target_sigma_px);
  found.recommended_step_px = std::max(1, found.recommended_subset_px / 4);
  found.expected_sigma_px = ExpectedSigma_px(pattern, found.recommended_subset_px, order);
  const Eigen::Matrix2d slopes =
      PlaneSlopeCovariance(options.strain_window_points, found.recommended_step_px,
                           SubsetOverlap(found.recommended_subset_px, order));
  found.expected_sigma_microstrain = 1e6 * found.expected_sigma_px * std::sqrt(slopes(0, 0));
  found.advice = Advice(found, image.max_gray, target_sigma_px);
  return found;
}

}  // namespace telestrain
