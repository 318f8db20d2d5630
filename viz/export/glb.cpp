#include "viz/export/glb.h"

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "viz/export/glb_buffer.h"
#include "viz/scene/scene_colors.h"

namespace telestrain::viz {
namespace {

using Json = nlohmann::ordered_json;

// IEC 61966-2-1: the light that an sRGB value stands for; glTF's factors and COLOR_0 are linear.
double Linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}
Eigen::Vector3f Linear(const Rgb& color) {
  return Eigen::Vector3d(Linear(color.r), Linear(color.g), Linear(color.b)).cast<float>();
}

Json MaterialOf(const Rgb& color, double opacity, bool lit) {
  Json material = {
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {Linear(color.r), Linear(color.g), Linear(color.b), opacity}},
        {"metallicFactor", 0.0},
        {"roughnessFactor", 1.0}}},
      {"doubleSided", true}};
  if (opacity < 1) material["alphaMode"] = "BLEND";
  if (!lit) material["extensions"] = {{"KHR_materials_unlit", Json::object()}};
  return material;
}

std::string AttributeName(const std::string& key) {
  std::string name = "_";
  for (const char c : key)
    name.push_back(c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c);
  return name;
}

Json ExtrasOf(const Part& part) {
  Json extras = {{"layer", NameOf(part.layer)}};
  if (part.state != kEveryState) extras["state"] = part.state;
  extras["facts"] = Json::array();
  for (const Fact& fact : part.facts)
    extras["facts"].push_back({{"name", fact.name}, {"value", fact.value}});
  return extras;
}

std::vector<std::uint32_t> TrianglesOf(const Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  for (const std::vector<int>& face : mesh.faces)
    for (std::size_t i = 2; i < face.size(); ++i)
      for (const int corner : {face[0], face[i - 1], face[i]})
        corners.push_back(static_cast<std::uint32_t>(corner));
  return corners;
}

std::vector<std::uint32_t> LineEndsOf(const Mesh& mesh) {
  std::vector<std::uint32_t> ends;
  for (const std::array<int, 2>& line : mesh.lines)
    for (const int end : line) ends.push_back(static_cast<std::uint32_t>(end));
  return ends;
}

class GlbFile {
 public:
  explicit GlbFile(const std::optional<ShownValues>& shown) : shown_(shown) {}

  void Add(const Part& part) {
    Json node = {{"name", part.name}};
    Json primitives = PrimitivesOf(part);
    if (!primitives.empty()) {
      node["mesh"] = meshes_.size();
      meshes_.push_back({{"name", part.name}, {"primitives", std::move(primitives)}});
    }
    node["extras"] = ExtrasOf(part);
    nodes_.push_back(std::move(node));
  }

  std::string Bytes(const SceneAxes& axes) const;

 private:
  Json PrimitivesOf(const Part& part) {
    Json primitives = Json::array();
    if (part.mesh.faces.empty() && part.mesh.lines.empty()) return primitives;
    const PointValues* values = ShownValuesOf(part);
    const Json attributes = AttributesOf(part, values);
    const Rgb color = values != nullptr ? Rgb{1, 1, 1} : part.color;
    const auto add = [&](int mode, const std::vector<std::uint32_t>& indices, Json material) {
      primitives.push_back({{"attributes", attributes},
                            {"indices", buffer_.AddIndices(indices)},
                            {"material", MaterialIndex(std::move(material))},
                            {"mode", mode}});
    };
    constexpr int kLines = 1, kTriangles = 4;
    if (!part.mesh.faces.empty())
      add(kTriangles, TrianglesOf(part.mesh), MaterialOf(color, part.opacity, part.lit));
    if (!part.mesh.lines.empty()) add(kLines, LineEndsOf(part.mesh), MaterialOf(color, 1, false));
    return primitives;
  }

