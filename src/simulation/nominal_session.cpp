#include "simulation/nominal_session.h"

#include <cmath>
#include <numbers>

namespace telestrain {
namespace {

constexpr double kPixelPitch_um = 2.2;     // the paper's camera
constexpr double kMagnification = 0.5;     // the paper's lens
constexpr double kGroupCenter_mm = 13.85;  // half the distance of the two fields
constexpr double kMirrorHeight_mm = 40.0;  // of the folding mirrors above the pipe
constexpr double kCameraHeight_mm = 80.0;  // a point on the lens axis, above the mirrors
constexpr double kHalfStereoAngle_deg = 30.0;
constexpr double kRulerSquare_mm = 0.6;

SensorSpec NominalSensor(int binning) {
  return {2592 / binning, 1944 / binning, kPixelPitch_um * binning};
}

// The three mirrors of one path; `group_side` and `view_side` are the signs of x and y.
std::vector<Mirror> PathMirrors(const Eigen::Vector2d& quadrant_mm, double group_side,
                                double view_side) {
  const double angle = kHalfStereoAngle_deg * std::numbers::pi / 180.0;
  const double x_mm = group_side * kGroupCenter_mm;
  const double y_mm = view_side * quadrant_mm.x();
  const double height_mm = kMirrorHeight_mm;
  const double half_root = std::sqrt(0.5);
  const double last_y_mm = view_side * height_mm * std::tan(angle);
  // The last mirror turns the direction (0, side, 0) into (0, -side sin, -cos).
  const Eigen::Vector3d turn(0, -view_side * (1 + std::sin(angle)), -std::cos(angle));
  return {{{group_side * quadrant_mm.y(), y_mm, height_mm}, {group_side * half_root, 0, half_root}},
          {{x_mm, y_mm, height_mm}, {-group_side * half_root, view_side * half_root, 0}},
          {{x_mm, last_y_mm, height_mm}, turn.normalized()}};
}

// Reflections leave -0 and rounding of the last digit behind; a drawing has neither.
Eigen::Vector3d Tidy(const Eigen::Vector3d& vector) {
  return (vector * 1e12).array().round().matrix() / 1e12 + Eigen::Vector3d::Zero();
}

NominalView MakeView(const Session& session, int group_index, int view_index) {
  const double group_side = group_index == 0 ? -1 : 1;
  const double view_side = view_index == 0 ? -1 : 1;
  const int width = session.sensor.width_px / 2, height = session.sensor.height_px / 2;
  const Eigen::Vector2d quadrant_mm =
      Eigen::Vector2d(width, height) / 2 / session.NominalMagnification_px_per_mm();
  NominalView view;
  constexpr char kNames[2][2][3] = {{"A1", "A2"}, {"B1", "B2"}};
  view.group = std::string(kNames[group_index][view_index], 1);
  view.name = kNames[group_index][view_index];
  view.region = {view_index * width, group_index * height, width, height};
  view.mirrors = PathMirrors(quadrant_mm, group_side, view_side);
  const PhysicalCamera camera = ReflectCamera(*session.camera, view.mirrors);
  view.image_x_in_array = Tidy(camera.image_x);
  view.image_y_in_array = Tidy(camera.image_y);
  view.axis_in_array = Tidy(camera.axis);
  view.center_in_array_mm = {group_side * kGroupCenter_mm, 0, 0};
  return view;
}

TargetSpec NominalTarget() {
  TargetSpec target;
  target.columns = 13;
  target.rows = 9;
  target.square_mm = 0.3;
  target.sigma_square_um = 0.05;
  target.sigma_separation_um = 0.25;
  target.coplanarity_um = 0.5;
  target.boards = {{"A", {-kGroupCenter_mm, 0, 0}, 0}, {"B", {kGroupCenter_mm, 0, 0}, 0}};
  return target;
}

// Four gauges in the middle of the pipe, 90 degrees apart, which read thermal expansion too; the
// expansion is told only where the pipe warms.
PipeSpec NominalPipe(const VirtualExperimentOptions& options) {
  PipeSpec pipe{options.pipe_diameter_mm, 0.31, "TA18 titanium tube"};
  if (options.temperature_change_k != 0)
    pipe.thermal_expansion_per_k = 1e-6 * options.expansion_ppm_per_k;
  for (int gauge = 0; gauge < 4 && options.gauges && options.pipe_states > 0; ++gauge) {
    PipeGauge& added = pipe.gauges.emplace_back();
    added.column = "gauge_" + std::to_string(gauge + 1) + "_microstrain";
    added.angle_rad = 0.5 * gauge * std::numbers::pi;
    added.sigma_microstrain = options.gauge_sigma_microstrain;
    added.reads_thermal_strain = true;
  }
  return pipe;
}

// Limits only for what is recorded: one that cannot be decided is not passed.
AcceptanceSpec NominalAcceptance(const VirtualExperimentOptions& options) {
  AcceptanceSpec acceptance;
  acceptance.reprojection_rms_px = 0.1;
  if (options.ruler_images > 0) acceptance.ruler_mpe_um = 3.0;
  if (options.pipe_states > 1) acceptance.strain_error_microstrain = 20.0;
  return acceptance;
}

std::map<std::string, std::string> NominalDocument(const VirtualExperimentOptions& options) {
  std::map<std::string, std::string> document = {
      {"report_number", std::string("VE-").append(std::to_string(options.seed))},
      {"revision", "1"},
      {"laboratory", "Virtual laboratory"},
      {"customer", "None: a virtual experiment"},
      {"item", "Virtual telecentric four-view array"},
      {"condition", "As simulated"},
      {"place", "None: simulated images"},
      {"operator", "telestrain simulate"},
      {"environment", "Simulated, 20 °C"},
      {"target_certificate", "None: simulated target"},
      {"ruler_certificate", "None: simulated ruler"}};
  for (const auto& [key, text] : options.document) document[key] = text;
  return document;
}

}  // namespace

Session NominalSession(const VirtualExperimentOptions& options) {
  Session session;
  session.title = "Virtual experiment, seed " + std::to_string(options.seed);
  session.sensor = NominalSensor(options.binning);
  session.lens_magnification = kMagnification;
  session.depth_of_field_mm = 3.1;
  session.camera = PhysicalCamera{{0, 0, kCameraHeight_mm},
                                  -Eigen::Vector3d::UnitZ(),
                                  Eigen::Vector3d::UnitY(),
                                  Eigen::Vector3d::UnitX()};
  for (const int group : {0, 1})
    for (const int view : {0, 1}) session.views.push_back(MakeView(session, group, view));
  session.target = NominalTarget();
  session.ruler = {27.6, 0.25};
  session.pipe = NominalPipe(options);
  session.acceptance = NominalAcceptance(options);
  session.document = NominalDocument(options);
  if (options.mirrors) return session;
  session.camera.reset();
  for (NominalView& view : session.views) view.mirrors.clear();
  return session;
}

TargetSpec RulerAsTarget(const TargetSpec& target, double length_mm) {
  TargetSpec ruler;
  ruler.columns = 1;
  ruler.rows = 1;
  ruler.square_mm = kRulerSquare_mm;
  ruler.boards = target.boards;
  for (SubBoard& board : ruler.boards) {
    const double side = board.center_in_target_mm.x() < 0 ? -1 : 1;
    board.center_in_target_mm = {0.5 * side * length_mm, 0, 0};
    board.rotation_rad = 0;
  }
  return ruler;
}

}  // namespace telestrain
