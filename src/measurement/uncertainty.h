#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "calibration/array_calibration.h"

namespace telestrain {

// One line of an uncertainty budget (JCGM 100): a source and its standard contribution.
struct BudgetLine {
  std::string source;
  double standard_uncertainty = 0;
};

// Standard deviation of entry i; 0 where rounding made its variance negative.
double Sigma(const Eigen::MatrixXd& covariance, Eigen::Index i);

// Root sum of squares of the lines.
double Combine(const std::vector<BudgetLine>& budget);

// What the calibration gives to a result, in its unit.
struct CalibrationParts {
  double noise = 0;        // of the calibration's own images: sqrt(g C_noise g^T)
  double certificate = 0;  // of the target's certificate: sqrt(g (C - C_noise) g^T)
};

// The two parts of a scalar result from the covariances of the calibration, with g by central
// differences over one standard deviation of every parameter. Throws std::logic_error when a
// covariance is missing.
CalibrationParts CalibrationPart(const ArrayCalibration& array,
                                 const std::function<double(const ArrayCalibration&)>& result);

// The same for several results at once, with their covariances between each other.
struct CalibrationCovariances {
  Eigen::MatrixXd noise, certificate;  // in the order of the results
};
CalibrationCovariances CalibrationPartsOf(
    const ArrayCalibration& array,
    const std::function<Eigen::VectorXd(const ArrayCalibration&)>& results);

}  // namespace telestrain
