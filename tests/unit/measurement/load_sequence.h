#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "measurement/sequence_state.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain::testing_support {

// A loading sequence of a camera and gauges with known faults, all strains in microstrain.
struct SequenceFaults {
  int cycles = 3;
  int steps_up = 5;  // and as many down, to no load
  double full_load = 750;
  double slope = 1;           // of the camera over the gauges
  double hysteresis = 0;      // of the camera, added at half load when unloading
  double drift_per_hour = 0;  // of the camera
  double camera_sigma = 0.2;  // of one reading
  double gauge_sigma = 0.5;   // of one reading of the mean
  double seconds_per_state = 60;
};

inline std::vector<SequenceState> MakeSequence(const SequenceFaults& f, Random& random) {
  struct Reading {
    double camera, gauge;
  };
  const auto read = [&](double load, double share_down, double time_s) {
    // A lens-shaped loop: zero at both ends, `hysteresis` at half load.
    const double loop = 4 * share_down * (1 - share_down) * f.hysteresis;
    return Reading{f.slope * load + loop + f.drift_per_hour * time_s / 3600 +
                       f.camera_sigma * random.Normal(1),
                   load + f.gauge_sigma * random.Normal(1)};
  };
  std::vector<SequenceState> states;
  Reading reference{};
  const int per_cycle = 2 * f.steps_up;
  for (int i = 0; i <= f.cycles * per_cycle; ++i) {
    const int step = i == 0 ? 0 : (i - 1) % per_cycle + 1;
    const bool down = step > f.steps_up;
    const double share = (down ? per_cycle - step : step) / static_cast<double>(f.steps_up);
    const double time_s = i * f.seconds_per_state;
    const Reading reading = read(share * f.full_load, down ? 1 - share : 0, time_s);
    if (i == 0) reference = reading;
    SequenceState state;
    state.image = "state_" + std::to_string(i);
    state.cycle = std::to_string(i == 0 ? 1 : (i - 1) / per_cycle + 1);
    state.step = std::to_string(step);
    state.time_s = time_s;
    state.camera_microstrain = reading.camera - reference.camera;
    state.camera_sigma_microstrain = i == 0 ? 0 : std::sqrt(2.0) * f.camera_sigma;
    state.gauge_microstrain = reading.gauge - reference.gauge;
    state.gauge_sigma_microstrain = f.gauge_sigma;
    states.push_back(state);
  }
  return states;
}

}  // namespace telestrain::testing_support
