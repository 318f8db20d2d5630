#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "optics/telecentric_view.h"

namespace telestrain {

// Which parameters of the lens are estimated beside its magnification.
struct LensModel {
  std::array<bool, 5> distortion{};  // k1, k2, p1, p2, k3
  bool aspect = false;
  bool telecentricity = false;
  bool per_view = false;  // a lens of its own for every view instead of one for all

  bool operator==(const LensModel&) const = default;
  // Estimated parameters of one lens, its magnification counted.
  int Count() const;
};

// "none", "k1", "k1 p1 p2 telecentricity, a lens per view", …
std::string ToText(const LensModel& model);

// The calibrated instrument: the lens, several views in the array frame, and how well both are
// known.
struct ArrayCalibration {
  std::vector<TelecentricLens> lenses;  // one for all views, or one per view
  std::vector<TelecentricView> views;
  LensModel model;

  // Covariance of the perturbation vector of `Perturbed`: per lens its magnification (px/mm) and
  // the estimated ones of aspect, k1, k2, p1, p2, k3, telecentricity (their own units), then per
  // view a rotation (rad, about the camera's axes) and an offset (mm). Gauge: one pose of the
  // target is held fixed (MODEL.md 5). The first holds everything; in the second the target is
  // taken to be exactly as certified, so that their difference is what its certificate brings.
  Eigen::MatrixXd covariance, covariance_of_noise;

  const TelecentricLens& LensOf(std::size_t view) const {
    return lenses.size() == 1 ? lenses.front() : lenses.at(view);
  }
  // Through the view's own lens; `view` is an index into `views`.
  Eigen::Vector2d Project(int view, const Eigen::Vector3d& point_in_array_mm) const;
  ImageRay RayOf(int view, const Eigen::Vector2d& pixel) const;
  // Of the lens, or the mean over the lenses.
  double Magnification_px_per_mm() const;

  int ParameterCount() const;
  std::vector<std::string> ParameterNames() const;
  // The calibration that differs by `delta` (ParameterCount entries): R_i becomes Exp(w_i) R_i.
  ArrayCalibration Perturbed(const Eigen::VectorXd& delta) const;

  const TelecentricView* FindView(const std::string& name) const;
};

}  // namespace telestrain
