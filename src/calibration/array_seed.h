#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calibration/array_calibration.h"
#include "calibration/branch_screening.h"
#include "calibration/calibration_data.h"

namespace telestrain {

// Pose of the target in one image: a point of the target is at rotation * X + origin in the array.
struct TargetPose {
  Eigen::Matrix3d array_from_target = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin_in_array_mm = Eigen::Vector3d::Zero();
};

// How the two-fold ambiguity was decided (MODEL.md 3): by the nominal geometry for every board, and
// independently by the sense of the stage moves for every board of a stage pair.
struct AmbiguityDecision {
  int boards = 0;
  double smallest_nominal_margin_deg = 0;  // rms angle by which the next choice is worse
  int stage_pairs = 0;                     // boards seen before and after a stage move
  int stage_agreeing = 0;                  // of these, where the stage says what the geometry says
  double smallest_stage_margin_px = 0;     // displacement along the decisive direction
};

// A closed-form start for the bundle adjustment.
struct ArraySeed {
  TelecentricLens lens;
  std::vector<TelecentricView> views;                // one per Session::views
  std::vector<TargetPose> poses;                     // one per CalibrationData::images
  std::vector<double> view_magnification_px_per_mm;  // median over the boards of each view
  std::vector<std::optional<Eigen::Vector2d>> view_magnifications_of_paper;  // the paper's Eq. 6
  AmbiguityDecision decision;
  BranchScreening screening;  // third witness (MODEL.md 3)
};

// Homographies, one magnification, the two-fold rotations and their decision, rotation averaging
// and a linear solution of all translations. Fails (kEstimationFailed) when a view sees too few
// boards or when the stage contradicts the nominal geometry.
Result<ArraySeed> SeedArray(const Session& session, const CalibrationData& data);

}  // namespace telestrain
