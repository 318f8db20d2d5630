#pragma once

#include <filesystem>

#include "calibration/bundle_adjustment.h"
#include "session/session.h"

namespace telestrain {

// A calibration as its results folder holds it: what was adjusted, how, and where it ended.
struct CalibrationRecord {
  CalibrationData data;   // the corners that were used, weighted as they were
  ArrayState state;       // with the covariances of the array
  BundleOptions options;  // that lead from `data` to `state`
  double sigma0 = 1;
  bool noise_is_assumed = false;  // the corners' noise was taken from the residuals
};

// Reads calibration.json and residuals.csv of `results`; `session` is the one that they were made
// from. Fails (kBadInput) when a file is missing, lacks a key or a column, or when the two files do
// not belong together.
Result<CalibrationRecord> ReadCalibrationRecord(const Session& session,
                                                const std::filesystem::path& results);

}  // namespace telestrain
