#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "measurement/line_fit.h"
#include "measurement/sequence_state.h"

namespace telestrain {

// A state as independent readings of camera and gauges: the change since the reference, with the
// uncertainty of the state's own reading only. The reference's own is that of the first entry.
struct SequenceReading {
  std::size_t state = 0;
  double camera = 0, camera_sigma = 0;
  std::optional<double> gauge;
  double gauge_sigma = 0;  // 0 when not known

  double Error() const { return camera - gauge.value_or(0); }
  double ErrorSigma() const { return gauge ? std::hypot(camera_sigma, gauge_sigma) : camera_sigma; }
  LinePoint Point() const { return {*gauge, camera, gauge_sigma, camera_sigma}; }
};

// One per state, the reference first.
inline std::vector<SequenceReading> ReadingsOf(const std::vector<SequenceState>& states) {
  std::vector<SequenceReading> readings;
  double camera_variances = 0, gauge_variances = 0;
  int camera_count = 0, gauge_count = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const SequenceState& s = states[i];
    const double gauge_sigma = s.gauge_sigma_microstrain.value_or(0);
    readings.push_back({i, s.camera_microstrain, s.camera_sigma_microstrain / std::sqrt(2.0),
                        s.gauge_microstrain, gauge_sigma});
    if (i == 0) continue;
    camera_variances += 0.5 * s.camera_sigma_microstrain * s.camera_sigma_microstrain;
    ++camera_count;
    if (!s.gauge_microstrain) continue;
    gauge_variances += gauge_sigma * gauge_sigma;
    ++gauge_count;
  }
  if (readings.empty()) return readings;
  readings[0].camera = 0;
  if (camera_count > 0) readings[0].camera_sigma = std::sqrt(camera_variances / camera_count);
  if (gauge_count == 0) return readings;
  readings[0].gauge = 0;
  readings[0].gauge_sigma = std::sqrt(gauge_variances / gauge_count);
  return readings;
}

}  // namespace telestrain
