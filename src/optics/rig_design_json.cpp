#include <nlohmann/json.hpp>
#include <numbers>

#include "base/json_file.h"
#include "optics/rig_design_output.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

Json Number(const std::optional<double>& value) { return value ? Json(*value) : Json(); }
template <typename Vector>
Json List(const Vector& vector) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < vector.size(); ++i) list.push_back(vector[i]);
  return list;
}
template <typename Points>
Json PointList(const Points& points) {
  Json list = Json::array();
  for (const auto& point : points) list.push_back(List(point));
  return list;
}
double Degrees(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

Json MirrorJson(const MirrorDesign& mirror) {
  return {{"name", mirror.plate.name},
          {"incidence_deg", Degrees(mirror.incidence_rad)},
          {"chief_size_mm", List(mirror.chief_size_mm)},
          {"needed_size_mm", List(mirror.needed_size_mm)},
          {"size_mm", List(mirror.plate.Size_mm())},
          {"shares_edge", mirror.is_cut},
          {"normal_in_array", List(mirror.plate.Normal())},
          {"outline_in_array_mm", PointList(mirror.plate.Corners())}};
}

Json ViewJson(const ViewDesign& view) {
  Json json = {{"name", view.name},
               {"group", view.group},
               {"mirror_count", view.mirrors},
               {"handedness", view.handedness},
               {"field_mm", List(view.field_mm)},
               {"footprint_mm", PointList(view.footprint_mm)},
               {"focus_path_mm", view.focus_path_mm},
               {"first_mirror_path_mm", view.first_mirror_path_mm},
               {"middle_ray_in_array_mm", PointList(view.middle_ray.Corners())},
               {"chief_loss_percent", view.chief_loss_percent},
               {"light_loss_percent", view.light_loss_percent},
               {"worst_loss_percent", view.worst_loss_percent},
               {"full_light_percent", view.full_light_percent},
               {"blocked_percent", view.blocked_percent},
               {"mirrors", Json::array()}};
  for (const MirrorDesign& mirror : view.plates) json["mirrors"].push_back(MirrorJson(mirror));
  return json;
}

Json PairJson(const PairDesign& pair) {
  return {{"group", pair.group},
          {"views", {pair.first, pair.second}},
          {"stereo_angle_deg", Degrees(pair.stereo_angle_rad)},
          {"center_in_array_mm", List(pair.center_in_array_mm)},
          {"overlap_percent", pair.overlap_percent},
          {"common_mm", List(pair.common_mm)},
          {"depth_spread_mm", pair.depth_spread_mm},
          {"seen_arc_mm", Number(pair.seen_arc_mm)},
          {"sharp_arc_mm", Number(pair.sharp_arc_mm)}};
}

Json SensitivityJson(const MirrorSensitivity& s) {
  static constexpr const char* kNames[] = {"turn_in_plane", "turn_across", "shift"};
  return {{"view", s.view},
          {"mirror", s.mirror + 1},
          {"error", kNames[static_cast<int>(s.error)]},
          {"field_shift_mm", s.field_shift_mm},
          {"field_shift_px", s.field_shift_px},
          {"direction_mrad", s.direction_mrad},
          {"roll_mrad", s.roll_mrad},
          {"stereo_angle_mrad", Number(s.stereo_angle_mrad)},
          {"length_error_um", Number(s.length_error_um)},
          {"strain_error_microstrain", Number(s.strain_error_microstrain)}};
}

Json CheckJson(const DesignCheck& check) {
  return {{"what", check.what}, {"value", check.value},     {"limit", check.limit},
          {"unit", check.unit}, {"at_most", check.at_most}, {"ok", check.ok}};
}

Json ArrayJson(const RigDesign& design) {
  Json gaps = Json::array(), blocked = Json::array();
  for (const PlateGap& gap : design.gaps)
    gaps.push_back({{"mirrors", {gap.first, gap.second}},
                    {"gap_mm", gap.gap_mm},
                    {"shares_edge", gap.shared_edge}});
  for (const BlockedLight& light : design.blocked)
    blocked.push_back({{"view", light.view}, {"mirror", light.plate}, {"percent", light.percent}});
  return {{"total_field_mm", design.total_field_mm},
          {"field_gap_mm", Number(design.field_gap_mm)},
          {"base_length_mm", Number(design.base_length_mm)},
          {"path_spread_mm", design.path_spread_mm},
          {"overlapping_mirrors", design.overlapping_plates},
          {"mirror_gaps", gaps},
          {"blocked_light", blocked}};
}

template <typename Items, typename Maker>
Json ListOf(const Items& items, Maker maker) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(maker(item));
  return list;
}

}  // namespace

std::string DesignJson(const OpticalRig& rig, const RigDesign& design) {
  const Json json = {{"schema", "telestrain.design/1"},
                     {"title", rig.title},
                     {"magnification_px_per_mm", rig.magnification_px_per_mm},
                     {"depth_of_field_mm", rig.depth_of_field_mm},
                     {"pipe_diameter_mm", Number(rig.pipe_diameter_mm)},
                     {"numerical_aperture", design.numerical_aperture},
                     {"views", ListOf(design.views, ViewJson)},
                     {"pairs", ListOf(design.pairs, PairJson)},
                     {"array", ArrayJson(design)},
                     {"mirror_turn_rad", kMirrorTurn_rad},
                     {"mirror_shift_mm", kMirrorShift_mm},
                     {"sensitivities", ListOf(design.sensitivities, SensitivityJson)},
                     {"checks", ListOf(design.checks, CheckJson)},
                     {"all_hold", design.AllHold()}};
  return JsonText(json);
}

}  // namespace telestrain
