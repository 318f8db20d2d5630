#include "simulation/pipe_rays.h"

#include <algorithm>
#include <cmath>

namespace telestrain {
namespace {

constexpr double kConverged_mm = 1e-10;
constexpr int kMaxIterations = 30;

// A ray in the frame of a straight pipe.
struct PipeRay {
  Eigen::Vector3d point_mm, direction;
  double across2;  // squared length of the direction's part across the axis

  PipeRay(const Eigen::Vector3d& point, const Eigen::Vector3d& unit_direction)
      : point_mm(point),
        direction(unit_direction),
        across2(unit_direction.tail<2>().squaredNorm()) {}

  SurfaceHit HitUndeformed(double radius_mm, const Eigen::Vector3d& displacement_mm) const {
    const Eigen::Vector3d start_mm = point_mm - displacement_mm;
    const double along = start_mm.tail<2>().dot(direction.tail<2>()) / across2;
    const Eigen::Vector3d nearest_mm = start_mm - along * direction;  // to the axis
    const double distance2 = nearest_mm.tail<2>().squaredNorm();
    const double half_chord = std::sqrt(std::max(0.0, radius_mm * radius_mm - distance2) / across2);
    SurfaceHit hit;
    hit.miss_mm = std::sqrt(distance2) - radius_mm;
    hit.material_mm = nearest_mm - half_chord * direction;
    if (hit.miss_mm > 0) hit.material_mm.tail<2>() *= radius_mm / std::sqrt(distance2);
    hit.cos_incidence = -hit.material_mm.tail<2>().dot(direction.tail<2>()) / radius_mm;
    return hit;
  }
};

// The same ray beside the straight pipe that touches the bent one's axis at `along_mm`.
PipeRay Unbend(const DeformedPipe& pipe, const PipeRay& ray, double along_mm) {
  const Eigen::Matrix3d local_from_pipe = pipe.BendRotation(along_mm).transpose();
  const Eigen::Vector3d touch_mm = pipe.Bend({along_mm, 0, 0});
  return {local_from_pipe * (ray.point_mm - touch_mm) + Eigen::Vector3d(along_mm, 0, 0),
          local_from_pipe * ray.direction};
}

double AxisPlace_mm(const SurfaceHit& hit) { return hit.material_mm.x() + hit.displacement_mm.x(); }

// What is missing to the place along the bent axis of a hit beside where the pipes touch: on the
// inside of the arc a step is shorter than on the axis.
double AlongArc_mm(const DeformedPipe& pipe, const SurfaceHit& hit, const SurfaceHit& before) {
  const double step_mm = hit.material_mm.x() - before.material_mm.x();
  const double off_axis = (hit.material_mm.z() + before.displacement_mm.z()) / pipe.bend_radius_mm;
  return step_mm * off_axis / (1 - off_axis);
}

}  // namespace

PipeRays::PipeRays(const DeformedPipe& pipe)
    : pipe_(pipe), pipe_from_array_(pipe.array_from_pipe.transpose()) {}

SurfaceHit PipeRays::Hit(const ChiefRay& ray, const SurfaceHit& start) const {
  const PipeRay in_pipe(pipe_from_array_ * (ray.point_in_array_mm - pipe_.origin_in_array_mm),
                        pipe_from_array_ * ray.direction_in_array.normalized());
  const bool bent = pipe_.bend_radius_mm != 0;
  SurfaceHit hit = start;
  for (int i = 0; i < kMaxIterations; ++i) {
    const SurfaceHit before = hit;
    const PipeRay local = bent ? Unbend(pipe_, in_pipe, AxisPlace_mm(before)) : in_pipe;
    hit = local.HitUndeformed(pipe_.radius_mm, before.displacement_mm);
    if (bent) hit.material_mm.x() += AlongArc_mm(pipe_, hit, before);
    hit.displacement_mm = pipe_.Displacement_mm(hit.material_mm);
    double change_mm = (hit.displacement_mm - before.displacement_mm).cwiseAbs().maxCoeff();
    if (bent) {
      // How far the touching pipe is off where it was hit.
      const double moved_mm = AxisPlace_mm(hit) - AxisPlace_mm(before);
      change_mm = std::max(change_mm, std::abs(moved_mm * moved_mm / pipe_.bend_radius_mm));
    }
    if (change_mm < kConverged_mm) break;
  }
  return hit;
}

}  // namespace telestrain
