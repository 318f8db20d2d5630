#pragma once

#include <functional>

#include "diagnostics/residual_pattern.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain::testing_support {

// A synthetic array whose corners were spoilt and then calibrated by least squares, as if nothing
// were wrong: the residuals have the correlations of a real fit.
struct FittedArray {
  SyntheticArray array;
  CalibrationData data;
  ArrayState state;

  ResidualVerdict Judge() const { return JudgeResiduals(data, state); }
};

struct FitOptions {
  SyntheticOptions synthetic;
  BundleOptions bundle;
  // Changes the truth before the corners are observed (again).
  std::function<void(SyntheticArray&)> truth;
  // Changes the observed corners.
  std::function<void(SyntheticArray&)> corners;
};

// Fails the running test when the adjustment fails.
FittedArray FitArray(const FitOptions& options);

// Adds `shift(pixel)` to every corner that a view saw in an image.
using PixelShift = std::function<Eigen::Vector2d(const Eigen::Vector2d& pixel)>;
void ShiftCorners(SyntheticArray& array, std::size_t image, std::size_t view,
                  const PixelShift& shift);

}  // namespace telestrain::testing_support
