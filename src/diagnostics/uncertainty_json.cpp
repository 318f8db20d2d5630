#include <nlohmann/json.hpp>

#include "diagnostics/diagnosis.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

Json SummaryJson(const MapSummary& summary) {
  return {{"mean_px", summary.mean_px},
          {"largest_px", summary.largest_px},
          {"mean_um", summary.mean_um},
          {"largest_um", summary.largest_um}};
}

Json MapJson(const UncertaintyMap& map) {
  std::vector<double> of_everything_um, of_noise_um;
  for (const MapNode& node : map.nodes) {
    of_everything_um.push_back(node.of_everything.worst_um);
    of_noise_um.push_back(node.of_noise.worst_um);
  }
  const Eigen::Vector2d first = map.nodes.front().pixel, last = map.nodes.back().pixel;
  return {{"view", map.view},
          {"columns", map.columns},
          {"rows", map.rows},
          {"first_x_px", first.x()},
          {"first_y_px", first.y()},
          {"step_x_px", (last.x() - first.x()) / (map.columns - 1)},
          {"step_y_px", (last.y() - first.y()) / (map.rows - 1)},
          {"depth_mm", map.depth_mm},
          {"of_everything", SummaryJson(map.of_everything)},
          {"of_noise", SummaryJson(map.of_noise)},
          {"sigma_um", of_everything_um},
          {"sigma_of_noise_um", of_noise_um}};
}

Json ShareJson(const CalibrationShare& share) {
  return {{"of_everything", share.of_everything}, {"of_noise", share.of_noise}};
}

Json LengthJson(const Diagnosis& diagnosis) {
  if (!diagnosis.length) return {{"missing_because", diagnosis.length_missing_because}};
  const LengthUncertainty& length = *diagnosis.length;
  return {{"groups", {length.group_a, length.group_b}},
          {"length_mm", length.length_mm},
          {"length_um", ShareJson(length.length_um)},
          {"shift_microstrain", ShareJson(length.shift_microstrain)},
          {"turn_microstrain", ShareJson(length.turn_microstrain)},
          {"true_strain_microstrain", ShareJson(length.true_strain_microstrain)},
          {"sentences", length.sentences}};
}

}  // namespace

nlohmann::ordered_json UncertaintyJson(const Diagnosis& diagnosis) {
  Json maps = Json::array();
  for (const UncertaintyMap& map : diagnosis.maps) maps.push_back(MapJson(map));
  return {{"what",
           "standard uncertainty of a projection in its worst direction, on the object; free of "
           "the gauge (mrcal's average over the poses)"},
          {"maps", maps},
          {"means_for", LengthJson(diagnosis)}};
}

}  // namespace telestrain
