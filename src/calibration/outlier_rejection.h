#pragma once

#include "calibration/bundle_adjustment.h"

namespace telestrain {

// mrcal's rule: if any whitened coordinate exceeds the first limit, every corner beyond the second
// is taken out. What a sigma is:
enum class OutlierScale {
  kMedian,  // 1.4826 times the median; a corner within 0.1 px of the model is no mistake, a board
            // that is worse as a whole has its own sigma or goes (MODEL.md 5)
  kMrcal,   // the sample standard deviation, as mrcal has it: outliers inflate it
};
struct OutlierOptions {
  OutlierScale scale = OutlierScale::kMedian;
  double sigmas = 5;
  double reject_sigmas = 4;
};

// Robust standard deviation of the whitened residuals: 1.4826 times the median of their sizes. 1
// when the corners have the noise that they state.
double RobustSigma(const CalibrationData& data, const ArrayState& state);

// Removes outliers of a solution from the data and lists them in CalibrationData::rejected; a board
// that loses more than a quarter of its corners goes whole. Returns how many corners were removed.
int RemoveOutliers(const Session& session, const ArrayState& state, const OutlierOptions& options,
                   CalibrationData& data);

}  // namespace telestrain
