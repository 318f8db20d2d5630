#pragma once

#include <string>
#include <vector>

#include "calibration/bundle_covariance.h"
#include "session/session.h"

namespace telestrain {

// What the uncertainty of the calibration, and nothing else, does to what is measured with it: to
// a length between the middles of the fields of the first two groups, to the strain that a rigid
// motion of its ends feigns, and to a true strain. The pixels are exact and stay what they are; the
// points that they mean move with the errors of lens and views (least-squares intersection of the
// rays of the views of a group). Lengths do not depend on the frame.

struct LengthOptions {
  double shift_mm = 0.1;                     // of the rigid motion
  double turn_rad = 0.1 * 0.01745329251994;  // about the middle between the ends
  double true_strain = 1e-3;                 // moves both ends alike
};

// One standard uncertainty.
struct CalibrationShare {
  double of_everything = 0;  // the noise of the images and the target's certificate
  double of_noise = 0;       // the target taken to be exactly as certified
};

struct LengthUncertainty {
  std::string group_a, group_b;
  double length_mm = 0;
  CalibrationShare length_um;
  // In the direction, or about the axis, in which it is largest.
  CalibrationShare shift_microstrain, turn_microstrain;
  CalibrationShare true_strain_microstrain;
  std::vector<std::string> sentences;  // one for each of the four, in plain words
};

// The views of the session are those of `array` in their order; `covariance` as for
// UncertaintyMaps. Derivatives are central differences over one standard deviation. Fails
// (kEstimationFailed) when there are fewer than two groups or a group has no two views from
// different directions.
Result<LengthUncertainty> LengthUncertaintyOf(const Session& session, const ArrayCalibration& array,
                                              const MeanMotionCovariance& covariance,
                                              const LengthOptions& options = {});

}  // namespace telestrain
