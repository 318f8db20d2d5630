#include "viz/scene_from_results.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/json_file.h"
#include "viz/scene/json_node.h"

namespace telestrain::viz {
namespace {

using std::numbers::pi;

// One sub-board as printed, in the target frame.
struct PrintedBoard {
  std::string group;
  Eigen::Vector3d center_in_target_mm;
  double rotation_rad = 0;
  Eigen::Vector2d grid_half_mm;  // from the middle to the outermost inner corner
  double square_mm = 0;

  // A rectangle about the middle, counter-clockwise in the target frame.
  std::array<Eigen::Vector3d, 4> Rectangle(const Eigen::Vector2d& half_mm) const {
    const Eigen::AngleAxisd turn(rotation_rad, Eigen::Vector3d::UnitZ());
    const auto corner = [&](double sx, double sy) -> Eigen::Vector3d {
      return center_in_target_mm + turn * Eigen::Vector3d(sx * half_mm.x(), sy * half_mm.y(), 0);
    };
    return {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
  }
};

std::vector<PrintedBoard> ReadPrintedBoards(const JsonNode& target) {
  std::vector<PrintedBoard> boards;
  const double square_mm = target.At("square_mm").Positive();
  const Eigen::Vector2d grid_half_mm(0.5 * square_mm * (target.At("columns").Positive() - 1),
                                     0.5 * square_mm * (target.At("rows").Positive() - 1));
  const JsonNode list = target.At("boards");
  for (int i = 0; i < list.Size(); ++i) {
    const JsonNode node = list.At(i);
    const double rotation_deg = node.Has("rotation_deg") ? node.At("rotation_deg").Number() : 0;
    boards.push_back({node.At("group").Text(), node.At("center_in_target_mm").Vector3(),
                      rotation_deg * pi / 180, grid_half_mm, square_mm});
  }
  return boards;
}

void ReadViews(const JsonNode& calibration, Scene* scene) {
  const double px_per_mm = calibration.At("lens").At("magnification_px_per_mm").Positive();
  scene->magnification_px_per_mm = px_per_mm;
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
  }
  if (scene->views.empty()) throw BadField("views: at least one view is wanted, found none");
}

// Residuals of the views of one group in one image.
struct GroupResidual {
  double sum_px2 = 0;
  int corners = 0;
};

std::map<std::string, GroupResidual> ReadResiduals(const JsonNode& pose, const Scene& scene) {
  std::map<std::string, std::string> group_of_view;
  for (const ViewVolume& view : scene.views) group_of_view[view.name] = view.group;
  std::map<std::string, GroupResidual> residuals;
  const JsonNode list = pose.At("boards");
  for (int i = 0; i < list.Size(); ++i) {
    const JsonNode node = list.At(i);
    const auto view = group_of_view.find(node.At("view").Text());
    if (view == group_of_view.end())
      throw BadField("poses: view '" + node.At("view").Text() + "' is not among the views");
    GroupResidual& residual = residuals[view->second];
    const int corners = node.At("corners").Count();
    residual.sum_px2 += corners * std::pow(node.At("rms_px").Number(), 2);
    residual.corners += corners;
  }
  return residuals;
}

void ReadPose(const JsonNode& pose, const std::vector<PrintedBoard>& printed, Scene* scene) {
  const Eigen::Matrix3d array_from_target = pose.At("rotation_array_from_target").Rotation();
  const Eigen::Vector3d origin_in_array_mm = pose.At("origin_in_array_mm").Vector3();
  const auto residuals = ReadResiduals(pose, *scene);
  for (const PrintedBoard& print : printed) {
    const auto residual = residuals.find(print.group);
    if (residual == residuals.end() || residual->second.corners == 0) continue;
    Board board;
    board.image = pose.At("image").Text();
    board.group = print.group;
    board.rms_px = std::sqrt(residual->second.sum_px2 / residual->second.corners);
    const Eigen::Vector2d margin_mm = Eigen::Vector2d::Constant(print.square_mm);
    board.outline_in_array_mm = print.Rectangle(print.grid_half_mm + margin_mm);
    board.corner_grid_in_array_mm = print.Rectangle(print.grid_half_mm);
    for (auto* rectangle : {&board.outline_in_array_mm, &board.corner_grid_in_array_mm})
      for (Eigen::Vector3d& point : *rectangle)
        point = array_from_target * point + origin_in_array_mm;
    scene->boards.push_back(board);
  }
}

void ReadCalibration(const JsonNode& calibration, const JsonNode& inputs, Scene* scene) {
  ReadViews(calibration, scene);
  const std::vector<PrintedBoard> printed = ReadPrintedBoards(inputs.At("target"));
  const JsonNode poses = calibration.At("poses");
  for (int i = 0; i < poses.Size(); ++i) ReadPose(poses.At(i), printed, scene);
  scene->target_poses = poses.Size();
  scene->rejected_board_views = calibration.At("rejected").Size();
  scene->reprojection_rms_px = calibration.At("reprojection").At("rms_px").Number();
  if (inputs.Has("acceptance") && inputs.At("acceptance").Has("coverage_factor"))
    scene->coverage_factor = inputs.At("acceptance").At("coverage_factor").Positive();
}

void ReadRulers(const JsonNode& ruler, Scene* scene) {
  const JsonNode list = ruler.At("images");
  for (int i = 0; i < list.Size(); ++i) {
    const JsonNode node = list.At(i);
    if (node.Has("rejected_because") || !node.Has("ends_in_array_mm")) {
      ++scene->rejected_rulers;
      continue;
    }
    const JsonNode ends = node.At("ends_in_array_mm");
    RulerPosition position;
    position.image = node.At("image").Text();
    position.ends_in_array_mm = {ends.At(0).Vector3(), ends.At(1).Vector3()};
    scene->rulers.push_back(position);
  }
}

// Runs `read` and turns a bad field into an error with the file and the remedy.
template <typename Read>
Status ReadFields(const std::filesystem::path& path, const std::string& maker, Read read) {
  try {
    read();
  } catch (const BadField& bad) {
    return BadInput(path.string() + ": " + bad.what() + "; make the file again with '" + maker +
                    "'");
  }
  return {};
}

}  // namespace

Result<Scene> SceneFromResults(const std::filesystem::path& results) {
  const auto calibration_path = results / "calibration.json";
  const auto inputs_path = results / "inputs.json";
  const auto ruler_path = results / "ruler.json";
  TELESTRAIN_ASSIGN_OR_RETURN(
      const auto calibration,
      ReadJson(calibration_path, "telestrain.calibration/1", "telestrain calibrate"));
  TELESTRAIN_ASSIGN_OR_RETURN(const auto inputs,
                              ReadJson(inputs_path, "telestrain.inputs/1", "telestrain run"));
  Scene scene;
  TELESTRAIN_RETURN_IF_ERROR(ReadFields(calibration_path, "telestrain calibrate", [&] {
    ReadCalibration(JsonNode(calibration), JsonNode(inputs, "inputs.json"), &scene);
  }));
  if (std::filesystem::exists(ruler_path)) {
    TELESTRAIN_ASSIGN_OR_RETURN(const auto ruler,
                                ReadJson(ruler_path, "telestrain.ruler/1", "telestrain verify"));
    TELESTRAIN_RETURN_IF_ERROR(
        ReadFields(ruler_path, "telestrain verify", [&] { ReadRulers(JsonNode(ruler), &scene); }));
  }
  TELESTRAIN_ASSIGN_OR_RETURN(scene.pipe, PipeFromResults(results));
  return scene;
}

}  // namespace telestrain::viz
