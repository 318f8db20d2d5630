#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "optics/optical_rig.h"

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

// Residuals of one board in one view.
struct BoardView {
  std::string view;
  int corners = 0;
  double rms_px = 0;
};

// One sub-board of the target in one calibration image.
struct Board {
  std::string image;
  std::string pose;  // poses with the same name differ by a stage move only
  std::string group;
  double stage_mm = 0;
  std::array<Eigen::Vector3d, 4> outline_in_array_mm;      // outer edge of the squares
  std::array<Eigen::Vector3d, 4> corner_grid_in_array_mm;  // outermost inner corners
  std::vector<Eigen::Vector3d> corners_in_array_mm;        // all inner corners, row by row
  double square_mm = 0;
  double rms_px = 0;                  // residual over both coordinates of all views that used it
  std::vector<BoardView> views;       // that used it; empty: all views rejected it
  std::vector<std::string> rejected;  // "A1: the reason" for every view that did not use it
  // Of the board's middle; zero when the calibration states none.
  Eigen::Matrix3d cov_center_in_array_mm2 = Eigen::Matrix3d::Zero();
};

struct RulerPosition {
  std::string image;
  std::array<Eigen::Vector3d, 2> ends_in_array_mm;
  double error_um = 0, expanded_uncertainty_um = 0;
  std::string verdict;  // "pass", "doubt", "fail", "undecided" or empty
};

// A measured quantity with a value at every point.
struct Quantity {
  std::string key;   // as in pipe_NNN.vtp and on the command line: "axial_microstrain"
  std::string name;  // "axial strain"
  std::string unit;  // as printed: "\u00b5\u03b5"; empty for a plain number
};
struct PointValues {
  Quantity quantity;
  std::vector<double> values;  // NaN where a point has none
};

// The measured surface of the pipe in one state; quads index the points.
struct Surface {
  std::vector<Eigen::Vector3d> points_in_array_mm;
  std::vector<Eigen::Vector3d> displacement_mm;  // from the reference state, array frame
  std::vector<double> sigma_um;                  // of a point along the pipe; NaN or empty: none
  std::vector<PointValues> values;               // the first is the axial strain
  std::vector<int> group;                        // per point: index into Scene::Groups()
  std::vector<std::array<int, 4>> quads;

  // Null when there is no such quantity.
  const PointValues* Find(const std::string& key) const;
};

// A strain gauge on the pipe, a small plate that follows the surface.
struct Gauge {
  std::string name;
  Eigen::Vector3d center_in_array_mm = Eigen::Vector3d::Zero();  // on the fitted surface
  Eigen::Vector3d outward_in_array = Eigen::Vector3d::UnitZ();
  double length_mm = 0;  // along the pipe
};

struct PipeState {
  std::string image, cycle, step;
  double axial_microstrain = 0;  // over the long base
  double standard_uncertainty_microstrain = 0;
  // What Scene::pipe's gauges read; empty where none was read.
  std::vector<std::optional<double>> gauge_microstrain;
  std::optional<double> gauge_mean_microstrain;
  Surface surface;
};

struct Pipe {
  Eigen::Vector3d axis_point_in_array_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_in_array = Eigen::Vector3d::UnitX();
  double radius_mm = 0;           // fitted
  double nominal_radius_mm = 0;   // of the session; 0 when it names none
  double stated_diameter_mm = 0;  // as measured, the one that the report states; 0: none
  double base_length_mm = 0;
  std::vector<Gauge> gauges;
  std::vector<PipeState> states;  // empty only for the nominal pipe of a rig
  std::size_t largest_state = 0;  // with the largest absolute long-base strain, the first of equals

  const PipeState& Largest() const { return states[largest_state]; }
  double Diameter_mm() const { return stated_diameter_mm > 0 ? stated_diameter_mm : 2 * radius_mm; }
};

// What the session asks for; absent when it does not.
struct AcceptanceLimits {
  std::optional<double> reprojection_rms_px, ruler_mpe_um, strain_error_microstrain;
};

// A mean residual over a part of the sensor.
struct ResidualCell {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();  // on the sensor
  Eigen::Vector2d mean_px = Eigen::Vector2d::Zero();
  double rms_px = 0;  // over both coordinates
  int corners = 0;    // never 0
};

struct Scene {
  std::vector<ViewVolume> views;
  std::vector<Board> boards;
  int target_poses = 0;
  int rejected_board_views = 0;  // a board in one view of one image, of boards drawn or not
  std::vector<RulerPosition> rulers;
  int rejected_rulers = 0;
  std::optional<Pipe> pipe;
  AcceptanceLimits limits;
  Eigen::Vector2i sensor_px = Eigen::Vector2i::Zero();
  std::vector<Eigen::Vector4i> view_regions_px;  // left, top, width, height; as `views`
  std::vector<ResidualCell> residual_cells;      // 12 x 9 in every view's region
  std::optional<OpticalRig> optics;              // when the session gives the mirrors
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
