#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/json_lookup.h"

namespace telestrain {

// Something that differs between two calibrations, new minus old.
struct CalibrationChange {
  Json quantity;  // a text or a Phrase
  std::string unit;
  double value = 0;
  std::optional<double> standard_uncertainty;
};

// What `comparison` (comparison.json of 'telestrain calibrate') says moved.
std::vector<CalibrationChange> ChangesOfComparison(const Json& comparison);

// The same from two calibration.json, without their covariances: magnification (with uncertainty);
// direction of every view in urad and shift of the middle of its field in um on the object (without
// one). The old array is laid over the new one first: turned so that the views' three directions
// agree best, then shifted so that the middles do, in the least-squares sense. Views without
// directions or offsets are left out; the distortion is, too.
std::vector<CalibrationChange> ChangesOfCalibrations(const Json& before, const Json& after);

}  // namespace telestrain
