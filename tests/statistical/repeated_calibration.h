#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "calibration/calibrate.h"
#include "measurement/ruler.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain::testing_support {

// One instrument, calibrated and used again and again with fresh chance: corner noise, stage
// travel, the true separation of the target's boards and the true length of the ruler are drawn
// anew from the distributions that the session states.
struct RepeatOptions {
  int repeats = 400;
  double noise_px = 0.1;
  double sigma_separation_um = 0.25;
  double sigma_length_um = 0.25;
};

// An error and the standard uncertainty that the program stated for it.
struct StatedError {
  double error = 0;
  double sigma = 0;
};

struct RepeatedCalibrations {
  std::map<std::string, std::vector<StatedError>> errors;  // by quantity; one per repeat
  std::vector<double> chi2_per_freedom;                    // one per repeat
  std::vector<double> rms_px;
  int richer_models = 0;  // than the truth has
  double freedom = 0;     // residuals less parameters, the same in every repeat
  double residuals = 0;
  double parameters = 0;
};

// Fails the running test when a calibration fails.
RepeatedCalibrations RepeatCalibration(const RepeatOptions& options);

}  // namespace telestrain::testing_support
