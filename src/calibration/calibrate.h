#pragma once

#include <string>
#include <vector>

#include "calibration/cross_validation.h"
#include "calibration/model_choice.h"
#include "calibration/outlier_rejection.h"
#include "calibration/stage_evidence.h"

namespace telestrain {

struct ReprojectionStatistics {
  double rms_px = 0;   // over scalar coordinates, x and y counted
  double mean_px = 0;  // of the norm of the corner error
  double max_px = 0;   // of the norm
  int corners = 0;
};

struct CalibrationOptions {
  ModelChoiceOptions model_choice;
  OutlierOptions outliers;
  // Weighs every corner down by its own misfit (Cauchy's loss of three sigmas) and removes none:
  // for corners whose errors have long tails rather than a few mistakes.
  bool robust = false;
  // Estimates the boards' bows whether a test asks for it or not (mrcal's board warp).
  bool board_warp = false;
  // Corners in these parts of the sensor are left out.
  std::vector<PixelRegion> culled;
  // The corners came without covariances, so the residuals alone tell the noise.
  bool noise_is_assumed = false;
};

struct Calibration {
  CalibrationOptions options;
  CalibrationData data;  // what was used, and what was rejected and why
  ArraySeed seed;
  BundleOptions bundle_options;  // that the choice of the model led to
  BundleResult bundle;           // in the array frame that fits the nominal views best
  double sigma0 = 1;             // sqrt(chi2 / degrees of freedom); > 1 inflates the noise
  double expected_rms_px = 0;    // from the corners' own covariances and the degrees of freedom
  std::vector<ModelTest> model_tests;
  CrossValidation cross_validation;
  StageEvidence stage;
  ReprojectionStatistics all;
  std::vector<ReprojectionStatistics> of_view;   // one per view
  std::vector<ReprojectionStatistics> of_board;  // one per data.boards
  int corners_rejected = 0;
  int corners_below_half_weight = 0;  // with the robust option: beyond three standard deviations
};

// From labelled corners to the calibrated array: seed, outlier rejection, choice of the model by
// likelihood-ratio tests, bundle adjustment, covariance, cross-validation. The array frame is moved
// rigidly to where the views fit the nominal ones best (least squares). Images that repeat another
// one's corners are left out. Fails (kEstimationFailed) when the images do not determine the
// instrument, with the cause in words.
Result<Calibration> Calibrate(const Session& session,
                              const std::vector<BoardObservation>& observations,
                              const CalibrationOptions& options = {});

}  // namespace telestrain
