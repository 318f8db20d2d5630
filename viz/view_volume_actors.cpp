#include <vtkActor.h>
#include <vtkPolyData.h>

#include <algorithm>

#include "viz/actors.h"

namespace telestrain::viz {
namespace {

constexpr Rgb kGroupColors[] = {
    {0.00, 0.45, 0.70}, {0.84, 0.37, 0.00}, {0.80, 0.47, 0.65}, {0.90, 0.62, 0.00}};

Rgb Lighter(const Rgb& color) {
  constexpr double kShare = 0.35;
  return {color.r + kShare * (1 - color.r), color.g + kShare * (1 - color.g),
          color.b + kShare * (1 - color.b)};
}

constexpr double kDepthOfFieldOpacity = 0.11;
constexpr double kStretchOpacity = 0.05;

}  // namespace

Rgb ColorOfGroup(const Scene& scene, const std::string& name) {
  const auto groups = scene.Groups();
  const auto group = std::find(groups.begin(), groups.end(), name) - groups.begin();
  return kGroupColors[group % std::ssize(kGroupColors)];
}

Rgb ColorOfView(const Scene& scene, std::size_t view) {
  const std::string& name = scene.views[view].group;
  const auto before = std::count_if(scene.views.begin(), scene.views.begin() + view,
                                    [&](const ViewVolume& v) { return v.group == name; });
  const Rgb color = ColorOfGroup(scene, name);
  return before % 2 == 0 ? color : Lighter(color);
}

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

void AddViewVolume(vtkRenderer* renderer, const Scene& scene, std::size_t index, double point_px) {
  const ViewVolume& view = scene.views[index];
  const Rgb color = ColorOfView(scene, index);
  const double half_depth_mm = 0.5 * view.depth_of_field_mm, stretch_mm = StretchOf(scene);
  const Rectangle top = view.Section(-stretch_mm), near = view.Section(-half_depth_mm),
                  far = view.Section(half_depth_mm);
  AddBody(renderer, BoxBetween(top, near), color, kStretchOpacity);
  AddBody(renderer, BoxBetween(near, far), color, kDepthOfFieldOpacity);
  std::vector<Segment> thin = EdgesBetween(top, near), thick = EdgesBetween(near, far);
  for (const Segment& edge : EdgesOf(top)) thin.push_back(edge);
  for (const Rectangle& face : {near, far})
    for (const Segment& edge : EdgesOf(face)) thick.push_back(edge);
  AddLines(renderer, thin, color, 0.5 * point_px);
  AddLines(renderer, thick, color, 0.9 * point_px);

  const double side_mm = std::min(view.width_mm, view.height_mm);
  const Eigen::Vector3d middle = TopOf(scene, view);
  AddArrow(renderer, {middle, middle + 0.62 * stretch_mm * view.axis_in_array}, 0.055 * side_mm,
           color);
  const Eigen::Vector3d first_pixel = top[0];
  AddArrow(renderer, {first_pixel, first_pixel + 0.55 * side_mm * view.image_x_in_array},
           0.05 * side_mm, kImageXColor);
  AddArrow(renderer, {first_pixel, first_pixel + 0.55 * side_mm * view.image_y_in_array},
           0.05 * side_mm, kImageYColor);
}

}  // namespace telestrain::viz
