#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "report/json_lookup.h"

namespace telestrain {

// What charts read from a results folder beside results.json. A file that does not exist gives
// nothing: an empty list or null JSON. A malformed one fails (kBadInput) with its name and line.

// One corner of residuals.csv: where it is and measured minus modelled.
struct Residual {
  std::string view;
  double u_px, v_px, du_px, dv_px;
};
Result<std::vector<Residual>> ReadResiduals(const std::filesystem::path& folder);

Result<Json> ReadCalibration(const std::filesystem::path& folder);  // calibration.json
Result<Json> ReadDiagnosis(const std::filesystem::path& folder);    // mrcal.json

}  // namespace telestrain
