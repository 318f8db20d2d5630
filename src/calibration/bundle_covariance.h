#pragma once

#include <string>
#include <vector>

#include "calibration/bundle_adjustment.h"

namespace telestrain {

// What is known of the global parameters together when every pose is fitted: the information
// matrix with the poses eliminated (Schur complement; MODEL.md 5).
struct BundleInformation {
  std::vector<std::string> names;  // as in BundleCovariance
  Eigen::MatrixXd reduced;         // per product of the named units; priors included
  Eigen::VectorXd priors;          // what they add to its diagonal
  Eigen::VectorXd own;  // of each parameter if all others, poses too, were known; priors included
};

// A combination of parameters that the data know little of.
struct WeakDirection {
  struct Part {
    std::string name;
    double share = 0;  // of the combination; all shares add up to 1
    double sigma = 0;  // by how much one standard deviation of the combination moves it, own unit
  };
  // Share of the combination's information that is left after everything else was fitted, 0 to 1
  // (an eigenvalue of the matrix scaled by `own`). Below kSingularShare nothing is known.
  double information = 0;
  std::vector<Part> parts;  // the largest share first, down to 1 %
};
inline constexpr double kSingularShare = 1e-12;

// At an adjusted `state` with the options that adjusted it; the corners' information is divided by
// max(1, sigma0^2), that of the priors and the stage is not.
// Fails (kEstimationFailed) when a pose is not determined by itself.
Result<BundleInformation> InformationOf(const CalibrationData& data, const ArrayState& state,
                                        const BundleOptions& options, double sigma0 = 1);

// The `count` weakest directions, weakest first.
std::vector<WeakDirection> WeakDirections(const BundleInformation& information, bool with_priors,
                                          int count);

// Inverse of the information, scaled and failing as InformationOf, and when the global parameters
// are not determined: the message names the weakest direction.
Result<BundleCovariance> CovarianceOf(const CalibrationData& data, const ArrayState& state,
                                      const BundleOptions& options, double sigma0);

// Lens and views together with what the poses do on average, which says where the calibrated array
// stands against the target and not against a frame. When pose k of K errs by the small motion
// (w_k, d_k) about the array's origin, a point P that is tied to the target errs by w_k x P + d_k,
// on average over the poses by w x P + d with the means w and d.
struct MeanMotionCovariance {
  // Of ArrayCalibration::Perturbed's parameters, then w (rad) and d (mm), in array axes. In the
  // second the target is taken to be exactly as certified.
  Eigen::MatrixXd of_everything, of_noise;
};

// As CovarianceOf. The poses answer to lens, views and target by e_k - C_k g, with errors e_k of
// their own that are independent of everything but the poses that the stage connects. The target's
// frame is that of its first board: what is uncertain about the other boards' places shows in the
// views that see those.
Result<MeanMotionCovariance> CovarianceWithMeanMotion(const CalibrationData& data,
                                                      const ArrayState& state,
                                                      const BundleOptions& options, double sigma0);

}  // namespace telestrain
