#include "viz/scene_marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/numbers.h"
#include "viz/legend.h"
#include "viz/part_actors.h"
#include "viz/scene/scene_colors.h"

namespace telestrain::viz {
namespace {

Part Mark(const Mesh& mesh, const Rgb& color, double line_width_pt) {
  Part part;
  part.mesh = mesh;
  part.color = color;
  part.line_width_pt = line_width_pt;
  part.lit = true;
  return part;
}

}  // namespace

void AddTriad(Canvas* canvas, const SceneAxes& axes, const ViewDirection& direction,
              const PixelBox& box) {
  static constexpr const char* kNames[3] = {"x", "y", "z"};
  std::vector<Eigen::Vector3d> ends{Eigen::Vector3d::Zero()};
  for (int i = 0; i < 3; ++i) ends.push_back(Eigen::Vector3d::Unit(i));
  const ParallelCamera camera = FitCamera(ends, axes, direction, box, canvas->Px(10));
  vtkRenderer* renderer = canvas->AddPanel("triad", box, camera);
  const Eigen::Vector2d origin = canvas->DisplayOf("triad", ends[0]);
  for (int i = 0; i < 3; ++i) {
    AddParts(renderer, {Mark(Arrow({ends[0], ends[i + 1]}, 0.06), kAxisColors[i], 1)}, nullptr, 1);
    const Eigen::Vector2d out = canvas->DisplayOf("triad", ends[i + 1]) - origin;
    Label label;
    label.text = kNames[i];
    label.anchor_in_array_mm = ends[i + 1];
    // y often lies nearly behind z in the picture: its name steps aside.
    label.preferred_deg =
        std::atan2(out.y(), out.x()) * 180 / std::numbers::pi - (i == 1 ? 60.0 : 0.0);
    label.style = {8, true, kAxisColors[i]};
    label.leader = false;
    canvas->AddLabel("triad", label);
  }
}

void AddScaleBar(Canvas* canvas, const std::string& panel, vtkRenderer* renderer,
                 const ScaleBar& bar) {
  AddParts(renderer, {Mark(Lines({{bar.start_in_array_mm, bar.End()}}), kInk, 1.8)}, nullptr,
           canvas->Px(1));
  Label label;
  label.text = FormatShortest(bar.length_mm) + " mm";
  label.anchor_in_array_mm = 0.5 * (bar.start_in_array_mm + bar.End());
  label.preferred_deg = -90;
  label.leader = false;
  canvas->AddLabel(panel, label);
}

void NameViews(Canvas* canvas, const std::string& panel, const Scene& scene) {
  const double near_px = canvas->Px(12);
  std::vector<bool> named(scene.views.size(), false);
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    if (named[i]) continue;
    Label label;
    label.anchor_in_array_mm = TopOf(scene, scene.views[i]);
    label.text = scene.views[i].name;
    bool one_group = true;
    const Eigen::Vector2d at = canvas->DisplayOf(panel, label.anchor_in_array_mm);
    for (std::size_t k = i + 1; k < scene.views.size(); ++k) {
      const Eigen::Vector2d other = canvas->DisplayOf(panel, TopOf(scene, scene.views[k]));
      if (named[k] || (other - at).norm() > near_px) continue;
      named[k] = true;
      one_group = one_group && scene.views[k].group == scene.views[i].group;
      label.text += ", " + scene.views[k].name;
    }
    label.text = Shortened(label.text);
    label.style = {9, true, one_group ? ColorOfGroup(scene, scene.views[i].group) : kInk};
    canvas->AddLabel(panel, label);
  }
}

void AddDimension(Canvas* canvas, const std::string& panel, vtkRenderer* renderer,
                  const Segment& line, double thickness_mm, const std::string& text) {
  const Eigen::Vector3d middle = 0.5 * (line.first + line.second);
  AddParts(renderer,
           {Mark(Arrow({middle, line.first}, thickness_mm), kInk, 1),
            Mark(Arrow({middle, line.second}, thickness_mm), kInk, 1)},
           nullptr, canvas->Px(1));
  Label label;
  label.text = text;
  label.anchor_in_array_mm = middle;
  label.style = {8, true, kInk};
  label.leader = false;
  canvas->AddLabel(panel, label);
}

void AddFlatArrow(Canvas* canvas, const Eigen::Vector2d& tail, const Eigen::Vector2d& tip) {
  constexpr double kInk_pt = 0.9, kHalo_pt = 0.8, kHead_pt = 3.4, kHalfAngle_rad = 0.45;
  constexpr Rgb kPaper{1, 1, 1};
  const Eigen::Vector2d along = tip - tail;
  if (along.norm() < 2) return;
  const double head_px = std::min(canvas->Px(kHead_pt), 0.5 * along.norm());
  const Eigen::Vector2d back = -head_px * along.normalized();
  const Eigen::Vector2d sides[] = {tip + Eigen::Rotation2Dd(kHalfAngle_rad) * back,
                                   tip + Eigen::Rotation2Dd(-kHalfAngle_rad) * back};
  const double ink_px = canvas->Px(kInk_pt), halo_px = ink_px + canvas->Px(kHalo_pt);
  for (const auto& [color, width_px] : {std::pair{kPaper, halo_px}, {kInk, ink_px}}) {
    canvas->Shapes().AddLine(tail, tip, color, width_px);
    for (const Eigen::Vector2d& side : sides) canvas->Shapes().AddLine(tip, side, color, width_px);
  }
}

void AddAngle(Canvas* canvas, const std::string& panel, vtkRenderer* renderer,
              const Eigen::Vector3d& center_in_array_mm, const Segment& directions,
              double radius_mm) {
  const auto& [start, end] = directions;
  const double angle_rad = std::acos(std::clamp(start.dot(end), -1.0, 1.0));
  const Eigen::Vector3d axis = start.cross(end).normalized();
  constexpr int kParts = 24;
  const auto at = [&](int i) -> Eigen::Vector3d {
    return center_in_array_mm +
           radius_mm * (Eigen::AngleAxisd(angle_rad * i / kParts, axis) * start);
  };
  std::vector<Segment> arc;
  for (int i = 0; i < kParts; ++i) arc.emplace_back(at(i), at(i + 1));
  AddParts(renderer, {Mark(Lines(arc), kInk, 0.7)}, nullptr, canvas->Px(1));
  Label label;
  label.text = FormatFixed(angle_rad * 180 / std::numbers::pi, 1) + "\u00b0";
  label.anchor_in_array_mm = at(kParts / 2);
  label.leader = false;
  canvas->AddLabel(panel, label);
}

}  // namespace telestrain::viz
