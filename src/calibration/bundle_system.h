#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calibration/bundle_terms.h"

// Private to the calibration module: the normal equations with the poses eliminated.
namespace telestrain {

// Normal equations of one pose block and its coupling to the global parameters; after elimination
// `coupling` holds block^-1 coupling, and `block` its inverse. Parameters that are held fixed have
// rows of zeros.
struct GroupSystem {
  Eigen::MatrixXd block, coupling;
};

struct BundleSystem {
  std::vector<std::string> names;
  Eigen::MatrixXd global;  // becomes the Schur complement
  Eigen::VectorXd priors, own;
  std::vector<GroupSystem> groups;
  Eigen::MatrixXd named_from_solver;  // derivative of the named parameters by the solver's
  // Global parameters that the adjustment moves, and those that it takes as certified.
  std::vector<Eigen::Index> adjusted, considered;
  Eigen::Index array_size = 0;  // lenses and views, which come first
};

// Of all terms at `state`, from which `blocks` were made; the corners' information is divided by
// max(1, sigma0^2). Fails (kEstimationFailed) when a pose is not determined by itself.
Result<BundleSystem> EliminatePoses(const CalibrationData& data, const ArrayState& state,
                                    const BundleOptions& options, double sigma0,
                                    BundleBlocks& blocks);

}  // namespace telestrain
