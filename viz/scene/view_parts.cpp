#include <algorithm>

#include "base/numbers.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene/scene_parts.h"

namespace telestrain::viz {
namespace {

constexpr double kDepthOfFieldOpacity = 0.11;
constexpr double kStretchOpacity = 0.05;
constexpr double kFocusOpacity = 0.10;

std::string DirectionText(const Eigen::Vector3d& direction) {
  return "(" + NumberText(direction.x(), 4) + ", " + NumberText(direction.y(), 4) + ", " +
         NumberText(direction.z(), 4) + ")";
}

std::vector<Fact> FactsOf(const Scene& scene, const ViewVolume& view) {
  const Eigen::Vector3d& center = view.center_in_array_mm;
  return {{"view", view.name},
          {"group", view.group},
          {"viewing direction", DirectionText(view.axis_in_array)},
          {"centre", NumberText(center.x(), 3) + ", " + NumberText(center.y(), 3) + ", " +
                         NumberText(center.z(), 3) + " mm"},
          {"field",
           FormatFixed(view.width_mm, 3) + " \u00d7 " + FormatFixed(view.height_mm, 3) + " mm"},
          {"depth of field", FormatFixed(view.depth_of_field_mm, 2) + " mm"},
          {"magnification", FormatFixed(scene.magnification_px_per_mm, 4) + " px/mm"}};
}

Part Volume(const Scene& scene, std::size_t index, const std::string& what) {
  Part part;
  part.name = "view " + scene.views[index].name + ": " + what;
  part.layer = Layer::kViews;
  part.color = ColorOfView(scene, index);
  part.lit = true;
  part.facts = FactsOf(scene, scene.views[index]);
  return part;
}

Part DepthOfField(const Scene& scene, std::size_t index) {
  const ViewVolume& view = scene.views[index];
  const double half_mm = 0.5 * view.depth_of_field_mm;
  const Rectangle near = view.Section(-half_mm), far = view.Section(half_mm);
  Part part = Volume(scene, index, "depth of field");
  part.mesh = BoxBetween(near, far);
  std::vector<Segment> edges = EdgesBetween(near, far);
  for (const Rectangle& face : {near, far})
    for (const Segment& edge : EdgesOf(face)) edges.push_back(edge);
  part.mesh.Append(Lines(edges));
  part.opacity = kDepthOfFieldOpacity;
  part.line_width_pt = 0.9;
  return part;
}

Part Stretch(const Scene& scene, std::size_t index) {
  const ViewVolume& view = scene.views[index];
  const Rectangle top = view.Section(-StretchOf(scene));
  const Rectangle near = view.Section(-0.5 * view.depth_of_field_mm);
  Part part = Volume(scene, index, "beam towards the camera");
  part.mesh = BoxBetween(top, near);
  std::vector<Segment> edges = EdgesBetween(top, near);
  for (const Segment& edge : EdgesOf(top)) edges.push_back(edge);
  part.mesh.Append(Lines(edges));
  part.opacity = kStretchOpacity;
  part.line_width_pt = 0.5;
  return part;
}

void AddArrows(const Scene& scene, std::size_t index, std::vector<Part>* parts) {
  const ViewVolume& view = scene.views[index];
  const double side_mm = std::min(view.width_mm, view.height_mm), stretch_mm = StretchOf(scene);
  const Eigen::Vector3d middle = TopOf(scene, view), first_pixel = view.Section(-stretch_mm)[0];
  const auto add = [&](const std::string& what, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& along, double thickness_mm, const Rgb* color) {
    Part part = Volume(scene, index, what);
    part.mesh = Arrow({from, from + along}, thickness_mm);
    if (color != nullptr) part.color = *color;
    parts->push_back(std::move(part));
  };
  add("viewing direction", middle, 0.62 * stretch_mm * view.axis_in_array, 0.055 * side_mm,
      nullptr);
  add("pixel axis u", first_pixel, 0.55 * side_mm * view.image_x_in_array, 0.05 * side_mm,
      &kImageXColor);
  add("pixel axis v", first_pixel, 0.55 * side_mm * view.image_y_in_array, 0.05 * side_mm,
      &kImageYColor);
}

}  // namespace

double StretchOf(const Scene& scene) {
  double side_mm = 0, depth_mm = 0;
  for (const ViewVolume& view : scene.views) {
    side_mm = std::max({side_mm, view.width_mm, view.height_mm});
    depth_mm = std::max(depth_mm, view.depth_of_field_mm);
  }
  return 0.5 * depth_mm + 1.3 * side_mm;
}

Eigen::Vector3d TopOf(const Scene& scene, const ViewVolume& view) {
  return view.center_in_array_mm - StretchOf(scene) * view.axis_in_array;
}

std::vector<Part> ViewParts(const Scene& scene) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    parts.push_back(Stretch(scene, i));
    parts.push_back(DepthOfField(scene, i));
    AddArrows(scene, i, &parts);
  }
  return parts;
}

std::vector<Part> FocusParts(const Scene& scene) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    parts.push_back(DepthOfField(scene, i));
    parts.back().opacity = kFocusOpacity;
    parts.back().line_width_pt = 0.7;
  }
  return parts;
}

}  // namespace telestrain::viz
