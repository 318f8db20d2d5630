#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measurement/estimate.h"

namespace telestrain {

// The error of the camera in a state without strain, microstrain; sigma is its independent part.
struct ZeroReading {
  double time_s = 0;
  double error = 0;
  double sigma = 0;
};

// Is the instrument still drifting? The paper waited ten minutes for it to warm up; here repeated
// zero states decide.
struct WarmUp {
  int count = 0;        // zero states with a time, the reference among them
  double window_s = 0;  // the last part of them, about which is decided
  // Slope over the window; nothing with fewer than three readings.
  std::optional<Estimate> drift_per_10_min;  // microstrain
  bool still_drifting = false;
  // From here on no drift and no step is resolved; nothing while it drifts.
  std::optional<double> settled_since_s;
  // Of an exponential approach, where the readings tell it from a constant, from a straight line
  // and from other time constants.
  std::optional<Estimate> time_constant_s;
  std::string sentence;  // the finding in plain words
};

// `zeros` in the order of time. The window is the last ten minutes, or what the last three readings
// span if that is longer. Drifting: the slope over the window is larger than its expanded
// uncertainty. Settled since: the earliest reading from which on neither the slope nor any reading
// against the mean of the later ones is significant (Bonferroni over the readings).
WarmUp CheckWarmUp(const std::vector<ZeroReading>& zeros, double coverage_factor);

}  // namespace telestrain
