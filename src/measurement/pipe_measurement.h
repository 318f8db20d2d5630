#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/console.h"
#include "measurement/gauge_comparison.h"
#include "measurement/sequence_statistics.h"
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

struct PipeMeasurement {
  PipeGrid grid;
  PipeGeometry geometry;
  double magnification_px_per_mm = 0;
  CorrelationOptions options;
  std::vector<MeasuredState> states;  // one per row of pipe.csv, the reference first
  std::optional<GaugeComparison> comparison;
  std::vector<GaugeOutlier> gauge_outliers;
  std::vector<SequenceState> sequence_states;  // what `sequence` was made from
  SequenceStatistics sequence;
  double coverage_factor = 2;  // of the session, for its expanded uncertainties
};

// A subset of a sixteenth of the shortest side of a view, odd.
CorrelationOptions DefaultPipeOptions(const Session& session);

// Reads the pipe images one after the other and measures every state against the first.
Result<PipeMeasurement> MeasurePipe(const Session& session, const ArrayCalibration& array,
                                    const CorrelationOptions& options, Console& console);

}  // namespace telestrain
