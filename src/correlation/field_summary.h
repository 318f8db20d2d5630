#pragma once

#include <array>

#include "correlation/correlation_field.h"

namespace telestrain {

inline constexpr std::size_t kStatusCount = static_cast<std::size_t>(MatchStatus::kMasked) + 1;

// One field in a few numbers. Means and medians are of the points that have the number; NaN when
// none has.
struct FieldSummary {
  std::size_t points = 0;
  std::array<std::size_t, kStatusCount> count_of_status{};  // in the order of MatchStatus
  std::size_t points_with_strain = 0;
  Eigen::Vector2d mean_displacement_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d mean_strain = Eigen::Matrix2d::Zero();
  Eigen::Vector2d median_sigma_px = Eigen::Vector2d::Zero();      // predicted, of u and v
  Eigen::Vector3d median_sigma_strain = Eigen::Vector3d::Zero();  // predicted, of xx, yy, xy
  double median_sigma_gray = 0;  // noise of one image, from the residuals
  double median_zncc = 0;

  std::size_t converged() const { return count_of_status[0]; }
};

FieldSummary Summarize(const CorrelationField& field);

}  // namespace telestrain
