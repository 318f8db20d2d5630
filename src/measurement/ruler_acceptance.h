#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibration/array_calibration.h"
#include "measurement/decision.h"
#include "measurement/line_fit.h"
#include "measurement/ruler.h"

namespace telestrain {

// Acceptance of the instrument on its ruler in the spirit of VDI/VDE 2634 part 1 (MODEL.md 8): a
// verdict on every length error, and what the errors depend on. Errors in um.

// Where the ruler was, in the array frame.
struct RulerPose {
  Eigen::Vector3d middle_mm = Eigen::Vector3d::Zero();
  double depth_mm = 0;   // of the middle along the mean viewing direction, away from the camera
  double yaw_deg = 0;    // about that direction, from the array's x
  double pitch_deg = 0;  // away from the camera at the end with the larger x
};

RulerPose PoseOf(const RulerLength& length, const Eigen::Vector3d& mean_axis_in_array);

// Mean of the viewing directions, unit.
Eigen::Vector3d MeanViewingDirection(const ArrayCalibration& array);

struct RulerDecision {
  std::size_t length = 0;  // index into the lengths
  RulerPose pose;
  double expanded_uncertainty_um = 0;
  std::optional<Decision> decision;  // nothing without an MPE
};

// How E depends on one coordinate of the pose.
struct ErrorTrend {
  std::string on;      // "x", "y", "depth", "yaw", "pitch"; "x²" …: curvature beside the slope
  std::string unit;    // of `slope`: "µm/mm", "µm/mm²", "µm/°"
  Estimate slope;      // from the scatter of the errors
  double range = 0;    // of the coordinate over the images
  Estimate effect_um;  // slope × range; of a curvature × (range / 2)²: from the middle to the edge
  bool significant = false;
};

struct RulerRepeatability {
  double sd_um = 0;
  int degrees_of_freedom = 0;
  std::string method;  // from which images, in words
};

struct RulerAcceptance {
  std::vector<RulerDecision> decisions;  // of the lengths that were measured, in order
  std::vector<std::size_t> worst;        // up to five of `decisions`, the worst first
  std::optional<double> mpe_um;
  std::vector<ErrorTrend> trends;
  Estimate bias_um;             // mean of E; what all images share enters it in full
  Estimate spread_um;           // standard deviation of E
  double stated_spread_um = 0;  // what the image noise of the budgets leads to expect of it
  RulerRepeatability repeatability;
  std::string count_sentence;              // number of values against the guideline's
  std::vector<std::string> not_in_budget;  // certificates that are not stated, sentences
};

// VDI/VDE 2634 part 1 wants seven measuring lines of five test lengths each.
inline constexpr int kFewestLengths = 35;

// `lengths` as MeasureRuler gives them; those rejected are left out.
RulerAcceptance AcceptRuler(const Session& session, const ArrayCalibration& array,
                            const std::vector<RulerLength>& lengths);

// Part "acceptance" of ruler.json.
nlohmann::ordered_json RulerAcceptanceJson(const RulerAcceptance& acceptance,
                                           const std::vector<RulerLength>& lengths,
                                           double coverage_factor);

// A ruler image that the calibration used proves nothing. Fails (kBadInput) when an image of the
// ruler has the bytes of one of the calibration, and names both. `sha256_of_file` by the names of
// the tables; a calibration image that is not in it (its corners were given) is not compared.
Status RequireUnseenRuler(const Session& session,
                          const std::map<std::string, std::string>& sha256_of_file);

}  // namespace telestrain
