#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "geometry/rotation.h"
#include "simulation/experiment_truth.h"
#include "simulation/load_plan.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

template <typename Derived>
Json Numbers(const Eigen::MatrixBase<Derived>& matrix) {
  Json list = Json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      list.push_back(matrix(row, column));
  return list;
}

Json LensJson(const TelecentricLens& lens) {
  const auto& [k1, k2, p1, p2, k3] = lens.distortion;
  return {{"magnification_px_per_mm", lens.magnification_px_per_mm},
          {"center_px", Numbers(lens.center_px)},
          {"distortion",
           {{"k1_per_mm2", k1},
            {"k2_per_mm4", k2},
            {"p1_per_mm", p1},
            {"p2_per_mm", p2},
            {"k3_per_mm6", k3}}}};
}

Json ViewJson(const VirtualInstrument& instrument, const InstrumentView& view) {
  const auto& axes = view.view.axes_in_array;
  const PixelRegion& region = view.region;
  return {
      {"name", view.view.name},
      {"group", view.view.group},
      {"region_px", {region.x, region.y, region.width, region.height}},
      {"image_x_in_array", Numbers(axes.row(0))},
      {"image_y_in_array", Numbers(axes.row(1))},
      {"axis_in_array", Numbers(view.viewing_direction)},
      {"offset_mm", Numbers(view.view.offset_mm)},
      {"offset_px", Numbers(instrument.lens.center_px +
                            instrument.lens.Scales_px_per_mm().cwiseProduct(view.view.offset_mm))},
      {"center_in_array_mm", Numbers(view.center_in_array_mm)}};
}

bool Contains(const PixelRegion& region, const Eigen::Vector2d& pixel) {
  return pixel.x() >= region.x - 0.5 && pixel.x() < region.x + region.width - 0.5 &&
         pixel.y() >= region.y - 0.5 && pixel.y() < region.y + region.height - 0.5;
}

// The corners of the board that belongs to the view; null when its centre lies outside the region.
Json BoardJson(const VirtualInstrument& instrument, const InstrumentView& view,
               const TargetSpec& plate, const PlatePose& pose) {
  const SubBoard& board = *plate.FindBoard(view.view.group);
  const auto pixel_of = [&](const Eigen::Vector3d& point_mm) {
    return instrument.Project(view, pose.InArray(point_mm));
  };
  if (!Contains(view.region, pixel_of(board.center_in_target_mm))) return nullptr;
  const Eigen::Matrix3Xd corners_mm = plate.CornersInTarget(board);
  bool all_inside = true;
  Json pixels = Json::array();
  for (Eigen::Index i = 0; i < corners_mm.cols(); ++i) {
    const Eigen::Vector2d pixel = pixel_of(corners_mm.col(i));
    all_inside = all_inside && Contains(view.region, pixel);
    pixels.push_back(Numbers(pixel));
  }
  return {{"view", view.view.name}, {"all_inside", all_inside}, {"corners_px", pixels}};
}

Json PlateJson(const VirtualInstrument& instrument, const TargetSpec& plate,
               const PlateTruth& truth) {
  Json boards = Json::array();
  for (const InstrumentView& view : instrument.views) {
    Json board = BoardJson(instrument, view, plate, truth.plate);
    if (!board.is_null()) boards.push_back(std::move(board));
  }
  return {{"rotation_array_from_target", Numbers(truth.plate.array_from_plate)},
          {"origin_in_array_mm", Numbers(truth.plate.origin_in_array_mm)},
          {"boards", std::move(boards)}};
}

Json CalibrationJson(const ExperimentTruth& truth) {
  Json list = Json::array();
  for (const PlateTruth& plate : truth.calibration) {
    Json json{{"image", plate.image},
              {"pose", plate.pose},
              {"stage_mm", plate.stage_mm},
              {"cut_off_on_purpose", plate.is_cut_off}};
    json.update(PlateJson(truth.instrument, truth.target, plate));
    list.push_back(std::move(json));
  }
  return list;
}

