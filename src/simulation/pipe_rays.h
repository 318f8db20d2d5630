#pragma once

#include "simulation/deformed_pipe.h"
#include "simulation/virtual_instrument.h"

namespace telestrain {

// Where a ray meets the deformed surface.
struct SurfaceHit {
  Eigen::Vector3d material_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d displacement_mm = Eigen::Vector3d::Zero();
  double cos_incidence = 0;  // between the outward normal and the way back to the camera
  // Distance of the ray from the pipe's axis minus its radius: positive where the ray misses; the
  // hit is then the point of the silhouette beside it.
  double miss_mm = 0;
};

// Follows rays onto a pipe, one after the other.
class PipeRays {
 public:
  explicit PipeRays(const DeformedPipe& pipe);

  // The hit of a ray that comes from the camera: fixed-point iteration on the displacement until it
  // changes by less than 1e-10 mm. A bent pipe is met as the straight one that touches its axis
  // where the last iteration hit it, which converges quadratically. The hit of a neighbour as
  // `start` saves iterations.
  SurfaceHit Hit(const ChiefRay& ray, const SurfaceHit& start) const;

 private:
  const DeformedPipe& pipe_;
  Eigen::Matrix3d pipe_from_array_;
};

}  // namespace telestrain
