#include <nlohmann/json.hpp>
#include <numbers>

#include "session/session_record.h"
#include "session/session_rig.h"
#include "viz/results_parts.h"

namespace telestrain::viz {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Two at least: with one there is no grid. No board has more than a thousand.
int GridCount(const JsonNode& node) {
  const int count = node.Count();
  if (count < 2 || count > 1000) node.Fail("a whole number from 2 to 1000 is wanted");
  return count;
}

int SideOf(const JsonNode& node) {
  const int side_px = node.Count();
  if (side_px < 1 || side_px > 100000) node.Fail("a whole number from 1 to 100000 is wanted");
  return side_px;
}

TargetSpec TargetOf(const JsonNode& node) {
  TargetSpec target;
  target.columns = GridCount(node.At("columns"));
  target.rows = GridCount(node.At("rows"));
  target.square_mm = node.At("square_mm").Positive();
  const JsonNode boards = node.At("boards");
  for (int i = 0; i < boards.Size(); ++i) {
    const JsonNode board = boards.At(i);
    target.boards.push_back({board.At("group").Text(), board.At("center_in_target_mm").Vector3(),
                             board.NumberOr("rotation_deg", 0) * kRadiansPerDegree});
  }
  return target;
}

std::vector<PipeGauge> GaugesOf(const JsonNode& list) {
  std::vector<PipeGauge> gauges;
  for (int i = 0; i < list.Size(); ++i) {
    const JsonNode node = list.At(i);
    PipeGauge gauge;
    gauge.column = node.At("column").Text();
    gauge.axial_mm = node.At("axial_mm").Number();
    gauge.angle_rad = node.At("angle_rad").Number();
    gauge.length_mm = node.At("length_mm").Number();
    if (gauge.length_mm < 0) node.At("length_mm").Fail("0 or more is wanted");
    gauges.push_back(gauge);
  }
  return gauges;
}

void ReadAcceptance(const JsonNode& node, RecordedInputs* inputs) {
  const auto limit = [&](const char* key, std::optional<double>* value) {
    if (node.Has(key)) *value = node.At(key).Positive();
  };
  limit("reprojection_rms_px", &inputs->limits.reprojection_rms_px);
  limit("ruler_mpe_um", &inputs->limits.ruler_mpe_um);
  limit("strain_error_microstrain", &inputs->limits.strain_error_microstrain);
  if (node.Has("coverage_factor")) inputs->coverage_factor = node.At("coverage_factor").Positive();
}

// Whether the session gives a camera and every view by mirrors. Their fields are read here to name
// the one that is wrong.
bool HasOptics(const JsonNode& inputs) {
  if (!inputs.Has("camera")) return false;
  const JsonNode camera = inputs.At("camera");
  camera.At("position_mm").Vector3();
  for (const char* key : {"axis", "image_x", "image_y"}) camera.At(key).Direction();
  const JsonNode views = inputs.At("views");
  for (int i = 0; i < views.Size(); ++i) {
    if (!views.At(i).Has("mirrors") || views.At(i).At("mirrors").Size() == 0) return false;
    const JsonNode mirrors = views.At(i).At("mirrors");
    for (int k = 0; k < mirrors.Size(); ++k) {
      mirrors.At(k).At("point_mm").Vector3();
      mirrors.At(k).At("normal").Direction();
    }
  }
  return true;
}

std::optional<OpticalRig> OpticsOf(const nlohmann::ordered_json& inputs) {
  if (!HasOptics(JsonNode(inputs))) return {};
  try {
    auto rig = RigOfSession(SessionOfRecord(inputs));
    if (!rig) throw BadField(rig.error().message);
    return std::move(rig).value();
  } catch (const nlohmann::json::exception& error) {
    throw BadField(std::string("is no whole record of a session: ") + error.what());
  }
}

}  // namespace

RecordedInputs InputsOf(const nlohmann::ordered_json& json) {
  const JsonNode node(json);
  RecordedInputs inputs;
  inputs.target = TargetOf(node.At("target"));
  const JsonNode sensor = node.At("sensor");
  inputs.sensor_px = {SideOf(sensor.At("width_px")), SideOf(sensor.At("height_px"))};
  if (node.Has("acceptance")) ReadAcceptance(node.At("acceptance"), &inputs);
  if (node.Has("pipe")) {
    const JsonNode pipe = node.At("pipe");
    inputs.nominal_radius_mm = 0.5 * pipe.At("outer_diameter_mm").Number();
    if (inputs.nominal_radius_mm < 0) pipe.At("outer_diameter_mm").Fail("0 or more is wanted");
    inputs.gauges = GaugesOf(pipe.At("gauges"));
  }
  inputs.optics = OpticsOf(json);
  return inputs;
}

}  // namespace telestrain::viz
