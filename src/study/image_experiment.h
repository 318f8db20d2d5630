#pragma once

#include <filesystem>
#include <vector>

#include "base/console.h"
#include "calibration/calibrate.h"
#include "measurement/pipe_measurement.h"
#include "measurement/ruler.h"
#include "simulation/experiment_truth.h"
#include "target/detection.h"

namespace telestrain {

// A virtual session with real image files, taken through the program's own chain.
struct ImageOutcome {
  Session session;
  ExperimentTruth truth;
  Detection detection;
  Calibration calibration;
  std::vector<RulerLength> rulers;
  PipeMeasurement pipe;
  std::vector<double> true_axial_microstrain;  // one per pipe state

  int BoardsUsed() const;
  int BoardViews() const { return static_cast<int>(detection.boards.size()); }
  std::vector<double> RulerErrors_um() const;  // against the certified length
  // Measured minus true, of the states after the reference.
  std::vector<double> StrainErrors_microstrain() const;
};

// Writes the session and its truth to <folder>/<name> and <folder>/<name>-truth.json, detects,
// calibrates, measures the rulers and every pipe state. A session that an earlier study left there
// is replaced; one without its truth beside it, or with anything else in it, is refused
// (kBadInput). Fails like the steps, and (kEstimationFailed) when no ruler of several could be
// measured.
Result<ImageOutcome> RunImageExperiment(const VirtualExperimentOptions& options,
                                        const std::filesystem::path& folder,
                                        const std::string& name, Console& console);

}  // namespace telestrain
