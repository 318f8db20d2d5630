#pragma once

#include <Eigen/Core>
#include <vector>

namespace telestrain {

// Convex polygons in a plane (mm), corners counter-clockwise. An outline with fewer than three
// corners is empty.
using ConvexOutline = std::vector<Eigen::Vector2d>;

ConvexOutline RectangleOutline(const Eigen::Vector2d& lowest_mm, const Eigen::Vector2d& highest_mm);
// The smallest convex outline that holds the points.
ConvexOutline HullOf(std::vector<Eigen::Vector2d> points_mm);
double AreaOf_mm2(const ConvexOutline& outline);
// The mean of the corners; a rectangle's middle. The outline must not be empty.
Eigen::Vector2d MiddleOf(const ConvexOutline& outline);
// The part where inward.dot(p - on_line_mm) >= 0.
ConvexOutline CutAt(const ConvexOutline& outline, const Eigen::Vector2d& on_line_mm,
                    const Eigen::Vector2d& inward);
ConvexOutline Intersection(const ConvexOutline& a, const ConvexOutline& b);
bool Contains(const ConvexOutline& outline, const Eigen::Vector2d& point_mm);

}  // namespace telestrain
