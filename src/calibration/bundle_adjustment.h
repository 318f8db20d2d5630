#pragma once

#include <string>
#include <vector>

#include "calibration/array_seed.h"

namespace telestrain {

// Everything that the adjustment moves.
struct ArrayState {
  ArrayCalibration array;         // covariance filled by AdjustBundle on request
  std::vector<TargetPose> poses;  // one per CalibrationData::images
  TargetShape target;             // nominal when empty
  Eigen::Vector3d stage_axis_in_array = Eigen::Vector3d::UnitZ();
  double stage_scale_relative = 0;  // error common to all stated travels
};

ArrayState StateFromSeed(const Session& session, const ArraySeed& seed);

struct BundleOptions {
  LensModel model;                // coefficients that are estimated; the others keep their value
  double stage_sigma_mm = 0.005;  // of one stage travel, per axis
  // Cauchy's loss of each corner's whitened residual vector, with this scale in standard deviations
  // (3 costs 5 % of efficiency and bounds the pull of a mistake); 0: least squares.
  double robust_sigmas = 0;
  // Frees the boards' bows with priors of at least 10 um, for a likelihood-ratio test.
  bool estimate_bow = false;
  bool want_covariance = false;
  int max_iterations = 100;
  // Whether to fail where the iterations end before the minimum. Not in a search for outliers,
  // which wants to know what stands out: a robust loss over gross mistakes can be slow.
  bool must_converge = true;
};

// Of the global parameters together: lenses and views as in ArrayCalibration::ParameterNames, then
// the free ones of the target and of the stage.
struct BundleCovariance {
  std::vector<std::string> names;
  Eigen::MatrixXd joint;  // units as the names say
  // Of the lenses and views: of everything, and with the target exactly as certified.
  Eigen::MatrixXd array, array_of_noise;
  // Marginal, one per image: rotation (rad, Exp(w) R, about the array's axes), origin (mm). Zero
  // for the gauge pose.
  std::vector<Eigen::Matrix<double, 6, 6>> poses;
};

struct BundleResult {
  ArrayState state;
  // Twice the cost, by what it is of: the corners (a robust loss counted as such), the target's
  // priors, the stage's travels with the prior of their common scale.
  double chi2 = 0, chi2_of_priors = 0, chi2_of_stage = 0;
  // The corners' pull: square sum of the influences w r of a robust loss, and its mean slope;
  // without one chi2 and 1.
  double squared_influence = 0, mean_slope = 1;
  int residual_count = 0;  // scalars of the corners
  int prior_count = 0;     // free numbers of the target's shape; each has one prior
  int stage_count = 0;     // scalars of the stage: three per move and one prior
  // Of lenses, views and poses: what the corners pay for. The shape's own numbers are balanced by
  // their priors and the stage's three by its residuals, so that the expected chi2 is
  // residual_count - parameter_count (to a few units in the thousands).
  int parameter_count = 0;
  int iterations = 0;
  int gauge_pose = 0;           // index of the pose that was held fixed
  std::string termination;      // the solver's own words
  BundleCovariance covariance;  // on request

  double TotalChi2() const { return chi2 + chi2_of_priors + chi2_of_stage; }
  // By how much larger every standard uncertainty is than the corners' stated noise alone makes it
  // in least squares: sqrt(squared_influence / degrees of freedom) / mean_slope (Huber, Robust
  // Statistics, 1981, section 7.6). Without a robust loss sqrt(chi2 / degrees of freedom).
  double Sigma0() const;
};

// Minimises the whitened reprojection error of every corner over lenses, views, poses, the boards'
// bows and the stage's direction (MODEL.md Eq. 12; Levenberg-Marquardt in Ceres, one condensed
// residual block per board). Held fixed: the principal point, the pose seen by the most views
// (gauge), and all of the target but the bows; what its certificate leaves open is carried into the
// covariance, in which the corners' information is divided by max(1, Sigma0^2).
// Fails (kEstimationFailed) when the information matrix is singular or the solver does not
// converge. One thread; the same bytes on every machine.
Result<BundleResult> AdjustBundle(const CalibrationData& data, const ArrayState& start,
                                  const BundleOptions& options);

// What Cauchy's loss of this scale makes of a corner's weight, 1 to 0; `squared_length` is that of
// the whitened residual. 1 for a scale of 0: least squares.
inline double RobustWeight(double squared_length, double robust_sigmas) {
  return robust_sigmas > 0 ? 1 / (1 + squared_length / (robust_sigmas * robust_sigmas)) : 1;
}

// Reprojection error (measured minus predicted, px) of every corner of a board.
Eigen::Matrix2Xd ReprojectionErrors_px(const ArrayState& state, const BoardData& board);

}  // namespace telestrain
