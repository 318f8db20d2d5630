#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "optics/telecentric_view.h"

namespace telestrain {

// The content of a session folder (session-format.md, version 1): what was recorded, with which
// instrument, artefacts and limits. Lengths in mm, pixels with (0,0) the centre of the first one.

struct PixelRegion {
  int x = 0, y = 0, width = 0, height = 0;
  // Pixel coordinates of the middle of the region.
  Eigen::Vector2d Middle() const { return {x + 0.5 * (width - 1), y + 0.5 * (height - 1)}; }
};

struct SensorSpec {
  int width_px = 0, height_px = 0;
  double pixel_pitch_um = 0;
  Eigen::Vector2d Middle() const { return {0.5 * (width_px - 1), 0.5 * (height_px - 1)}; }
};

// A virtual camera as designed: a start for the calibration, right to a degree and some tenths of
// a millimetre.
struct NominalView {
  std::string name;
  std::string group;
  PixelRegion region;
  Eigen::Vector3d image_x_in_array = Eigen::Vector3d::UnitX();
  Eigen::Vector3d image_y_in_array = Eigen::Vector3d::UnitY();
  Eigen::Vector3d axis_in_array = Eigen::Vector3d::UnitZ();  // from the camera to the object
  Eigen::Vector3d center_in_array_mm = Eigen::Vector3d::Zero();
  std::vector<Mirror> mirrors;  // in the order that light meets them from the lens; may be empty
};

struct SubBoard {
  std::string group;
  Eigen::Vector3d center_in_target_mm = Eigen::Vector3d::Zero();  // middle of the corner grid
  double rotation_rad = 0;  // about the target's normal (file: rotation_deg)
};

struct TargetSpec {
  int columns = 0, rows = 0;  // inner corners along the board's x and y
  double square_mm = 0;
  // Standard uncertainty of the position of a corner relative to its board (accuracy of the mask
  // writer); the mean pitch is uncertain by this / (square * (columns - 1)).
  double sigma_square_um = 0;
  double sigma_separation_um = 0;  // standard uncertainty of the distance between the sub-boards
  // Half-width of the rectangular distribution of the height difference between the sub-boards.
  double coplanarity_um = 0;
  // Standard uncertainty of how far a sub-board's middle stands above its ends, along x and along
  // y: the boards bend by themselves.
  double flatness_um = 0;
  std::vector<SubBoard> boards;

  int CornerCount() const { return columns * rows; }
  // 3 x (columns rows), x running fastest, in the target frame (mm).
  Eigen::Matrix3Xd CornersInTarget(const SubBoard& board) const;
  const SubBoard* FindBoard(const std::string& group) const;
};

struct RulerSpec {
  double length_mm = 0;
  double sigma_length_um = 0;
};

// A strain gauge glued to the pipe along its axis.
struct PipeGauge {
  std::string column;    // of pipe.csv
  double axial_mm = 0;   // of its middle, from the array's origin towards the array's x
  double angle_rad = 0;  // about the pipe's axis: 0 faces the instrument, pi/2 the array's y
  double length_mm = 0;  // of its grid; 0: a point
  double sigma_microstrain = 0;  // standard uncertainty of its reading
  double sigma_angle_rad = 0;    // of the angle at which it is glued
  // It reads the free thermal expansion too; else it is compensated for the pipe's material.
  bool reads_thermal_strain = false;
  bool operator==(const PipeGauge&) const = default;
};

struct PipeSpec {
  double outer_diameter_mm = 0;
  double poisson_ratio = 0;
  std::string material;
  double thermal_expansion_per_k = 0;        // 0: not known, nothing is compensated
  double sigma_thermal_expansion_per_k = 0;  // standard uncertainties
  double sigma_temperature_k = 0;            // of one reading of temperature_c
  std::vector<PipeGauge> gauges = {};        // those whose place is known
  // Standard uncertainty of one reading of one strain gauge.
  std::optional<double> sigma_gauge_microstrain = {};
};

enum class DecisionRule { kGuarded, kSimple };

// Limits; one that is absent is not decided.
struct AcceptanceSpec {
  std::optional<double> reprojection_rms_px;
  std::optional<double> ruler_mpe_um;
  std::optional<double> strain_error_microstrain;
  double coverage_factor = 2.0;
  DecisionRule decision_rule = DecisionRule::kGuarded;
};

struct CalibrationImage {
  std::string image;  // path inside the session folder
  std::string pose;
  double stage_mm = 0;
};

struct PipeState {
  std::string image;
  std::string cycle;
  std::string step;
  std::optional<double> time_s;
  std::vector<std::optional<double>> gauges_microstrain;  // one per gauge column, in order
  std::optional<double> temperature_c = {};
};

struct Session {
  std::filesystem::path folder;
  std::string title;
  SensorSpec sensor;
  double lens_magnification = 0;  // nominal, image size / object size
  double depth_of_field_mm = 0;
  std::optional<PhysicalCamera> camera;  // when the views are given by mirrors
  std::vector<NominalView> views;
  // Of positive stage_mm; unit, within 60 degrees of the array's z or of its opposite.
  Eigen::Vector3d stage_axis_in_array = Eigen::Vector3d::UnitZ();
  double stage_sigma_mm = 0.005;
  TargetSpec target;
  RulerSpec ruler;
  PipeSpec pipe;
  AcceptanceSpec acceptance;
  std::map<std::string, std::string> document;  // free texts for the report

  std::vector<CalibrationImage> calibration_images;
  // The corners of the target come from a file; the calibration images need not be there.
  bool corners_are_given = false;
  std::vector<std::string> ruler_images;
  std::vector<std::string> gauge_columns;  // names of the gauge columns of pipe.csv
  std::vector<PipeState> pipe_states;      // the first one is the reference state

  double NominalMagnification_px_per_mm() const {
    return 1000.0 * lens_magnification / sensor.pixel_pitch_um;
  }
  // The lens without distortion, its centre in the middle of the sensor.
  TelecentricLens NominalLens() const;
  TelecentricView NominalTelecentricView(const NominalView& view) const;
  // Groups in the order in which the views name them.
  std::vector<std::string> Groups() const;
};

// Whether [document] may say this: any text, but a date after ISO 8601 or nothing under the keys
// that other programs read as one.
bool IsDocumentEntry(const std::string& key, const std::string& text);

// Reads and checks session.toml, calibration.csv, ruler.csv and pipe.csv, and that every image is
// there (those of the target only unless their corners are given). Does not decode images. Fails
// (kBadInput) with file, line, what was found and the remedy.
Result<Session> ReadSession(const std::filesystem::path& folder, bool corners_are_given = false);

// Writes session.toml and the three tables (not the images) into `folder`. Reading them again
// gives an equal session.
Status WriteSession(const Session& session, const std::filesystem::path& folder);

}  // namespace telestrain
