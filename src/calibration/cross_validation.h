#pragma once

#include <string>
#include <vector>

#include "calibration/bundle_adjustment.h"

namespace telestrain {

// How well the calibration predicts images that it has not seen: poses (with their stage moves) are
// left out in turn, the rest is adjusted again, and only the pose of each left-out image is fitted.
struct CrossValidation {
  int folds = 0;               // 0: too few poses
  int folds_skipped = 0;       // of these: without them the rest does not determine the array
  double rms_px = 0;           // over the scalar coordinates of all left-out images
  double expected_rms_px = 0;  // from the corners' own covariances, less the fitted poses
  // sqrt of the whitened square sum over its degrees of freedom: 1 when the model and the stated
  // noise predict the unseen (0.97 with a robust loss, whose misfit ends at three sigmas), more
  // when the model follows the seen images too closely.
  double normalised_rms = 0;
  std::string worst_image;  // of the largest normalised rms
  double worst_normalised_rms = 0;
  // Largest change of the magnification when a fold is left out, in parts per million.
  double magnification_change_ppm = 0;
};

// At most `folds` groups of poses, taken in turn in the order of the table. Fails as AdjustBundle.
Result<CrossValidation> CrossValidate(const CalibrationData& data, const ArrayState& solution,
                                      const BundleOptions& options, int folds = 5);

}  // namespace telestrain
