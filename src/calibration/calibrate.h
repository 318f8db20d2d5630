#pragma once

#include <string>
#include <vector>

#include "calibration/bundle_adjustment.h"

namespace telestrain {

// One step of the model choice: is the fit better with these coefficients than chance explains?
struct ModelTest {
  DistortionModel model{};
  int added_parameters = 0;
  double chi2 = 0;
  double f_statistic = 0;
  double p_value = 1;
  bool accepted = false;
};

struct ReprojectionStatistics {
  double rms_px = 0;   // over scalar coordinates, x and y counted
  double mean_px = 0;  // of the norm of the corner error
  double max_px = 0;   // of the norm
  int corners = 0;
};

// Evidence that the global mirror image of the solution is excluded (MODEL.md 3).
struct StageEvidence {
  double axis_to_nominal_deg = 0;  // estimated stage axis against [stage] axis_in_array
  double rms_travel_error_um = 0;  // of the stage moves in the solution
  double twin_chi2_ratio = 0;      // cost of the mirror image over the cost of the solution
};

struct CalibrationOptions {
  double significance = 1e-3;        // a coefficient is freed when chance is less likely than this
  double outlier_sigmas = 5;         // mrcal's rule: if anything exceeds this …
  double outlier_reject_sigmas = 4;  // … everything above this is taken out
};

struct Calibration {
  CalibrationData data;  // what was used, and what was rejected and why
  ArraySeed seed;
  BundleResult bundle;         // in the array frame that fits the nominal views best
  double sigma0 = 1;           // sqrt(chi2 / degrees of freedom); > 1 inflates the covariance
  double expected_rms_px = 0;  // from the corners' own covariances and the degrees of freedom
  std::vector<ModelTest> model_tests;
  StageEvidence stage;
  ReprojectionStatistics all;
  std::vector<ReprojectionStatistics> of_view;   // one per view
  std::vector<ReprojectionStatistics> of_board;  // one per data.boards
  int corners_rejected = 0;
};

// From labelled corners to the calibrated array: seed, outlier rejection, choice of the distortion
// model by likelihood-ratio tests, bundle adjustment with one shared lens, covariance. The array
// frame is moved rigidly to where the views fit the nominal ones best (least squares).
// Fails (kEstimationFailed) when the images do not determine the instrument.
Result<Calibration> Calibrate(const Session& session,
                              const std::vector<BoardObservation>& observations,
                              const CalibrationOptions& options = {});

}  // namespace telestrain
