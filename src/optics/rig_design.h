#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "optics/mirror_plate.h"
#include "optics/optical_rig.h"
#include "optics/rig_sensitivity.h"

namespace telestrain {

// What a rig of mirrors can do, found by tracing rays through it, and whether that is enough.

// Limits of the checks. They are ours; those that follow from the rig stand in CheckDesign.
struct DesignLimits {
  // Below, the two views of a pair see different patches: measured points get lost at the edges.
  double smallest_overlap_percent = 90;
  // Mean over the view. Near an edge that two paths share a part of the light goes the neighbour's
  // way; 15 % less light is 8 % more noise.
  double largest_light_loss_percent = 15;
};

struct DesignOptions {
  // Object-side numerical aperture. 0 takes DiffractionAperture: the largest that has the lens'
  // stated depth of field.
  double numerical_aperture = 0;
  // Added to every side of the rectangle that the light needs; negative for a smaller mirror.
  double mirror_margin_mm = 0;
  // Width and height of the first, second, … mirror of every path (the longer side of what the
  // light needs takes the first number's place); mirrors without an entry get what they need.
  std::vector<Eigen::Vector2d> mirror_sizes_mm;
  DesignLimits limits;
};

// sqrt(wavelength / depth of field): the wave-optical depth of field of an aperture NA is
// wavelength / NA^2 (M. Born and E. Wolf, Principles of Optics, 8.8.2), at 0.55 um.
double DiffractionAperture(double depth_of_field_mm);

struct MirrorDesign {
  MirrorPlate plate;               // as it is: needed or given size, cut at its neighbours
  Eigen::Vector2d chief_size_mm;   // rectangle of the chief rays alone
  Eigen::Vector2d needed_size_mm;  // with the cone of the aperture
  Eigen::Vector2d cone_radius_mm;  // by which the needed rectangle is larger on a side
  double incidence_rad = 0;        // of the middle ray
  bool is_cut = false;             // at a plate of another path
};

struct ViewDesign {
  std::string name, group;
  int mirrors = 0;
  int handedness = 1;  // of the virtual camera: image_x, image_y, axis; -1 is a mirror image
  TracedRay middle_ray;
  std::vector<TracedRay> corner_rays;  // four, about the field counter-clockwise in (u, v)
  double focus_path_mm = 0;            // from the camera's reference plane to the object
  double first_mirror_path_mm = 0;     // from the first mirror to the object, middle ray
  Eigen::Vector2d field_mm;            // across the axis: width along u, height along v
  ConvexOutline footprint_mm;          // on the pair's plane: along the pipe, across
  std::vector<MirrorDesign> plates;
  double chief_loss_percent = 0;  // pixels whose chief ray misses a plate
  double light_loss_percent = 0;  // mean over pixels and aperture
  double worst_loss_percent = 0;  // of the pixel that loses most
  double full_light_percent = 0;  // pixels that lose nothing
  double blocked_percent = 0;     // rays that some plate stands in the way of
};

struct PairDesign {
  std::string group, first, second;
  double stereo_angle_rad = 0;
  Eigen::Vector3d center_in_array_mm;  // where the middle rays pass each other
  Eigen::Vector3d facing;              // unit vector from the object half-way between the cameras
  double overlap_percent = 0;          // of the smaller footprint
  Eigen::Vector2d common_mm;           // the common patch, along the pipe and across
  double depth_spread_mm = 0;          // over the common patch, of the worse view
  // On a pipe that touches the plane from behind; absent without a pipe's diameter.
  std::optional<double> seen_arc_mm;   // length of surface across the pipe in both fields
  std::optional<double> sharp_arc_mm;  // the part of it within both depths of field
};

// Two plates of different paths: ones that share an edge, or one of a view and the nearest to it of
// another path.
struct PlateGap {
  std::string first, second;
  double gap_mm = 0;
  bool shared_edge = false;  // they touch where both were cut
};

struct BlockedLight {
  std::string view, plate;
  double percent = 0;  // of the view's rays
};

struct DesignCheck {
  std::string what;
  double value = 0, limit = 0;
  std::string unit;
  bool at_most = true;  // else at least
  bool ok = false;
};

struct RigDesign {
  double numerical_aperture = 0;
  std::vector<ViewDesign> views;
  std::vector<PairDesign> pairs;
  double total_field_mm = 0;             // along the pipe
  std::optional<double> field_gap_mm;    // between neighbouring groups, the smallest
  std::optional<double> base_length_mm;  // between the outermost pairs' centres
  double path_spread_mm = 0;             // longest less shortest path to focus
  std::vector<PlateGap> gaps;            // shared edges, then one per view
  std::vector<BlockedLight> blocked;
  int overlapping_plates = 0;  // pairs of plates that cut each other
  std::vector<MirrorSensitivity> sensitivities;
  std::vector<DesignCheck> checks;

  bool AllHold() const;
};

// Fails (kBadInput) with view, mirror and remedy when a ray of a view does not reach its object,
// and when the rig has no view.
Result<RigDesign> AnalyseRig(const OpticalRig& rig, const DesignOptions& options);

}  // namespace telestrain
