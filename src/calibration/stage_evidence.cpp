#include "calibration/stage_evidence.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/numbers.h"

namespace telestrain {

StageEvidence StudyStage(const Session& session, const CalibrationData& data,
                         const BundleResult& bundle) {
  const ArrayState& state = bundle.state;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const TargetPose& pose : state.poses) normal += pose.array_from_target.col(2);
  normal.normalize();
  std::map<std::string, std::size_t> first_of_pose;
  double own = 0, twin = 0;
  int moves = 0;
  for (std::size_t k = 0; k < data.images.size(); ++k) {
    const auto [at, is_first] = first_of_pose.try_emplace(data.images[k].pose, k);
    const double travel_mm = data.images[k].stage_mm - data.images[at->second].stage_mm;
    if (is_first || travel_mm == 0) continue;
    const Eigen::Vector3d moved =
        state.poses[k].origin_in_array_mm - state.poses[at->second].origin_in_array_mm;
    const Eigen::Vector3d expected =
        state.stage_axis_in_array * travel_mm * (1 + state.stage_scale_relative);
    const Eigen::Vector3d mirrored = moved - 2 * normal.dot(moved) * normal;
    own += (moved - expected).squaredNorm();
    twin += (mirrored - expected).squaredNorm();
    ++moves;
  }
  StageEvidence evidence;
  if (moves == 0) return evidence;
  const Eigen::Vector3d nominal = session.stage_axis_in_array.normalized();
  evidence.axis_to_nominal_deg =
      std::acos(std::clamp(nominal.dot(state.stage_axis_in_array), -1.0, 1.0)) * 57.29577951308232;
  evidence.rms_travel_error_um = 1000 * std::sqrt(own / (3.0 * moves));
  const double variance = session.stage_sigma_mm * session.stage_sigma_mm;
  evidence.twin_chi2_ratio = (bundle.TotalChi2() + (twin - own) / variance) / bundle.TotalChi2();
  return evidence;
}

Status RequireStatedTravels(const Session& session, const CalibrationData& data,
                            const std::vector<TargetPose>& poses) {
  const Eigen::Vector3d axis = session.stage_axis_in_array.normalized();
  std::map<std::string, std::size_t> first_of_pose;
  for (std::size_t k = 0; k < data.images.size(); ++k) {
    const auto [at, is_first] = first_of_pose.try_emplace(data.images[k].pose, k);
    if (is_first) continue;
    const double travel_mm = data.images[k].stage_mm - data.images[at->second].stage_mm;
    const Eigen::Vector3d moved =
        poses[k].origin_in_array_mm - poses[at->second].origin_in_array_mm;
    if ((moved - axis * travel_mm).norm() < 0.1 + 0.1 * std::abs(travel_mm)) continue;
    return EstimationFailed(
        "calibration.csv: from " + data.images[at->second].image + " to " + data.images[k].image +
        " (pose '" + data.images[k].pose + "') the target moved " + FormatFixed(moved.norm(), 3) +
        " mm, " + FormatFixed(axis.dot(moved), 3) + " mm of it along the stage; stage_mm says " +
        FormatFixed(travel_mm, 3) +
        " mm: check stage_mm and pose of these rows and [stage] axis_in_array");
  }
  return {};
}

}  // namespace telestrain
