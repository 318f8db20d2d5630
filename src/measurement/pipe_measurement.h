#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/console.h"
#include "measurement/strain.h"

namespace telestrain {

inline constexpr const char* kStrainSchema = "telestrain.strain/1";

struct MeasuredState {
  PipeState table;  // the row of pipe.csv
  StateStrain strain;
  std::optional<double> gauge_mean_microstrain;  // of the gauges that have a value
  std::optional<double>
      gauge_change_microstrain;  // mean change since the reference of those that read in both
};

// Camera against gauges over the states after the reference.
struct GaugeComparison {
  int count = 0;
  double rms_error_microstrain = 0;
  double mean_error_microstrain = 0;
  double max_abs_error_microstrain = 0;
  double standard_uncertainty_microstrain = 0;  // of one camera value (RMS), without the gauges'
  double slope = 0;  // of camera over gauge, least squares; NaN when the gauges never change
  double intercept_microstrain = 0;
};

struct PipeMeasurement {
  PipeGrid grid;
  PipeGeometry geometry;
  double magnification_px_per_mm = 0;
  CorrelationOptions options;
  std::vector<MeasuredState> states;  // one per row of pipe.csv, the reference first
  std::optional<GaugeComparison> comparison;
};

// A subset of a sixteenth of the shortest side of a view, odd.
CorrelationOptions DefaultPipeOptions(const Session& session);

// Reads the pipe images one after the other and measures every state against the first.
Result<PipeMeasurement> MeasurePipe(const Session& session, const ArrayCalibration& array,
                                    const CorrelationOptions& options, Console& console);

}  // namespace telestrain
