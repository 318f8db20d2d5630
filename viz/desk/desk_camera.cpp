#include "viz/desk/desk_camera.h"

#include <Eigen/Geometry>

namespace telestrain::viz {
namespace {

Eigen::Vector3d RightOf(const ParallelCamera& camera) {
  return camera.up.cross(camera.towards_viewer);
}

// The middle of the box, where the focal point is.
Eigen::Vector2d MiddleOf(const PixelBox& box) {
  return {box.left + 0.5 * box.width - 0.5, box.bottom + 0.5 * box.height - 0.5};
}

}  // namespace

Eigen::Vector2d DeskCamera::PixelOf(const Eigen::Vector3d& point_in_array_mm) const {
  const Eigen::Vector3d offset_mm = point_in_array_mm - camera.focal_in_array_mm;
  return MiddleOf(box) +
         PixelsPerMm() * Eigen::Vector2d(offset_mm.dot(RightOf(camera)), offset_mm.dot(camera.up));
}

SightLine DeskCamera::SightLineAt(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d offset_mm = (pixel - MiddleOf(box)) / PixelsPerMm();
  return {camera.focal_in_array_mm + offset_mm.x() * RightOf(camera) + offset_mm.y() * camera.up,
          -camera.towards_viewer};
}

ViewDirection DirectionOf(StandardView view) {
  switch (view) {
    case StandardView::kSide:
      return {0, 0};
    case StandardView::kTop:
      return {0, 90};
    case StandardView::kPipe:
      return {6, 34};
    case StandardView::kArray:
      break;
  }
  return {26, 13};
}

}  // namespace telestrain::viz
