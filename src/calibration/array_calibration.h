#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "optics/telecentric_view.h"

namespace telestrain {

// Which distortion coefficients are estimated, in the order k1, k2, p1, p2, k3.
using DistortionModel = std::array<bool, 5>;

// "none", "k1", "k1 p1 p2", …
std::string ToText(const DistortionModel& model);

// The calibrated instrument: one lens, several views in the array frame, and how well both are
// known.
struct ArrayCalibration {
  TelecentricLens lens;
  std::vector<TelecentricView> views;
  DistortionModel model{};

  // Covariance of the perturbation vector of `Perturbed`: magnification (px/mm), the estimated
  // distortion coefficients (their own units), then per view a rotation (rad, about the camera's
  // axes) and an offset (mm). Gauge: one pose of the target is held fixed (MODEL.md 5).
  Eigen::MatrixXd covariance;

  int ParameterCount() const;
  std::vector<std::string> ParameterNames() const;
  // The calibration that differs by `delta` (ParameterCount entries): R_i becomes Exp(w_i) R_i.
  ArrayCalibration Perturbed(const Eigen::VectorXd& delta) const;

  const TelecentricView* FindView(const std::string& name) const;
};

}  // namespace telestrain
