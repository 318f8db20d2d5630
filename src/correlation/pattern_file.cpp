#include "correlation/pattern_file.h"

#include <nlohmann/json.hpp>

#include "base/numbers.h"

namespace telestrain {
namespace {

// Noise in px with the digits that the quietest subsets need.
constexpr int kPixelDecimals = 5;

// Sum of the squared gradient over the subset of that side.
double Sssig(const PatternAssessment& pattern, int subset_px) {
  return static_cast<double>(subset_px) * subset_px * pattern.gradient_gray_per_px *
         pattern.gradient_gray_per_px;
}

}  // namespace

std::vector<std::string> PatternLines(const PatternAssessment& pattern, int subset_px,
                                      int step_px) {
  std::vector<std::string> lines;
  lines.push_back("speckles " + FormatFixed(pattern.speckle_px, 2) + " px wide, contrast " +
                  FormatFixed(pattern.contrast_gray, 2) + " grey levels rms, noise " +
                  FormatFixed(pattern.noise_gray, 2) + ", saturated " +
                  FormatFixed(100 * pattern.saturated_share, 2) + " %");
  lines.push_back("gradient " + FormatFixed(pattern.gradient_gray_per_px, 3) +
                  " grey levels per px rms, SSSIG of a subset of " + std::to_string(subset_px) +
                  " px " + FormatFixed(Sssig(pattern, subset_px), 0));
  lines.push_back("recommended subset " + std::to_string(pattern.recommended_subset_px) +
                  " px, step " + std::to_string(pattern.recommended_step_px) +
                  " px: expected noise " + FormatFixed(pattern.expected_sigma_px, kPixelDecimals) +
                  " px in u and v, " + FormatFixed(pattern.expected_sigma_microstrain, 1) +
                  " microstrain");
  if (subset_px != pattern.recommended_subset_px || step_px != pattern.recommended_step_px)
    lines.push_back("used are subset " + std::to_string(subset_px) + " px, step " +
                    std::to_string(step_px) + " px");
  for (const std::string& advice : pattern.advice) lines.push_back("advice: " + advice);
  return lines;
}

nlohmann::ordered_json PatternJson(const PatternAssessment& pattern) {
  return {{"speckle_px", pattern.speckle_px},
          {"contrast_gray", pattern.contrast_gray},
          {"noise_gray", pattern.noise_gray},
          {"saturated_share", pattern.saturated_share},
          {"gradient_gray_per_px", pattern.gradient_gray_per_px},
          {"recommended_subset_px", pattern.recommended_subset_px},
          {"recommended_step_px", pattern.recommended_step_px},
          {"sssig_of_recommended_subset", Sssig(pattern, pattern.recommended_subset_px)},
          {"expected_sigma_px", pattern.expected_sigma_px},
          {"expected_sigma_microstrain", pattern.expected_sigma_microstrain},
          {"advice", pattern.advice}};
}

}  // namespace telestrain
