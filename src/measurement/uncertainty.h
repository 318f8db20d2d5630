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

// Root sum of squares of the lines.
double Combine(const std::vector<BudgetLine>& budget);

// Standard uncertainty that the calibration's covariance gives to a scalar result: sqrt(g C g^T)
// with g by central differences over one standard deviation of every parameter.
double CalibrationPart(const ArrayCalibration& array,
                       const std::function<double(const ArrayCalibration&)>& result);

}  // namespace telestrain
