#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "measurement/uncertainty.h"
#include "session/session.h"
#include "target/board_observation.h"

namespace telestrain {

inline constexpr const char* kRulerSchema = "telestrain.ruler/1";

// Sources of the budget of a length.
inline constexpr const char* kCrossPositions = "cross positions";
inline constexpr const char* kCalibrationNoise = "calibration";
inline constexpr const char* kTargetCertificate = "target certificate";
inline constexpr const char* kRulerCertificate = "ruler certificate";

// The ruler in one image: the distance between the crosses of the first two groups.
struct RulerLength {
  std::string image;
  double length_mm = 0;
  double error_um = 0;  // measured minus certified
  double standard_uncertainty_um = 0;
  Eigen::Vector3d end_a_in_array_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_b_in_array_mm = Eigen::Vector3d::Zero();
  double residual_px = 0;          // largest epipolar residual of the two ends
  std::vector<BudgetLine> budget;  // um
  std::string rejected_because;    // not empty: no length
};

struct RulerSummary {
  int count = 0;
  double mean_error_um = 0;
  double sd_error_um = 0;
  double max_abs_error_um = 0;
};

// Lengths from the crosses of all ruler images, in the order of the session (MODEL.md Eq. 14). An
// image whose cross is missing in more views than leave two per group is rejected with the reason,
// and one whose views disagree on a cross by more than 0.5 px or four of its standard deviations.
std::vector<RulerLength> MeasureRuler(const Session& session, const ArrayCalibration& array,
                                      const std::vector<CrossObservation>& crosses);

RulerSummary Summarise(const std::vector<RulerLength>& lengths);

std::string RulerCsv(const std::vector<RulerLength>& lengths);
nlohmann::ordered_json RulerJson(const Session& session, const std::vector<RulerLength>& lengths,
                                 const std::map<std::string, std::string>& made_from);

}  // namespace telestrain