  const PointValues* ShownValuesOf(const Part& part) const {
    if (!shown_) return nullptr;
    for (const PointValues& values : part.values)
      if (values.quantity.key == shown_->quantity.key) return &values;
    return nullptr;
  }

  Json AttributesOf(const Part& part, const PointValues* values) {
    std::vector<Eigen::Vector3f> positions_m;
    for (const Eigen::Vector3d& point : part.mesh.points_in_array_mm)
      positions_m.emplace_back((1e-3 * point).cast<float>());
    Json attributes = {{"POSITION", buffer_.AddPositions(positions_m)}};
    if (values == nullptr) return attributes;
    const ColorMap map = ValueColorMap(shown_->scale);
    std::vector<Eigen::Vector3f> colors;
    bool complete = true;
    for (const double value : values->values) {
      complete = complete && std::isfinite(value);
      colors.push_back(Linear(std::isfinite(value) ? map.At(value) : kNoValueColor));
    }
    attributes["COLOR_0"] = buffer_.AddVectors(colors);
    if (complete)  // glTF has no NaN
      attributes[AttributeName(values->quantity.key)] = buffer_.AddScalars(values->values);
    return attributes;
  }

  std::size_t MaterialIndex(Json material) {
    for (std::size_t i = 0; i < materials_.size(); ++i)
      if (materials_[i] == material) return i;
    materials_.push_back(std::move(material));
    return materials_.size() - 1;
  }

  Json SceneExtras() const;

  const std::optional<ShownValues>& shown_;
  GlbBuffer buffer_;
  Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array();
};

Json GlbFile::SceneExtras() const {
  Json extras = {{"unit", "m"}, {"frame", "array, turned by the root node"}};
  if (!shown_) return extras;
  extras["state"] = shown_->state;
  extras["colors"] = {{"quantity", shown_->quantity.key}, {"name", shown_->quantity.name},
                      {"unit", shown_->quantity.unit},    {"map", "viridis"},
                      {"low", shown_->scale.low},         {"high", shown_->scale.high}};
  return extras;
}

// From the array frame to glTF's: x along the pipe, y to the cameras.
Json RootRotation(const SceneAxes& axes) {
  Eigen::Matrix3d gltf_from_array;
  gltf_from_array << axes.along.transpose(), axes.up.transpose(), -axes.across.transpose();
  const Eigen::Quaterniond turn = Eigen::Quaterniond(gltf_from_array).normalized();
  return {turn.x(), turn.y(), turn.z(), turn.w()};
}

std::string GlbFile::Bytes(const SceneAxes& axes) const {
  Json nodes = nodes_;
  Json root = {{"name", "array"}, {"rotation", RootRotation(axes)}};
  for (std::size_t i = 0; i < nodes_.size(); ++i) root["children"].push_back(i);
  nodes.push_back(std::move(root));
  Json scene = {{"nodes", Json::array({nodes_.size()})}, {"extras", SceneExtras()}};
  Json json = {{"asset", {{"version", "2.0"}, {"generator", "telestrain"}}},
               {"scene", 0},
               {"scenes", Json::array({std::move(scene)})},
               {"nodes", std::move(nodes)}};
  // An empty list is not allowed; a scene without any mesh has none of these.
  if (!meshes_.empty()) {
    json["extensionsUsed"] = Json::array({"KHR_materials_unlit"});
    json["meshes"] = meshes_;
    json["materials"] = materials_;
    buffer_.Describe(&json);
  }
  return GlbContainer(json.dump(-1, ' ', false, Json::error_handler_t::replace), buffer_.bytes());
}

}  // namespace

std::string GlbBytes(const std::vector<Part>& parts, const SceneAxes& axes,
                     const std::optional<ShownValues>& shown) {
  GlbFile file(shown);
  for (const Part& part : parts)
    if (part.state == kEveryState || (shown && part.state == static_cast<int>(shown->state)))
      file.Add(part);
  return file.Bytes(axes);
}

}  // namespace telestrain::viz
