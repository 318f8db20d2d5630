#pragma once

#include <optional>
#include <vector>

#include "viz/desk/desk_camera.h"
#include "viz/desk/desk_model.h"

namespace telestrain::viz {

// What lies under a pixel.
struct Pick {
  std::size_t part = 0;  // index into DeskModel::parts()
  Eigen::Vector3d point_in_array_mm = Eigen::Vector3d::Zero();
  // Of a part with values: the measured point nearest to the line of sight, index into its mesh.
  std::optional<int> measured_point;

  bool operator==(const Pick& other) const {
    return part == other.part && measured_point == other.measured_point;
  }
};

// Of the visible parts that the line of sight meets. Opaque faces and lines (within `reach_mm` of
// the line of sight) come first, the nearest to the viewer; only where there is none, the least
// translucent face, the nearest of equals: one can look through a view's box at the surface
// behind it. Milliseconds for a hundred thousand faces.
std::optional<Pick> PickAt(const DeskModel& model, const SightLine& sight, double reach_mm);

// What the panel tells of it: the part's facts; of a measured point its position,
// displacement and all quantities, its standard uncertainty among them, with their units.
std::vector<Fact> FactsOf(const DeskModel& model, const Pick& pick);

}  // namespace telestrain::viz
