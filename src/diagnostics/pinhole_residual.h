#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <array>

#include "calibration/calibration_data.h"
#include "diagnostics/pinhole_view.h"

// Private to pinhole_calibration.cpp and its test: the residuals that Ceres evaluates.
namespace telestrain {

inline constexpr int kPinholeLensSize = 6;    // focal length / start, then k1 k2 p1 p2 k3 scaled
inline constexpr int kPinholeCameraSize = 6;  // rotation vector, X and Y of the origin, Z / D
inline constexpr int kPinholePoseSize = 6;    // rotation vector, origin

// Numbers of `view` as blocks and back. Coefficients are estimated as k r0^n; `scale_px_per_mm` of
// `start` is what a relative focal length of 1 means.
std::array<double, kPinholeLensSize> PinholeLensBlock(const PinholeView& view);
std::array<double, kPinholeCameraSize> PinholeCameraBlock(const PinholeView& view);
PinholeView PinholeViewFromBlocks(const PinholeView& start, const double* lens,
                                  const double* camera);

// Residuals of one board: 2 per corner, whitened; parameters lens, camera, pose. Cannot be
// evaluated with a corner behind the camera. Keeps references to `board` and `start`.
class PinholeBoardResidual : public ceres::CostFunction {
 public:
  PinholeBoardResidual(const BoardData& board, const PinholeView& start);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  struct Geometry;
  void WriteJacobians(const Geometry& geometry, Eigen::Index corner, double** jacobians) const;

  const BoardData& board_;
  const PinholeView& start_;
};

}  // namespace telestrain
