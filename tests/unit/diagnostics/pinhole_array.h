#pragma once

#include <vector>

#include "diagnostics/pinhole_calibration.h"
#include "diagnostics/pinhole_ruler.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain::testing_support {

// A synthetic array as the pinhole arm gets it: labelled corners and their telecentric solution.
struct PinholeCase {
  SyntheticArray array;
  CalibrationData data;
  ArrayState telecentric;
  double telecentric_rms_px = 0;

  PinholeCalibration MustCalibrate(const PinholeOptions& options) const;
};

PinholeCase MakeCase(const SyntheticOptions& options);

// Replaces the corners by what `views` see of the target in the poses of the telecentric solution.
void SeeWith(const std::vector<PinholeView>& views, PinholeCase& made);

// Turns and moves every view and pose of the start at random, by about 0.3 degrees and 0.1 mm.
void DisturbStart(PinholeCase& made);

// Puts the ruler at `count` places of the array: adds its images to the session and returns its
// crosses without noise, as the telecentric views see them.
std::vector<CrossObservation> MakeRulers(SyntheticArray& array, int count);

double RmsError_um(const std::vector<PinholeRulerLength>& lengths);

}  // namespace telestrain::testing_support
