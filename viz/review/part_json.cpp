#include "viz/review/part_json.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>

#include "base/numbers.h"
#include "viz/review/html_text.h"
#include "viz/scene/scene_colors.h"

namespace telestrain::viz {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

template <typename Number>
std::string Coded(const std::vector<Number>& numbers) {
  return Base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

Json VectorJson(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

std::string HexColor(const Rgb& color) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t byte : BytesOf(color)) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

Json ScaleJson(const ColorScale& scale) {
  return {{"low", scale.low},
          {"high", scale.high},
          {"ticks", scale.ticks},
          {"decimals", scale.decimals},
          {"clipped", scale.clipped}};
}

Json ColorsJson(const ColorMap& map) {
  Json json = Json::array();
  for (const Rgb& color : map.table()) json.push_back(HexColor(color));
  return json;
}

Json MeshJson(const Mesh& mesh) {
  std::vector<float> points;
  for (const Eigen::Vector3d& point : mesh.points_in_array_mm)
    for (const double value : point) points.push_back(static_cast<float>(value));
  std::vector<std::uint32_t> faces, lines;
  for (const std::vector<int>& face : mesh.faces) {
    faces.push_back(static_cast<std::uint32_t>(face.size()));
    for (const int index : face) faces.push_back(static_cast<std::uint32_t>(index));
  }
  for (const std::array<int, 2>& line : mesh.lines)
    for (const int index : line) lines.push_back(static_cast<std::uint32_t>(index));
  return {{"points", Coded(points)}, {"faces", Coded(faces)}, {"lines", Coded(lines)}};
}

Json PartJson(const Part& part) {
  Json json{{"name", part.name},       {"layer", NameOf(part.layer)},
            {"state", part.state},     {"color", HexColor(part.color)},
            {"opacity", part.opacity}, {"line_width_pt", part.line_width_pt},
            {"lit", part.lit}};
  json.update(MeshJson(part.mesh));
  json["values"] = Json::array();
  for (const PointValues& values : part.values) {
    std::vector<float> numbers;
    for (const double value : values.values) numbers.push_back(static_cast<float>(value));
    json["values"].push_back({{"quantity", values.quantity.key}, {"values", Coded(numbers)}});
  }
  json["facts"] = Json::array();
  for (const Fact& fact : part.facts) json["facts"].push_back({fact.name, fact.value});
  return json;
}

// The finite values of a quantity in one state, or in all.
std::vector<double> ValuesOf(const PartList& list, const std::string& key, int state) {
  std::vector<double> found;
  for (const Part& part : list.parts)
    for (const PointValues& values : part.values) {
      if (values.quantity.key != key || (state >= 0 && part.state != state)) continue;
      std::copy_if(values.values.begin(), values.values.end(), std::back_inserter(found),
                   [](double value) { return std::isfinite(value); });
    }
  return found;
}

// As in the pictures: a hundredth of the points at either end may be noise of single subsets.
ColorScale RangeOf(std::vector<double> values) { return ScaleFor(std::move(values), 0.01); }

Json QuantityJson(const PartList& list, const Quantity& quantity, Layer layer, int states) {
  Json json{{"key", quantity.key},
            {"name", quantity.name},
            {"unit", quantity.unit},
            {"color_map", layer == Layer::kBoards ? "plasma" : "viridis"},
            {"scale", ScaleJson(RangeOf(ValuesOf(list, quantity.key, kEveryState)))},
            {"state_scales", Json::array()}};
  for (int state = 0; state < states; ++state) {
    const std::vector<double> values = ValuesOf(list, quantity.key, state);
    json["state_scales"].push_back(values.empty() ? Json() : ScaleJson(RangeOf(values)));
  }
  const auto absent = [](const Json& scale) { return scale.is_null(); };
  Json& scales = json["state_scales"];
  if (std::all_of(scales.begin(), scales.end(), absent)) scales = Json::array();
  return json;
}

// Every quantity once, those of the surface first.
Json QuantitiesJson(const PartList& list, int states) {
  Json json = Json::array();
  std::set<std::string> seen;
  for (const bool surface : {true, false})
    for (const Part& part : list.parts)
      for (const PointValues& values : part.values) {
        const bool wanted = (part.layer == Layer::kSurface) == surface;
        if (!wanted || !seen.insert(values.quantity.key).second ||
            ValuesOf(list, values.quantity.key, kEveryState).empty())
          continue;
        json.push_back(QuantityJson(list, values.quantity, part.layer, states));
      }
  return json;
}

bool HasPart(const PartList& list, Layer layer) {
  return std::any_of(list.parts.begin(), list.parts.end(),
                     [&](const Part& part) { return part.layer == layer; });
}

// What a reader needs first is shown; what covers it waits for a click.
Json LayersJson(const PartList& list) {
  constexpr std::array kHidden = {Layer::kOptics, Layer::kDisplacements, Layer::kUncertainty,
                                  Layer::kFrame};
  Json json = Json::array();
  for (const Layer layer : kAllLayers) {
    if (!HasPart(list, layer)) continue;
    const bool hidden = std::find(kHidden.begin(), kHidden.end(), layer) != kHidden.end();
    std::string name = NameOf(layer);
    if (layer == Layer::kDisplacements)
      name += " \u00d7 " + FormatShortest(list.displacement_factor);
    if (layer == Layer::kUncertainty) name += " \u00d7 " + FormatShortest(list.uncertainty_factor);
    json.push_back({{"key", NameOf(layer)}, {"name", name}, {"shown", !hidden}});
  }
  return json;
}

// What the colours of boards and rulers mean.
Json LegendsJson(const Scene& scene) {
  Json json = Json::array();
  const auto add = [&](Layer layer, const char* name, const ColorScale& scale,
                       const ColorMap& colors) {
    json.push_back({{"layer", NameOf(layer)},
                    {"name", name},
                    {"scale", ScaleJson(scale)},
                    {"colors", ColorsJson(colors)}});
  };
  if (!scene.boards.empty())
    add(Layer::kBoards, "Boards: residual RMS / px", ResidualScale(scene.boards),
        ResidualColors(scene.boards));
  if (!scene.rulers.empty())
    add(Layer::kRulers, "Rulers: length error / \u00b5m", RulerScale(scene.rulers),
        RulerColors(scene.rulers));
  return json;
}

// "(743.21 ± 0.30) µε": two digits of the expanded uncertainty, which may be unknown (0).
std::string StrainText(double strain_microstrain, double expanded_microstrain) {
  if (!(expanded_microstrain > 0)) return NumberText(strain_microstrain, 1) + " µε";
  const int decimals =
      std::clamp(1 - static_cast<int>(std::floor(std::log10(expanded_microstrain))), 0, 6);
  return "(" + NumberText(strain_microstrain, decimals) + " ± " +
         NumberText(expanded_microstrain, decimals) + ") µε";
}

// The states count from 0, as everywhere.
std::string TextOf(const PipeState& state, std::size_t index, double coverage_factor) {
  const double expanded_microstrain = coverage_factor * state.standard_uncertainty_microstrain;
  std::string text = std::to_string(index) + "  " + state.image;
  if (!state.cycle.empty()) text += ", cycle " + state.cycle;
  if (!state.step.empty()) text += ", step " + state.step;
  text += ": axial strain " + StrainText(state.axial_microstrain, expanded_microstrain);
  if (expanded_microstrain > 0) text += ", k = " + FormatShortest(coverage_factor);
  return text;
}

Json StatesJson(const Scene& scene) {
  Json json = Json::array();
  if (!scene.pipe) return json;
  for (std::size_t i = 0; i < scene.pipe->states.size(); ++i)
    json.push_back({{"text", TextOf(scene.pipe->states[i], i, scene.coverage_factor)}});
  return json;
}

Json DirectionsJson(const Scene& scene) {
  const SceneAxes axes = AxesOf(scene);
  const Eigen::Vector3d oblique = (0.43 * axes.along - 0.87 * axes.across + 0.4 * axes.up);
  Json json = Json::array();
  const auto add = [&](const char* name, const Eigen::Vector3d& towards,
                       const Eigen::Vector3d& up) {
    json.push_back({{"name", name},
                    {"towards_viewer", VectorJson(towards.normalized())},
                    {"up", VectorJson(up)}});
  };
  add("Array", oblique, axes.up);
  add("Side", -axes.across, axes.up);
  add("Top", axes.up, axes.across);
  add("Along pipe", axes.along, axes.up);
  return json;
}

// The views' names stand beyond the camera-side end of what is drawn of them.
Json LabelsJson(const Scene& scene, const PartList& list) {
  Json json = Json::array();
  for (const ViewVolume& view : scene.views) {
    double nearest_mm = -0.5 * view.depth_of_field_mm;
    std::string color = "#1c2733";
    for (const Part& part : list.parts) {
      if (!part.name.starts_with("view " + view.name + ":")) continue;
      if (part.opacity < 1) color = HexColor(part.color);
      for (const Eigen::Vector3d& point : part.mesh.points_in_array_mm)
        nearest_mm =
            std::min(nearest_mm, (point - view.center_in_array_mm).dot(view.axis_in_array));
    }
    const Eigen::Vector3d at =
        view.center_in_array_mm + (nearest_mm - 0.15 * view.width_mm) * view.axis_in_array;
    json.push_back({{"text", view.name},
                    {"layer", NameOf(Layer::kViews)},
                    {"state", kEveryState},
                    {"at", VectorJson(at)},
                    {"color", color}});
  }
  return json;
}

}  // namespace

Json SceneJson(const Scene& scene, const PartList& list) {
  const int states = scene.pipe ? static_cast<int>(scene.pipe->states.size()) : 0;
  Json json{{"layers", LayersJson(list)},
            {"states", StatesJson(scene)},
            {"first_state", states > 0 ? scene.pipe->largest_state : 0},
            {"directions", DirectionsJson(scene)},
            {"labels", LabelsJson(scene, list)},
            {"legends", LegendsJson(scene)},
            {"quantities", QuantitiesJson(list, states)},
            {"color_maps",
             {{"viridis", ColorsJson(ColorMap::Viridis(0, 1))},
              {"plasma", ColorsJson(ColorMap::Plasma(0, 1))}}},
            {"parts", Json::array()}};
  for (const Part& part : list.parts) json["parts"].push_back(PartJson(part));
  return json;
}

}  // namespace telestrain::viz
