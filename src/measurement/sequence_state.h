#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

namespace telestrain {

// What the statistics of a sequence need of one state; the first of a list is the reference, whose
// changes are 0.
struct SequenceState {
  std::string image, cycle, step;  // as pipe.csv names them
  std::optional<double> time_s;
  // Axial strain since the reference (at the gauges, where their places are known), and its
  // standard uncertainty: that of a difference between two readings of one kind, so that half of
  // its variance is the reference's in every state.
  double camera_microstrain = 0;
  double camera_sigma_microstrain = 0;
  std::optional<double> gauge_microstrain;  // change of the gauges' mean since the reference
  // Standard uncertainty of one reading of that mean (of a change: times sqrt 2); nothing when it
  // is not known.
  std::optional<double> gauge_sigma_microstrain;
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero();  // rigid motion since the reference
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
};

}  // namespace telestrain
