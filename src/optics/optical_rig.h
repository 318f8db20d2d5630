#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "optics/mirror_path.h"

namespace telestrain {

// The instrument as a thing: one camera, and per view the mirrors that bring it to its patch. Array
// frame (x along the pipe), mm.

struct OpticalPath {
  std::string name;
  std::string group;
  std::vector<Mirror> mirrors;   // in the order that light meets them from the lens; may be empty
  Eigen::AlignedBox2d field_mm;  // the view's part of the sensor, image-plane coordinates
  Eigen::Vector3d center_in_array_mm = Eigen::Vector3d::Zero();  // on the field's middle ray
};

struct OpticalRig {
  std::string title;
  PhysicalCamera camera;
  double magnification_px_per_mm = 0;
  double depth_of_field_mm = 0;
  std::vector<OpticalPath> paths;
  std::optional<double> pipe_diameter_mm;
  std::optional<double> needed_field_mm;  // length along the pipe that targets and ruler take
};

// The path's virtual camera.
PhysicalCamera VirtualCamera(const OpticalRig& rig, const OpticalPath& path);
// Way from the plane of camera.position_mm to the plane across the view's axis through its centre:
// there the view is in focus.
double FocusPath_mm(const OpticalRig& rig, const OpticalPath& path);

}  // namespace telestrain
