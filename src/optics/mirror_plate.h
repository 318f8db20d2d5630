#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "geometry/mirror.h"
#include "optics/convex_outline.h"

namespace telestrain {

// A mirror with an edge: a plane figure without thickness, array frame, mm. Axes and normal are
// orthonormal and right-handed.
struct MirrorPlate {
  int path = 0;    // index of its path in the rig
  int mirror = 0;  // 0 is the one nearest to the lens
  std::string name;
  Eigen::Vector3d origin_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_x = Eigen::Vector3d::UnitX();
  Eigen::Vector3d axis_y = Eigen::Vector3d::UnitY();
  ConvexOutline outline_mm;  // in the plate's axes, from its origin

  Eigen::Vector3d Normal() const;
  Eigen::Vector2d InPlate(const Eigen::Vector3d& point_in_array_mm) const {
    const Eigen::Vector3d offset = point_in_array_mm - origin_mm;
    return {axis_x.dot(offset), axis_y.dot(offset)};
  }
  Eigen::Vector3d InArray(const Eigen::Vector2d& point_in_plate_mm) const {
    return origin_mm + point_in_plate_mm.x() * axis_x + point_in_plate_mm.y() * axis_y;
  }
  std::vector<Eigen::Vector3d> Corners() const;
  // Width and height of the outline along the plate's axes.
  Eigen::Vector2d Size_mm() const;
};

// The smallest distance between two plates; 0 when they cut or lie in one another. Plates that
// share an edge are 1e-6 of their size apart and not 0.
double GapBetween_mm(const MirrorPlate& a, const MirrorPlate& b);

// Whether the straight way between two points passes through the plate. Ways that begin or end on
// it do not count.
bool StandsBetween(const MirrorPlate& plate, const Eigen::Vector3d& from_mm,
                   const Eigen::Vector3d& to_mm);

// Cuts two plates that cut each other, at the line where their planes meet, or, when they lie in
// one plane, half-way between their `middle` points. Each keeps the side of its own middle.
void PartPlates(MirrorPlate& a, MirrorPlate& b, const Eigen::Vector3d& middle_a_mm,
                const Eigen::Vector3d& middle_b_mm);

}  // namespace telestrain
