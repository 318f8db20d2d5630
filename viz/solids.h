#pragma once

#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "viz/scene/color_map.h"

class vtkActor;
class vtkPolyData;
class vtkRenderer;

namespace telestrain::viz {

// The bodies that pictures are made of. Points in the array frame, mm; line widths in px.

using Rectangle = std::array<Eigen::Vector3d, 4>;
using Segment = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

// A closed body with two opposite faces given.
vtkSmartPointer<vtkPolyData> BoxBetween(const Rectangle& near, const Rectangle& far);
vtkSmartPointer<vtkPolyData> Sheet(const Rectangle& outline);
// The wall of a round tube without its ends.
vtkSmartPointer<vtkPolyData> TubeWall(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                      double radius_mm);

// Softly lit, so that the faces of a body differ.
vtkActor* AddBody(vtkRenderer* renderer, vtkPolyData* data, const Rgb& color, double opacity);
// Without light: the colour in the picture is the colour given.
vtkActor* AddFlat(vtkRenderer* renderer, vtkPolyData* data, const Rgb& color, double opacity);
void AddLines(vtkRenderer* renderer, const std::vector<Segment>& segments, const Rgb& color,
              double width_px);
void AddArrow(vtkRenderer* renderer, const Segment& from_to, double thickness_mm, const Rgb& color);

std::vector<Segment> EdgesOf(const Rectangle& outline);
std::vector<Segment> EdgesBetween(const Rectangle& near, const Rectangle& far);
// A circle about an axis, as segments.
std::vector<Segment> Ring(const Eigen::Vector3d& center, const Eigen::Vector3d& axis,
                          double radius_mm);

}  // namespace telestrain::viz
