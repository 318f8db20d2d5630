#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measurement/sequence_state.h"
#include "measurement/strain.h"
#include "session/session.h"

namespace telestrain {

// Strain gauges beside the camera: their mean, its uncertainty, and which of them is off.

// Mean of the gauges that read.
std::optional<double> MeanOfGauges(const PipeState& state);

// Mean change since the reference of the gauges that read in both states.
std::optional<double> ChangeOfGauges(const PipeState& reference, const PipeState& state);

// Standard uncertainty of one reading of the mean of the gauges that read in both states, from one
// sigma per gauge column (not known: nothing). Nothing when that of a gauge counted is not known.
std::optional<double> SigmaOfGauges(const PipeState& reference, const PipeState& state,
                                    const std::vector<std::optional<double>>& sigmas_microstrain);

// One standard uncertainty per gauge column of the session.
std::vector<std::optional<double>> GaugeSigmas_microstrain(const Session& session);

// What the camera says of a state that is to be compared with the mean of its gauges.
struct ComparedStrain {
  double strain = 0, standard_uncertainty = 0;
  bool at_gauges = false;
};

// The mean of the camera's strain at the gauges that read in both states when the place of each of
// them is known, and otherwise the long-base strain, which a bent pipe has on one fibre only. The
// uncertainty of the mean is the mean uncertainty: its sources are common to all places.
ComparedStrain ComparedWithGauges(const StateStrain& strain,
                                  const std::vector<std::string>& gauge_columns,
                                  const PipeState& reference, const PipeState& state);

// Camera against gauges over the states after the reference.
struct GaugeComparison {
  int count = 0;
  double rms_error_microstrain = 0;
  double mean_error_microstrain = 0;
  double max_abs_error_microstrain = 0;
  double standard_uncertainty_microstrain = 0;  // of one camera value (RMS), without the gauges'
  // Of one error camera minus gauges (RMS); nothing when the gauges' own is not known.
  std::optional<double> error_uncertainty_microstrain;
  double slope = 0;  // of camera over gauge, least squares; NaN when the gauges never change
  double intercept_microstrain = 0;
};

// Nothing when no state after the reference has gauges.
std::optional<GaugeComparison> CompareWithGauges(const std::vector<SequenceState>& states);

// A gauge that disagrees with the others in one state.
struct GaugeOutlier {
  std::string column, image;
  double deviation_microstrain = 0;  // from what the other gauges and its own line lead to expect
  double sigma_microstrain = 0;      // standard uncertainty of that
};

// Bending makes gauges around a pipe differ, but as long as it grows with the load every gauge's
// change stays proportional to the mean change of the others. A robust line through the reference
// (median of the ratios) is that proportion; a gauge more than four standard uncertainties off it
// is named if, without it, the others agree. Where they do not, the pipe bends otherwise than
// before, and no gauge is blamed. Named gauges stay in the mean: leaving one of several out would
// let the bending in. Needs three gauges and three loaded states, and the gauges' uncertainty.
std::vector<GaugeOutlier> FindGaugeOutliers(const Session& session);

}  // namespace telestrain
