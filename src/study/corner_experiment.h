#pragma once

#include <string>
#include <vector>

#include "calibration/calibrate.h"
#include "measurement/ruler.h"
#include "simulation/corner_observations.h"
#include "study/statistics.h"

namespace telestrain {

// A virtual experiment on corners, without images: thousands of them in seconds.
struct CornerExperiment {
  VirtualExperimentOptions instrument;  // lens, view errors, aperture, telecentricity, seed
  double noise_px = 0.1;                // of a corner coordinate in focus
  int poses = 18;                       // of the target; two images each, one travel apart
  // Half ranges of the target's place about the middle of the measurement volume, and of its
  // rotation about the pipe's axis.
  double range_share = 1.0;  // of the half ranges kTargetRange_mm
  double tilt_deg = 8.0;
  // Boards that one view sees only in part: their visible corners are used, or the pose is not
  // taken at all.
  bool use_cut_off_boards = true;
  int rulers = 100;
  // Calibrates with the paper's lens model: distortion, but no residual telecentricity and no bow.
  bool distortion_only = false;
};

// What it gave. Errors are in the order of the ruler images.
struct CornerOutcome {
  Calibration calibration;
  std::vector<double> ruler_error_um;
  // Of the ruler's middle in the measurement volume along a line through its centre: -1 and 1 at
  // the ends, where a cross leaves a view or the depth of field.
  std::vector<double> ruler_position;
  // The same crosses without noise: what the calibration alone is wrong by.
  std::vector<double> ruler_systematic_um;
  std::vector<double> ruler_calibration_part_um;  // its standard uncertainty as stated
  std::vector<double> corner_error_px;            // norm of every used corner's reprojection error
};

// Invents the poses, observes, calibrates and measures the rulers. Positions of the target are
// uniform in the measurement volume; those of the ruler lie on random lines through its centre,
// evenly from end to end. Fails like Calibrate.
Result<CornerOutcome> RunCornerExperiment(const CornerExperiment& experiment);

}  // namespace telestrain
