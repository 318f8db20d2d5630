#include "simulation/deformed_pipe.h"

#include <algorithm>
#include <cmath>

namespace telestrain {
namespace {

constexpr double kConverged_mm = 1e-10;
constexpr int kMaxIterations = 30;

}  // namespace

Eigen::Vector3d DeformedPipe::Material(double along_mm, double angle_rad) const {
  return {along_mm, radius_mm * std::sin(angle_rad), radius_mm * std::cos(angle_rad)};
}

Eigen::Vector3d DeformedPipe::Displacement_mm(const Eigen::Vector3d& p) const {
  const double e = membrane_strain, k = curvature_per_mm, n = poisson_ratio;
  return {e * p.x() - k * p.x() * p.z(), -n * e * p.y() + n * k * p.y() * p.z(),
          -n * e * p.z() + 0.5 * k * p.x() * p.x() + 0.5 * n * k * (p.z() * p.z() - p.y() * p.y())};
}

double DeformedPipe::AxialStrain(double angle_rad) const {
  return membrane_strain - curvature_per_mm * radius_mm * std::cos(angle_rad);
}

PipeRays::PipeRays(const DeformedPipe& pipe, const Eigen::Vector3d& direction_in_array)
    : pipe_(pipe),
      direction_in_pipe_(pipe.array_from_pipe.transpose() * direction_in_array.normalized()),
      across2_(direction_in_pipe_.tail<2>().squaredNorm()) {}

SurfaceHit PipeRays::HitUndeformed(const Eigen::Vector3d& point_mm) const {
  const double along = point_mm.tail<2>().dot(direction_in_pipe_.tail<2>()) / across2_;
  const Eigen::Vector3d nearest_mm = point_mm - along * direction_in_pipe_;  // to the axis
  const double distance2 = nearest_mm.tail<2>().squaredNorm();
  const double r2 = pipe_.radius_mm * pipe_.radius_mm;
  const double half_chord = std::sqrt(std::max(0.0, r2 - distance2) / across2_);
  SurfaceHit hit;
  hit.miss_mm = std::sqrt(distance2) - pipe_.radius_mm;
  hit.material_mm = nearest_mm - half_chord * direction_in_pipe_;
  if (hit.miss_mm > 0) hit.material_mm.tail<2>() *= pipe_.radius_mm / std::sqrt(distance2);
  hit.cos_incidence =
      -hit.material_mm.tail<2>().dot(direction_in_pipe_.tail<2>()) / pipe_.radius_mm;
  return hit;
}

SurfaceHit PipeRays::Hit(const Eigen::Vector3d& point_in_array_mm,
                         Eigen::Vector3d& displacement_mm) const {
  const Eigen::Vector3d point_mm =
      pipe_.array_from_pipe.transpose() * (point_in_array_mm - pipe_.origin_in_array_mm);
  SurfaceHit hit;
  for (int i = 0; i < kMaxIterations; ++i) {
    hit = HitUndeformed(point_mm - displacement_mm);
    const Eigen::Vector3d found_mm = pipe_.Displacement_mm(hit.material_mm);
    const double change_mm = (found_mm - displacement_mm).cwiseAbs().maxCoeff();
    displacement_mm = found_mm;
    if (change_mm < kConverged_mm) break;
  }
  return hit;
}

}  // namespace telestrain
