#include "session/session_record.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "session/session_parts.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

Json ArrayOf(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

Eigen::Vector3d VectorOf(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

// A whole number within the limits that session.toml has too: sizes of images and lists are made of
// it. Throws nlohmann::json::out_of_range.
int WholeOf(const Json& json, int least, int most) {
  const double value = json.get<double>();
  if (value >= least && value <= most && std::floor(value) == value) return static_cast<int>(value);
  throw Json::out_of_range::create(401,
                                   json.dump() + " is no whole number from " +
                                       std::to_string(least) + " to " + std::to_string(most),
                                   &json);
}

Json CameraJson(const PhysicalCamera& camera) {
  return {{"position_mm", ArrayOf(camera.position_mm)},
          {"axis", ArrayOf(camera.axis)},
          {"image_x", ArrayOf(camera.image_x)},
          {"image_y", ArrayOf(camera.image_y)}};
}

PhysicalCamera CameraOf(const Json& json) {
  return {VectorOf(json.at("position_mm")), VectorOf(json.at("axis")), VectorOf(json.at("image_x")),
          VectorOf(json.at("image_y"))};
}

Json MirrorsJson(const std::vector<Mirror>& mirrors) {
  Json json = Json::array();
  for (const Mirror& mirror : mirrors)
    json.push_back({{"point_mm", ArrayOf(mirror.point_mm)}, {"normal", ArrayOf(mirror.normal)}});
  return json;
}

std::vector<Mirror> MirrorsOf(const Json& json) {
  std::vector<Mirror> mirrors;
  for (const Json& mirror : json)
    mirrors.push_back({VectorOf(mirror.at("point_mm")), VectorOf(mirror.at("normal"))});
  return mirrors;
}

Json ViewsJson(const Session& session) {
  Json views = Json::array();
  for (const NominalView& view : session.views) {
    const PixelRegion& r = view.region;
    views.push_back({{"name", view.name},
                     {"group", view.group},
                     {"region_px", {r.x, r.y, r.width, r.height}},
                     {"image_x_in_array", ArrayOf(view.image_x_in_array)},
                     {"image_y_in_array", ArrayOf(view.image_y_in_array)},
                     {"axis_in_array", ArrayOf(view.axis_in_array)},
                     {"center_in_array_mm", ArrayOf(view.center_in_array_mm)}});
    if (!view.mirrors.empty()) views.back()["mirrors"] = MirrorsJson(view.mirrors);
  }
  return views;
}

NominalView ViewOf(const Json& json) {
  NominalView view;
  view.name = json.at("name").get<std::string>();
  view.group = json.at("group").get<std::string>();
  const Json& region = json.at("region_px");
  view.region = {
      WholeOf(region.at(0), 0, kLargestSensor_px), WholeOf(region.at(1), 0, kLargestSensor_px),
      WholeOf(region.at(2), 0, kLargestSensor_px), WholeOf(region.at(3), 0, kLargestSensor_px)};
  view.image_x_in_array = VectorOf(json.at("image_x_in_array"));
  view.image_y_in_array = VectorOf(json.at("image_y_in_array"));
  view.axis_in_array = VectorOf(json.at("axis_in_array"));
  view.center_in_array_mm = VectorOf(json.at("center_in_array_mm"));
  if (json.contains("mirrors")) view.mirrors = MirrorsOf(json.at("mirrors"));
  return view;
}

Json TargetJson(const TargetSpec& target) {
  Json boards = Json::array();
  for (const SubBoard& board : target.boards)
    boards.push_back({{"group", board.group},
                      {"center_in_target_mm", ArrayOf(board.center_in_target_mm)},
                      {"rotation_deg", board.rotation_rad * kDegreesPerRadian}});
  return {{"columns", target.columns},
          {"rows", target.rows},
          {"square_mm", target.square_mm},
          {"sigma_square_um", target.sigma_square_um},
          {"sigma_separation_um", target.sigma_separation_um},
          {"coplanarity_um", target.coplanarity_um},
          {"flatness_um", target.flatness_um},
          {"boards", boards}};
}

TargetSpec TargetOf(const Json& json) {
  TargetSpec target;
  target.columns = WholeOf(json.at("columns"), kFewestCorners, kMostCorners);
  target.rows = WholeOf(json.at("rows"), kFewestCorners, kMostCorners);
  target.square_mm = json.at("square_mm").get<double>();
  target.sigma_square_um = json.at("sigma_square_um").get<double>();
  target.sigma_separation_um = json.at("sigma_separation_um").get<double>();
  target.coplanarity_um = json.at("coplanarity_um").get<double>();
  target.flatness_um = json.at("flatness_um").get<double>();
  for (const Json& board : json.at("boards"))
    target.boards.push_back({board.at("group").get<std::string>(),
                             VectorOf(board.at("center_in_target_mm")),
                             board.at("rotation_deg").get<double>() / kDegreesPerRadian});
  return target;
}

Json AcceptanceJson(const AcceptanceSpec& acceptance) {
  Json json = Json::object();
  if (acceptance.reprojection_rms_px) json["reprojection_rms_px"] = *acceptance.reprojection_rms_px;
  if (acceptance.ruler_mpe_um) json["ruler_mpe_um"] = *acceptance.ruler_mpe_um;
  if (acceptance.strain_error_microstrain)
    json["strain_error_microstrain"] = *acceptance.strain_error_microstrain;
  json["coverage_factor"] = acceptance.coverage_factor;
  json["decision_rule"] = acceptance.decision_rule == DecisionRule::kGuarded ? "guarded" : "simple";
  return json;
}

AcceptanceSpec AcceptanceOf(const Json& json) {
  AcceptanceSpec acceptance;
  const auto limit = [&](const char* key, std::optional<double>& value) {
    if (json.contains(key)) value = json.at(key).get<double>();
  };
  limit("reprojection_rms_px", acceptance.reprojection_rms_px);
  limit("ruler_mpe_um", acceptance.ruler_mpe_um);
  limit("strain_error_microstrain", acceptance.strain_error_microstrain);
  acceptance.coverage_factor = json.at("coverage_factor").get<double>();
  if (json.at("decision_rule") == "simple") acceptance.decision_rule = DecisionRule::kSimple;
  return acceptance;
}

Json GaugesJson(const std::vector<PipeGauge>& gauges) {
  Json json = Json::array();
  for (const PipeGauge& gauge : gauges)
    json.push_back({{"column", gauge.column},
                    {"axial_mm", gauge.axial_mm},
                    {"angle_rad", gauge.angle_rad},
                    {"length_mm", gauge.length_mm},
                    {"sigma_microstrain", gauge.sigma_microstrain},
                    {"sigma_angle_rad", gauge.sigma_angle_rad},
                    {"reads_thermal_strain", gauge.reads_thermal_strain}});
  return json;
}

std::vector<PipeGauge> GaugesOf(const Json& json) {
  std::vector<PipeGauge> gauges;
  for (const Json& gauge : json)
    gauges.push_back({gauge.at("column").get<std::string>(), gauge.at("axial_mm").get<double>(),
                      gauge.at("angle_rad").get<double>(), gauge.at("length_mm").get<double>(),
                      gauge.at("sigma_microstrain").get<double>(),
                      gauge.at("sigma_angle_rad").get<double>(),
                      gauge.at("reads_thermal_strain").get<bool>()});
  return gauges;
}

Json PipeJson(const PipeSpec& pipe) {
  Json json{{"outer_diameter_mm", pipe.outer_diameter_mm},
            {"poisson_ratio", pipe.poisson_ratio},
            {"material", pipe.material},
            {"thermal_expansion_per_k", pipe.thermal_expansion_per_k},
            {"sigma_thermal_expansion_per_k", pipe.sigma_thermal_expansion_per_k},
            {"sigma_temperature_k", pipe.sigma_temperature_k},
            {"gauges", GaugesJson(pipe.gauges)}};
  if (pipe.sigma_gauge_microstrain) json["sigma_gauge_microstrain"] = *pipe.sigma_gauge_microstrain;
  return json;
}

PipeSpec PipeOf(const Json& json) {
  PipeSpec pipe;
  pipe.outer_diameter_mm = json.at("outer_diameter_mm").get<double>();
  pipe.poisson_ratio = json.at("poisson_ratio").get<double>();
  pipe.material = json.at("material").get<std::string>();
  pipe.thermal_expansion_per_k = json.at("thermal_expansion_per_k").get<double>();
  pipe.sigma_thermal_expansion_per_k = json.at("sigma_thermal_expansion_per_k").get<double>();
  pipe.sigma_temperature_k = json.at("sigma_temperature_k").get<double>();
  pipe.gauges = GaugesOf(json.at("gauges"));
  if (json.contains("sigma_gauge_microstrain"))
    pipe.sigma_gauge_microstrain = json.at("sigma_gauge_microstrain").get<double>();
  return pipe;
}

Json CalibrationImagesJson(const Session& session) {
  Json images = Json::array();
  for (const CalibrationImage& image : session.calibration_images)
    images.push_back({{"image", image.image}, {"pose", image.pose}, {"stage_mm", image.stage_mm}});
  return images;
}

}  // namespace

Json SessionRecord(const Session& session) {
  Json record{{"title", session.title},
              {"document", session.document},
              {"sensor",
               {{"width_px", session.sensor.width_px},
                {"height_px", session.sensor.height_px},
                {"pixel_pitch_um", session.sensor.pixel_pitch_um}}},
              {"lens",
               {{"magnification", session.lens_magnification},
                {"depth_of_field_mm", session.depth_of_field_mm}}},
              {"views", ViewsJson(session)},
              {"stage",
               {{"axis_in_array", ArrayOf(session.stage_axis_in_array)},
                {"sigma_mm", session.stage_sigma_mm}}},
              {"target", TargetJson(session.target)},
              {"ruler",
               {{"length_mm", session.ruler.length_mm},
                {"sigma_length_um", session.ruler.sigma_length_um}}},
              {"pipe", PipeJson(session.pipe)},
              {"acceptance", AcceptanceJson(session.acceptance)},
              {"calibration_images", CalibrationImagesJson(session)},
              {"ruler_images", session.ruler_images},
              {"counts",
               {{"calibration_images", session.calibration_images.size()},
                {"ruler_images", session.ruler_images.size()},
                {"pipe_images", session.pipe_states.size()}}}};
  if (session.camera) record["camera"] = CameraJson(*session.camera);
  return record;
}

Session SessionOfRecord(const Json& record) {
  Session session;
  session.title = record.at("title").get<std::string>();
  session.document = record.at("document").get<std::map<std::string, std::string>>();
  const Json& sensor = record.at("sensor");
  session.sensor = {WholeOf(sensor.at("width_px"), 1, kLargestSensor_px),
                    WholeOf(sensor.at("height_px"), 1, kLargestSensor_px),
                    sensor.at("pixel_pitch_um").get<double>()};
  session.lens_magnification = record.at("lens").at("magnification").get<double>();
  session.depth_of_field_mm = record.at("lens").at("depth_of_field_mm").get<double>();
  if (record.contains("camera")) session.camera = CameraOf(record.at("camera"));
  for (const Json& view : record.at("views")) session.views.push_back(ViewOf(view));
  session.stage_axis_in_array = VectorOf(record.at("stage").at("axis_in_array"));
  session.stage_sigma_mm = record.at("stage").at("sigma_mm").get<double>();
  session.target = TargetOf(record.at("target"));
  const Json& ruler = record.at("ruler");
  session.ruler = {ruler.at("length_mm").get<double>(), ruler.at("sigma_length_um").get<double>()};
  session.pipe = PipeOf(record.at("pipe"));
  session.acceptance = AcceptanceOf(record.at("acceptance"));
  for (const Json& image : record.at("calibration_images"))
    session.calibration_images.push_back({image.at("image").get<std::string>(),
                                          image.at("pose").get<std::string>(),
                                          image.at("stage_mm").get<double>()});
  session.ruler_images = record.at("ruler_images").get<std::vector<std::string>>();
  return session;
}

}  // namespace telestrain
