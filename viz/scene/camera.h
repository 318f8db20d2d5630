#pragma once

#include <Eigen/Core>
#include <vector>

#include "viz/scene/scene.h"

namespace telestrain::viz {

// A rectangle of the picture in px, the origin in the picture's lower left corner (VTK's display
// coordinates), edges between pixels.
struct PixelBox {
  double left = 0, bottom = 0, width = 0, height = 0;
  double Right() const { return left + width; }
  double Top() const { return bottom + height; }
  PixelBox Grown(double by_px) const {
    return {left - by_px, bottom - by_px, width + 2 * by_px, height + 2 * by_px};
  }
};

// A parallel projection: lengths along one direction keep one scale all over the picture.
struct ParallelCamera {
  Eigen::Vector3d focal_in_array_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d towards_viewer = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  double half_height_mm = 1;  // of what the box shows
  double depth_mm = 1;        // everything lies within this distance of the focal plane
};

// Where the viewer stands: turned by azimuth from `-across` towards `+along`, raised by elevation
// towards the instrument.
struct ViewDirection {
  double azimuth_deg = 0, elevation_deg = 0;
};

// The camera that shows `points` as large as fits into width x height px, `margin_px` left free.
ParallelCamera FitCamera(const std::vector<Eigen::Vector3d>& points_in_array_mm,
                         const SceneAxes& axes, const ViewDirection& direction, const PixelBox& box,
                         double margin_px);

}  // namespace telestrain::viz
