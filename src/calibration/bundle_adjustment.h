#pragma once

#include <string>
#include <vector>

#include "calibration/array_seed.h"

namespace telestrain {

// Everything that the adjustment moves.
struct ArrayState {
  ArrayCalibration array;         // covariance filled by AdjustBundle on request
  std::vector<TargetPose> poses;  // one per CalibrationData::images
  Eigen::Vector3d stage_axis_in_array = Eigen::Vector3d::UnitZ();
};

struct BundleOptions {
  DistortionModel model{};        // coefficients that are estimated; the others keep their value
  double stage_sigma_mm = 0.005;  // of one stage travel, per axis
  bool want_covariance = false;
  int max_iterations = 100;
};

struct BundleResult {
  ArrayState state;
  double chi2 = 0;          // whitened residuals, stage included
  int residual_count = 0;   // scalars
  int parameter_count = 0;  // free
  int iterations = 0;
  int gauge_pose = 0;       // index of the pose that was held fixed
  std::string termination;  // the solver's own words
};

// Minimises the whitened reprojection error of every corner over lens, views, poses and the stage's
// direction (MODEL.md Eq. 12; Levenberg-Marquardt in Ceres, one residual block per board with
// analytic derivatives). Held fixed: the principal point, the pose seen by the most views (gauge).
// Fails (kEstimationFailed) when the normal matrix is singular or the solver does not converge.
Result<BundleResult> AdjustBundle(const CalibrationData& data, const ArrayState& start,
                                  const BundleOptions& options);

// Reprojection error (measured minus predicted, px) of every corner of a board.
Eigen::Matrix2Xd ReprojectionErrors_px(const ArrayState& state, const BoardData& board);

}  // namespace telestrain
