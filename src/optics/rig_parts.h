#pragma once

#include <array>

#include "optics/rig_design.h"

namespace telestrain {

// The parts of AnalyseRig, in the order in which they run. Private to the module.

// Rays of the view, its footprint's size and its plates, not yet cut at each other's.
Result<ViewDesign> DesignView(const OpticalRig& rig, std::size_t path, const DesignOptions& options,
                              double numerical_aperture);

// Cuts the plates of different paths where they meet and finds gaps and overlaps.
void PartAllPlates(RigDesign& design);
// Light that misses plates or is stopped by one, per view.
void FindLosses(const OpticalRig& rig, RigDesign& design);

// Pairs, footprints of the views and the numbers of the whole array.
void DesignPairs(const OpticalRig& rig, RigDesign& design);

void CheckDesign(const OpticalRig& rig, const DesignLimits& limits, RigDesign& design);

// The aperture's rays of one object point: unit vectors from the object towards the last mirror,
// and the share of light that each stands for. The rim's have no weight; they only tell whether
// light is lost at all.
struct ApertureRay {
  Eigen::Vector3d direction;
  double weight = 0;
};
std::vector<ApertureRay> ApertureRays(const PhysicalCamera& virtual_camera,
                                      double numerical_aperture);
// The object point that the virtual camera sees in focus at these image-plane coordinates.
Eigen::Vector3d ObjectPoint(const PhysicalCamera& virtual_camera, const Eigen::Vector2d& ideal_mm,
                            double focus_path_mm);
// The four corners of a field, counter-clockwise in (u, v).
std::array<Eigen::Vector2d, 4> CornersOf(const Eigen::AlignedBox2d& field_mm);

}  // namespace telestrain
