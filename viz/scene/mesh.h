#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

namespace telestrain::viz {

// Corners of a rectangle in the array frame, mm, in order around it.
using Rectangle = std::array<Eigen::Vector3d, 4>;
using Segment = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

// Points in the array frame, mm, and what joins them: faces (planar polygons of three or more
// points, counter-clockwise seen from outside) and lines of two points. Indexes count from 0.
struct Mesh {
  std::vector<Eigen::Vector3d> points_in_array_mm;
  std::vector<std::vector<int>> faces;
  std::vector<std::array<int, 2>> lines;

  void Append(const Mesh& other);
};

// A closed body with two opposite faces given; `near` is the one towards the camera.
Mesh BoxBetween(const Rectangle& near, const Rectangle& far);
Mesh Sheet(const std::vector<Eigen::Vector3d>& outline);
Mesh Sheet(const Rectangle& outline);
// The wall of a round tube without its ends.
Mesh TubeWall(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_mm);
// Shaft and head as one closed body; `thickness_mm` is the shaft's diameter. Empty for an arrow
// without length.
Mesh Arrow(const Segment& from_to, double thickness_mm);
// The surface of an ellipsoid; the columns of `half_axes_mm` are its semi-axes.
Mesh Ellipsoid(const Eigen::Vector3d& center_in_array_mm, const Eigen::Matrix3d& half_axes_mm);
Mesh Lines(const std::vector<Segment>& segments);

std::vector<Segment> EdgesOf(const Rectangle& outline);
std::vector<Segment> EdgesBetween(const Rectangle& near, const Rectangle& far);
// Through all corners and back to the first, or not.
std::vector<Segment> ClosedLine(const std::vector<Eigen::Vector3d>& corners);
std::vector<Segment> OpenLine(const std::vector<Eigen::Vector3d>& corners);
// A circle about an axis, as segments.
std::vector<Segment> Ring(const Eigen::Vector3d& center, const Eigen::Vector3d& axis,
                          double radius_mm);

}  // namespace telestrain::viz
