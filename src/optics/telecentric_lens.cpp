#include "optics/telecentric_lens.h"

#include <Eigen/LU>

namespace telestrain {

Eigen::Vector2d TelecentricLens::Distort(const Eigen::Vector2d& ideal_mm) const {
  const auto& [k1, k2, p1, p2, k3] = distortion;
  const double x = ideal_mm.x(), y = ideal_mm.y();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

Eigen::Matrix2d TelecentricLens::DistortJacobian(const Eigen::Vector2d& ideal_mm) const {
  const auto& [k1, k2, p1, p2, k3] = distortion;
  const double x = ideal_mm.x(), y = ideal_mm.y();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2 * (k1 + r2 * (2 * k2 + 3 * r2 * k3));  // d(radial)/d(r2) * 2
  Eigen::Matrix2d jacobian;
  jacobian(0, 0) = radial + slope * x * x + 2 * p1 * y + 6 * p2 * x;
  jacobian(0, 1) = slope * x * y + 2 * p1 * x + 2 * p2 * y;
  jacobian(1, 0) = jacobian(0, 1);
  jacobian(1, 1) = radial + slope * y * y + 6 * p1 * y + 2 * p2 * x;
  return jacobian;
}

Eigen::Vector2d TelecentricLens::Undistort(const Eigen::Vector2d& observed_mm) const {
  Eigen::Vector2d ideal = observed_mm;
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector2d step = DistortJacobian(ideal).inverse() * (observed_mm - Distort(ideal));
    ideal += step;
    if (step.squaredNorm() < 1e-28) break;
  }
  return ideal;
}

}  // namespace telestrain
