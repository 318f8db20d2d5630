#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"
#include "report/json_lookup.h"

namespace telestrain {

// What is known of an earlier report of the same instrument.
struct EarlierResults {
  std::string file;    // what `sha256` is of: "report.pdf" or "results.json"
  std::string sha256;  // of that file
  Json results;        // its results.json
  Json calibration;    // its calibration.json, null without one
  std::string calibration_sha256;
};

// Reads a results folder or the attachments of a report.pdf. Fails (kBadInput) when it is neither,
// or has no results.json.
Result<EarlierResults> ReadEarlierResults(const std::filesystem::path& path);

// Fails (kBadInput) when the earlier report is of an instrument with other view names, or was made
// from the very same measurements as `results_files` (the table "result-files") names.
Status RequireComparable(const EarlierResults& earlier, const std::string& name, const Json& inputs,
                         const Json& calibration, const Json& results_files);

}  // namespace telestrain
