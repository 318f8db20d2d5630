#include "optics/mirror_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/numbers.h"

namespace telestrain {
namespace {

constexpr double kParallel_rad = 1e-9;

Error MissedMirror(std::size_t index, const std::string& how, const std::string& remedy) {
  return BadInput("the ray " + how + " mirror " + std::to_string(index + 1) + "; " + remedy);
}

}  // namespace

std::vector<Eigen::Vector3d> TracedRay::Corners() const {
  std::vector<Eigen::Vector3d> corners{start_mm};
  for (const RayHit& hit : hits) corners.push_back(hit.point_mm);
  corners.push_back(end_mm);
  return corners;
}

Result<std::vector<RayHit>> HitMirrors(const Eigen::Vector3d& start_mm,
                                       const Eigen::Vector3d& direction,
                                       std::span<const Mirror> mirrors) {
  std::vector<RayHit> hits;
  hits.reserve(mirrors.size());
  RayHit at{start_mm, direction, 0, 0};
  for (std::size_t i = 0; i < mirrors.size(); ++i) {
    const Mirror& mirror = mirrors[i];
    const double cosine = mirror.normal.dot(at.direction_after);
    if (std::abs(cosine) < kParallel_rad)
      return MissedMirror(i, "runs parallel to", "turn this mirror or the one before it");
    const double along_mm = mirror.normal.dot(mirror.point_mm - at.point_mm) / cosine;
    if (!(along_mm > 0))
      return MissedMirror(i, "runs away from",
                          "it lies " + FormatFixed(-along_mm, 3) +
                              " mm behind: turn the mirror before it or correct its point");
    at.point_mm += along_mm * at.direction_after;
    at.direction_after = mirror.ReflectDirection(at.direction_after);
    at.incidence_rad = std::acos(std::min(std::abs(cosine), 1.0));
    at.path_mm += along_mm;
    hits.push_back(at);
  }
  return hits;
}

Result<TracedRay> TraceRay(const PhysicalCamera& camera, std::span<const Mirror> mirrors,
                           const Eigen::Vector2d& ideal_mm, double path_mm) {
  TracedRay ray;
  ray.start_mm = camera.position_mm + ideal_mm.x() * camera.image_x + ideal_mm.y() * camera.image_y;
  TELESTRAIN_ASSIGN_OR_RETURN(ray.hits, HitMirrors(ray.start_mm, camera.axis, mirrors));
  const RayHit last = ray.hits.empty() ? RayHit{ray.start_mm, camera.axis, 0, 0} : ray.hits.back();
  if (path_mm < last.path_mm)
    return BadInput("the ray ends after " + FormatFixed(path_mm, 3) + " mm, but its last mirror " +
                    "is " + FormatFixed(last.path_mm, 3) +
                    " mm away; the object must lie behind all mirrors");
  ray.direction = last.direction_after;
  ray.end_mm = last.point_mm + (path_mm - last.path_mm) * ray.direction;
  return ray;
}

int Handedness(const PhysicalCamera& camera) {
  return camera.image_x.cross(camera.image_y).dot(camera.axis) < 0 ? -1 : 1;
}

}  // namespace telestrain
