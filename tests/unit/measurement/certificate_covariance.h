#pragma once

#include "calibration/array_calibration.h"

namespace telestrain::testing_support {

// What the certified distance of the target's boards (along the array's x axis, uncertain by
// `sigma_mm`) gives to the covariance of an array whose model estimates the magnification alone: a
// board that is farther by d moves the offsets of group B by A d.
inline Eigen::MatrixXd CovarianceOfSeparation(const ArrayCalibration& array, double sigma_mm) {
  Eigen::VectorXd by_separation = Eigen::VectorXd::Zero(array.ParameterCount());
  for (std::size_t v = 0; v < array.views.size(); ++v)
    if (array.views[v].group == "B")
      by_separation.segment<2>(1 + 5 * static_cast<Eigen::Index>(v) + 3) =
          array.views[v].axes_in_array.col(0);
  return sigma_mm * sigma_mm * by_separation * by_separation.transpose();
}

}  // namespace telestrain::testing_support
