#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "calibration/calibrate.h"

namespace telestrain {

inline constexpr const char* kCalibrationSchema = "telestrain.calibration/1";
// Keys of TelecentricLens::distortion.
inline constexpr std::array<const char*, 5> kDistortionKeys{"k1_per_mm2", "k2_per_mm4", "p1_per_mm",
                                                            "p2_per_mm", "k3_per_mm6"};

// calibration.json; `made_from` names the inputs with their SHA-256.
nlohmann::ordered_json CalibrationJson(const Session& session, const Calibration& calibration,
                                       const std::map<std::string, std::string>& made_from);

// Columns of residuals.csv: where a corner was measured, measured minus predicted, and the
// covariance that it was weighted with.
inline constexpr const char* kResidualColumns =
    "image,view,column,row,u_px,v_px,du_px,dv_px,cov_uu_px2,cov_uv_px2,cov_vv_px2";

// residuals.csv: one line for each corner that the calibration used.
std::string ResidualsCsv(const Session& session, const Calibration& calibration);

// Lens, views and covariance of a calibration.json. Fails (kBadInput) when the file is missing or
// lacks a key.
Result<ArrayCalibration> ReadArrayCalibration(const std::filesystem::path& path);

}  // namespace telestrain
