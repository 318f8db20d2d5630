#pragma once

#include <string>

#include "viz/canvas.h"
#include "viz/scene/scene_parts.h"

namespace telestrain::viz {

// Signs that several pictures put into their panels.

void AddScaleBar(Canvas* canvas, const std::string& panel, vtkRenderer* renderer,
                 const ScaleBar& bar);

// The array frame's axes in a small panel of their own, turned as the camera of the scene is.
void AddTriad(Canvas* canvas, const SceneAxes& axes, const ViewDirection& direction,
              const PixelBox& box);

// The views' names at the camera side of their volumes, one label for those behind one another.
void NameViews(Canvas* canvas, const std::string& panel, const Scene& scene);

// A dimension line with arrow heads at both ends of `line` and the text at its middle, upwards in
// the picture; `thickness_mm` is that of its shaft.
void AddDimension(Canvas* canvas, const std::string& panel, vtkRenderer* renderer,
                  const Segment& line, double thickness_mm, const std::string& text);

// A flat arrow over everything, px of the canvas, dark on a white rim; none where it would be
// shorter than its line is wide.
void AddFlatArrow(Canvas* canvas, const Eigen::Vector2d& tail, const Eigen::Vector2d& tip);

// An arc about `center` from one direction to another (unit vectors), with the angle in degrees.
void AddAngle(Canvas* canvas, const std::string& panel, vtkRenderer* renderer,
              const Eigen::Vector3d& center_in_array_mm, const Segment& directions,
              double radius_mm);

}  // namespace telestrain::viz
