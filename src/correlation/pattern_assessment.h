#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "correlation/correlation_field.h"

namespace telestrain {

// What a speckle pattern lets one expect, from one image and its region.
struct PatternAssessment {
  double speckle_px = 0;            // full width at half maximum of the autocorrelation
  double contrast_gray = 0;         // rms, without the noise
  double noise_gray = 0;            // estimated from the image itself, before any blur
  double saturated_share = 0;       // of the pixels, at either end of the scale
  double gradient_gray_per_px = 0;  // rms of one component; SSSIG = subset area x its square
  int recommended_subset_px = 0, recommended_step_px = 0;
  double expected_sigma_px = 0;           // of u with the recommended subset
  double expected_sigma_microstrain = 0;  // of a strain over the recommended window
  std::vector<std::string> advice;        // plain sentences; empty when nothing is to be improved
};

// Assesses the region (and mask) of `options` with its prefilter and strain window. The subset is
// the smallest one that reaches `target_sigma_px` and holds three speckles across. Fails
// (kBadInput) when the region lies outside the image or holds fewer than 64 x 64 px.
Result<PatternAssessment> AssessPattern(const GrayImage& image, const FieldOptions& options,
                                        double target_sigma_px = 0.01);

}  // namespace telestrain