Json RulerJson(const ExperimentTruth& truth) {
  Json list = Json::array();
  for (const PlateTruth& plate : truth.rulers) {
    Json json{{"image", plate.image}};
    json.update(PlateJson(truth.instrument, truth.ruler, plate));
    list.push_back(std::move(json));
  }
  return {{"length_mm", truth.ruler_length_mm}, {"images", std::move(list)}};
}

Json StateJson(const ExperimentTruth& truth, const PipeTruth& state) {
  const DeformedPipe& reference = truth.pipe.front().pipe;
  const DeformedPipe& pipe = state.pipe;
  const TrueStrain strain = StrainOf(truth, state);
  const Eigen::Vector3d turn_deg =
      LogRotation(pipe.RotationFrom(reference)) * 180 / std::numbers::pi;
  const double bending = 1e6 * pipe.curvature_per_mm * pipe.radius_mm;
  return {{"image", state.state.image},
          {"cycle", state.state.cycle},
          {"step", state.state.step},
          {"axial_microstrain", 1e6 * strain.long_base},
          {"local_a_microstrain", 1e6 * strain.local_a},
          {"local_b_microstrain", 1e6 * strain.local_b},
          {"hoop_microstrain", 1e6 * strain.hoop},
          {"shear_microstrain", 1e6 * strain.shear},
          {"membrane_microstrain", 1e6 * pipe.membrane_strain},
          {"bending_microstrain", bending},
          {"bending_0_microstrain", -bending * std::cos(pipe.curvature_angle_rad)},
          {"bending_90_microstrain", -bending * std::sin(pipe.curvature_angle_rad)},
          {"pressure_axial_microstrain", 1e6 * pipe.pressure_axial_strain},
          {"pressure_hoop_microstrain", 1e6 * pipe.pressure_hoop_strain},
          {"thermal_microstrain", 1e6 * pipe.thermal_strain},
          {"torsion_microstrain", 1e6 * pipe.twist_rad_per_mm * pipe.radius_mm},
          {"rotation_array_from_pipe", Numbers(pipe.array_from_pipe)},
          {"origin_in_array_mm", Numbers(pipe.origin_in_array_mm)},
          {"rigid_motion",
           {{"translation_mm", Numbers(pipe.TranslationFrom_mm(reference))},
            {"rotation_deg", Numbers(turn_deg)}}}};
}

Json OptionsJson(const VirtualExperimentOptions& options) {
  Json json = Json::object();
  for (const VirtualExperimentOptionInfo& info : VirtualExperimentOptionTable()) {
    if (std::string(info.name) == "threads") continue;  // has no effect on any byte
    std::visit([&](auto member) { json[info.name] = options.*member; }, info.member);
  }
  return json;
}

}  // namespace

nlohmann::ordered_json TruthJson(const VirtualExperimentOptions& options,
                                 const ExperimentTruth& truth) {
  Json views = Json::array(), states = Json::array(), target = Json::array();
  for (const InstrumentView& view : truth.instrument.views)
    views.push_back(ViewJson(truth.instrument, view));
  for (const PipeTruth& state : truth.pipe) states.push_back(StateJson(truth, state));
  for (const SubBoard& board : truth.target.boards)
    target.push_back(
        {{"group", board.group}, {"center_in_target_mm", Numbers(board.center_in_target_mm)}});
  return {{"schema", "telestrain.truth/1"},
          {"options", OptionsJson(options)},
          {"lens", LensJson(truth.instrument.lens)},
          {"blur_sigma_px", truth.instrument.blur_sigma_px},
          {"views", std::move(views)},
          {"stage_axis_in_array", Numbers(truth.stage_axis_in_array)},
          {"target_boards", std::move(target)},
          {"poses", CalibrationJson(truth)},
          {"ruler", RulerJson(truth)},
          {"pipe", std::move(states)}};
}

}  // namespace telestrain
