#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "base/result.h"
#include "optics/telecentric_view.h"

namespace telestrain {

// Ray tracing through the mirrors as they stand, without virtual cameras: what ReflectCamera says
// must come out of it (MODEL.md 1.3), and what a virtual camera does not know does too: where a
// ray meets each mirror, under which angle, and how long its way is. Array frame, mm.

struct RayHit {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_after = Eigen::Vector3d::UnitZ();  // unit vector
  double incidence_rad = 0;  // between ray and normal, in [0, pi/2)
  double path_mm = 0;        // from the start of the ray
};

struct TracedRay {
  Eigen::Vector3d start_mm = Eigen::Vector3d::Zero();
  std::vector<RayHit> hits;  // one per mirror, in order
  Eigen::Vector3d end_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // of the last part
  // start, hits, end.
  std::vector<Eigen::Vector3d> Corners() const;
};

// Where a ray meets infinite mirrors, in their order, from either side. `direction` is a unit
// vector. Fails (kBadInput) with the number of the mirror, counted from 1, that the ray runs
// parallel to (within 1e-9 rad) or away from.
Result<std::vector<RayHit>> HitMirrors(const Eigen::Vector3d& start_mm,
                                       const Eigen::Vector3d& direction,
                                       std::span<const Mirror> mirrors);

// The chief ray of the image-plane coordinates `ideal_mm` (object side): it starts in the plane
// across the axis through camera.position_mm, runs along the axis, and ends after `path_mm`. Fails
// as HitMirrors does, and when the ray ends before the last mirror.
Result<TracedRay> TraceRay(const PhysicalCamera& camera, std::span<const Mirror> mirrors,
                           const Eigen::Vector2d& ideal_mm, double path_mm);

// +1 when image_x, image_y and axis are right-handed, -1 when they are not. Every mirror changes
// the sign.
int Handedness(const PhysicalCamera& camera);

}  // namespace telestrain
