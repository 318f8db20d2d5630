#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "measurement/extensometer_class.h"
#include "measurement/line_fit.h"
#include "measurement/sequence_state.h"
#include "measurement/warm_up.h"

namespace telestrain {

// What a sequence of states says about the instrument: camera against gauges over the cycles,
// hysteresis, drift, repeatability, noise floors, class (MODEL.md 10). All strains in microstrain.
//
// Every change since the reference is a difference of two readings. Its variance is halved between
// them, and the reference's half, common to all states, enters means and intercepts in full but
// neither slopes nor differences between states.

struct SequenceOptions {
  double base_length_mm = 0;   // of the long base at the reference
  double coverage_factor = 2;  // of U; also what counts as significant
  // A pipe that moved by less, at either patch, did not move: a tenth of a pixel on the object,
  // below which the interpolation's periodic error stays what it is. 0: everything moved.
  double still_mm = 0;
};

// The unloading branch against the loading one at the same gauge value: difference of the errors
// camera minus gauge, that of loading interpolated.
struct Hysteresis {
  int count = 0;              // of unloading states within the loading branch
  Estimate largest;           // of the largest size
  double at_microstrain = 0;  // gauge value of that
  Estimate mean;
};

// Camera over gauges of a cycle or of all states.
struct GaugeRegression {
  int count = 0;
  FittedLine line;          // x: gauges, y: camera, microstrain
  Estimate bias;            // mean of camera minus gauges
  double residual_rms = 0;  // about the line
  double max_abs_residual = 0;
};

struct CycleStatistics {
  std::string cycle;
  std::optional<GaugeRegression> regression;  // two gauge values at least
  std::optional<Hysteresis> hysteresis;
  std::optional<Estimate> zero;  // mean error of the cycle's zero states
};

// Camera strain of states without strain.
struct NoiseFloor {
  int count = 0;
  Estimate mean;  // with the reference's noise
  double sd = 0;  // about the mean, count - 1 degrees of freedom
  double max_abs = 0;
  double stated_sd = 0;  // what the stated uncertainties lead to expect
  double largest_motion_mm = 0;
};

struct Repeatability {
  int groups = 0;  // steps that came back in another cycle
  double sd = 0;   // of one value, pooled
  int degrees_of_freedom = 0;
  double stated_sd = 0;  // what the stated uncertainties lead to expect
};

struct SequenceStatistics {
  std::optional<GaugeRegression> regression;  // over all states
  std::vector<CycleStatistics> cycles;        // in order of appearance
  // Camera minus the line of `regression`, one per state; nothing without gauges.
  std::vector<std::optional<double>> residuals;
  std::vector<std::size_t> zero_states;          // without the reference
  std::optional<Estimate> drift_per_hour;        // slope of the zero states' error over time
  std::optional<Estimate> largest_cycle_change;  // of `zero` from one cycle to a later one
  std::optional<Repeatability> repeatability;
  std::optional<NoiseFloor> still, moved;
  WarmUp warm_up;
  std::optional<ExtensometerClass> iso9513, astm_e83;
};

// Statistics of states in the order in which they were taken. A zero state is one whose gauges
// changed by less than their expanded uncertainty; where that is not known, one with the
// reference's step label. Errors are camera minus gauges, or the camera alone at zero states of a
// sequence without gauges. What the states do not determine is left empty.
SequenceStatistics AnalyseSequence(const std::vector<SequenceState>& states,
                                   const SequenceOptions& options);

// `coverage_factor` of the expanded uncertainties.
nlohmann::ordered_json SequenceJson(const SequenceStatistics& statistics,
                                    const std::vector<SequenceState>& states,
                                    double coverage_factor);

}  // namespace telestrain
