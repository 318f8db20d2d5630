#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "viz/scene/camera.h"

namespace telestrain::viz {

// Which pixels of a picture are taken; answers rectangle queries in constant time.
class Occupancy {
 public:
  // `taken`: one byte per pixel, rows from the bottom, not 0 where something is drawn.
  Occupancy(int width_px, int height_px, const std::vector<std::uint8_t>& taken);
  // Taken pixels inside the box; pixels outside the picture count as taken.
  int Count(const PixelBox& box) const;

 private:
  int width_px_, height_px_;
  std::vector<int> sums_;  // summed-area table, (width + 1) x (height + 1)
};

// Puts a rectangle of `size_px` as near as possible to `anchor_px` so that it lies inside `within`,
// on free pixels and off all `placed` boxes. Looks along rings of growing radius, starting in the
// direction `preferred_rad`; empty when there is no such place.
struct LabelRequest {
  Eigen::Vector2d anchor_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d size_px = Eigen::Vector2d::Zero();
  double preferred_rad = 0;
  double clearance_px = 0;  // kept free around the label
  double straight_px = 0;   // up to here the preferred direction beats nearer places elsewhere
  bool leader = false;      // a line joins label and anchor; it crosses no placed box if it can
};
std::optional<PixelBox> PlaceLabel(const LabelRequest& request, const PixelBox& within,
                                   const Occupancy& occupancy, const std::vector<PixelBox>& placed);

bool Overlap(const PixelBox& a, const PixelBox& b);

// The leader from an anchor to a label's box, `gap_px` short of it, as small boxes along its way
// for `placed`; empty when the label stands beside its anchor.
std::vector<PixelBox> LeaderBoxes(const Eigen::Vector2d& anchor_px, const PixelBox& label,
                                  double gap_px);

}  // namespace telestrain::viz
