#include "viz/scene_from_results.h"

#include <nlohmann/json.hpp>

#include "base/json_file.h"
#include "viz/results_parts.h"

namespace telestrain::viz {
namespace {

constexpr const char* kCalibrate = "telestrain calibrate";
constexpr const char* kDetect = "telestrain detect";
constexpr const char* kVerify = "telestrain verify";

Status AddRulersOf(const std::filesystem::path& results, Scene* scene) {
  const auto path = results / "ruler.json";
  if (!std::filesystem::exists(path)) return {};
  TELESTRAIN_ASSIGN_OR_RETURN(const auto ruler, ReadJson(path, "telestrain.ruler/1", kVerify));
  return ReadFields(path, kVerify, [&] { AddRulers(JsonNode(ruler), scene); });
}

}  // namespace

Status ReadFields(const std::filesystem::path& path, const std::string& maker,
                  const std::function<void()>& read) {
  try {
    read();
  } catch (const BadField& bad) {
    return BadInput(path.string() + ": " + bad.what() + "; make the file again with '" + maker +
                    "'");
  }
  return {};
}

void AddViews(const JsonNode& calibration, Scene* scene) {
  const double px_per_mm = calibration.At("lens").At("magnification_px_per_mm").Positive();
  scene->magnification_px_per_mm = px_per_mm;
  scene->reprojection_rms_px = calibration.At("reprojection").At("rms_px").Number();
  const JsonNode list = calibration.At("views");
  for (int i = 0; i < list.Size(); ++i) {
    const JsonNode node = list.At(i);
    const JsonNode region = node.At("region_px");
    ViewVolume view;
    view.name = node.At("name").Text();
    view.group = node.At("group").Text();
    view.center_in_array_mm = node.At("center_in_array_mm").Vector3();
    view.axis_in_array = node.At("axis_in_array").Direction();
    view.image_x_in_array = node.At("image_x_in_array").Direction();
    view.image_y_in_array = node.At("image_y_in_array").Direction();
    view.width_mm = region.At(2).Positive() / px_per_mm;
    view.height_mm = region.At(3).Positive() / px_per_mm;
    view.depth_of_field_mm = node.At("depth_of_field_mm").Positive();
    scene->views.push_back(view);
    scene->view_regions_px.emplace_back(region.At(0).Count(), region.At(1).Count(),
                                        region.At(2).Count(), region.At(3).Count());
  }
  if (scene->views.empty()) throw BadField("views: at least one view is wanted, found none");
}

Result<Scene> SceneFromResults(const std::filesystem::path& results) {
  const auto calibration_path = results / "calibration.json";
  const auto inputs_path = results / "inputs.json";
  TELESTRAIN_ASSIGN_OR_RETURN(const auto calibration,
                              ReadJson(calibration_path, "telestrain.calibration/1", kCalibrate));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto record,
                              ReadJson(inputs_path, "telestrain.inputs/1", kDetect));
  RecordedInputs inputs;
  TELESTRAIN_RETURN_IF_ERROR(ReadFields(inputs_path, kDetect, [&] { inputs = InputsOf(record); }));
  Scene scene;
  scene.limits = inputs.limits;
  scene.coverage_factor = inputs.coverage_factor;
  scene.sensor_px = inputs.sensor_px;
  scene.optics = inputs.optics;
  TELESTRAIN_RETURN_IF_ERROR(ReadFields(calibration_path, kCalibrate, [&] {
    AddViews(JsonNode(calibration), &scene);
    AddBoards(JsonNode(calibration), inputs.target, &scene);
  }));
  TELESTRAIN_RETURN_IF_ERROR(AddRulersOf(results, &scene));
  TELESTRAIN_ASSIGN_OR_RETURN(scene.residual_cells, ResidualCellsOf(results, scene));
  const auto group_count = static_cast<int>(scene.Groups().size());
  TELESTRAIN_ASSIGN_OR_RETURN(scene.pipe, PipeFromResults(results, inputs, group_count));
  return scene;
}

}  // namespace telestrain::viz
