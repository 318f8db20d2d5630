#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace telestrain::viz {

// What the pictures show, free of any graphics library. All points and directions are in the array
// frame (x along the pipe), lengths in mm.

// The part of space that one telecentric view measures in: its rays are parallel, so the region of
// its pixels cuts the same rectangle out of every plane across the axis, and there is no apex.
struct ViewVolume {
  std::string name;
  std::string group;
  Eigen::Vector3d center_in_array_mm = Eigen::Vector3d::Zero();  // middle of region and focus
  Eigen::Vector3d axis_in_array = -Eigen::Vector3d::UnitZ();     // from the camera to the object
  Eigen::Vector3d image_x_in_array = Eigen::Vector3d::UnitX();   // u grows
  Eigen::Vector3d image_y_in_array = Eigen::Vector3d::UnitY();   // v grows
  double width_mm = 0, height_mm = 0;                            // region / magnification
  double depth_of_field_mm = 0;

  // Corners of the cross-section `along_axis_mm` behind the centre (negative: nearer the camera),
  // in the order (-u,-v), (+u,-v), (+u,+v), (-u,+v); the first is the region's first pixel.
  std::array<Eigen::Vector3d, 4> Section(double along_axis_mm) const;

  // Whether the point is imaged inside the region and lies in the depth of field.
  bool Contains(const Eigen::Vector3d& point_in_array_mm) const;
};

// One sub-board of the target in one calibration image.
struct Board {
  std::string image;
  std::string group;
  std::array<Eigen::Vector3d, 4> outline_in_array_mm;      // outer edge of the squares
  std::array<Eigen::Vector3d, 4> corner_grid_in_array_mm;  // outermost inner corners
  double rms_px = 0;  // residual over both coordinates of all views that used it
  int views = 0;      // how many views used it
};

struct RulerPosition {
  std::string image;
  std::array<Eigen::Vector3d, 2> ends_in_array_mm;
};

// The measured surface of the pipe in one state; quads index the points.
struct Surface {
  std::vector<Eigen::Vector3d> points_in_array_mm;
  std::vector<double> axial_microstrain;
  std::vector<int> group;  // per point: index into Scene::Groups()
  std::vector<std::array<int, 4>> quads;
};

struct Pipe {
  Eigen::Vector3d axis_point_in_array_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_in_array = Eigen::Vector3d::UnitX();
  double radius_mm = 0;
  double base_length_mm = 0;
  // The state with the largest absolute long-base strain.
  std::string cycle, step;
  double axial_microstrain = 0;
  double standard_uncertainty_microstrain = 0;
  std::array<double, 2> local_microstrain{};
  Surface surface;
};

struct Scene {
  std::vector<ViewVolume> views;
  std::vector<Board> boards;
  int target_poses = 0;
  int rejected_board_views = 0;  // a board in one view of one image
  std::vector<RulerPosition> rulers;
  int rejected_rulers = 0;
  std::optional<Pipe> pipe;
  double magnification_px_per_mm = 0;
  double reprojection_rms_px = 0;
  double coverage_factor = 2;

  // Groups in the order in which the views name them.
  std::vector<std::string> Groups() const;
};

// Right-handed directions to look at a scene with: along the pipe (x), towards the instrument and
// across. The array's z may point either way, the picture's `up` always points to the cameras.
struct SceneAxes {
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  Eigen::Vector3d across = Eigen::Vector3d::UnitY();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};
SceneAxes AxesOf(const Scene& scene);

}  // namespace telestrain::viz
