#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <array>
#include <utility>

#include "calibration/calibration_data.h"
#include "geometry/rotation.h"

// Private to bundle_adjustment.cpp and its test: the residuals that Ceres evaluates.
namespace telestrain {

inline constexpr int kLensSize = 6;  // relative magnification, then k1 k2 p1 p2 k3 in scaled form
inline constexpr int kViewSize = 5;  // rotation vector, offset
inline constexpr int kPoseSize = 6;  // rotation vector, origin

// Coefficients are estimated as k r0^n with r0 about the field's radius, so that all parameters
// have similar sizes (MODEL.md 1.2).
inline constexpr double kScaleRadius_mm = 8.0;
inline constexpr std::array<int, 5> kRadiusPower{2, 4, 1, 1, 6};

// The lens of a parameter block; `unit_px_per_mm` is what a relative magnification of 1 means.
TelecentricLens LensFromBlock(const double* block, double unit_px_per_mm,
                              const Eigen::Vector2d& center_px);

// Residuals of one board: 2 per corner, whitened; parameters lens, view, pose (MODEL.md Eq. 12).
class BoardResidual : public ceres::CostFunction {
 public:
  BoardResidual(const BoardData& board, double unit_px_per_mm, const Eigen::Vector2d& center_px);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  struct Geometry;
  void WriteJacobians(const Geometry& geometry, Eigen::Index corner, const Eigen::Vector2d& ideal,
                      double** jacobians) const;
  Eigen::Matrix<double, 2, kLensSize> LensJacobian(const TelecentricLens& lens,
                                                   const Eigen::Vector2d& ideal) const;

  const BoardData& board_;
  double unit_px_per_mm_;
  Eigen::Vector2d center_px_;
};

// The target moves by the stage's travel along one direction of known sense: `axis` tilted by two
// small numbers towards the two sides.
struct StageResidual {
  template <typename T>
  bool operator()(const T* first_pose, const T* second_pose, const T* tilt, T* residuals) const {
    const Eigen::Matrix<T, 3, 1> direction =
        (axis.cast<T>() + side_x.cast<T>() * tilt[0] + side_y.cast<T>() * tilt[1]).normalized();
    for (int i = 0; i < 3; ++i)
      residuals[i] =
          (second_pose[3 + i] - first_pose[3 + i] - direction[i] * T(travel_mm)) / T(sigma_mm);
    return true;
  }
  Eigen::Vector3d axis, side_x, side_y;
  double travel_mm = 0, sigma_mm = 1;
};

}  // namespace telestrain
