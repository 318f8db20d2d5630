#pragma once

#include <Eigen/Core>

#include "viz/scene/camera.h"

namespace telestrain::viz {

// A line of sight of a parallel projection.
struct SightLine {
  Eigen::Vector3d point_in_array_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d away = -Eigen::Vector3d::UnitZ();  // from the viewer into the scene
};

// A camera and the part of the window that it fills; pixels from the window's lower left corner,
// as VTK and X events (turned by VTK) count them: pixel (0,0) is the middle of the corner pixel.
struct DeskCamera {
  ParallelCamera camera;
  PixelBox box;

  double PixelsPerMm() const { return 0.5 * box.height / camera.half_height_mm; }
  Eigen::Vector2d PixelOf(const Eigen::Vector3d& point_in_array_mm) const;
  SightLine SightLineAt(const Eigen::Vector2d& pixel) const;
};

// The views behind the keys 1 to 4.
enum class StandardView { kArray = 1, kSide, kTop, kPipe };
ViewDirection DirectionOf(StandardView view);

}  // namespace telestrain::viz
