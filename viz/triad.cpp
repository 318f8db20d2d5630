#include <cmath>
#include <numbers>

#include "viz/actors.h"

namespace telestrain::viz {

void AddTriad(Canvas* canvas, const SceneAxes& axes, const ViewDirection& direction,
              const PixelBox& box) {
  constexpr Rgb kColors[3] = {{0.75, 0.15, 0.15}, {0.15, 0.50, 0.20}, {0.15, 0.30, 0.70}};
  static constexpr const char* kNames[3] = {"x", "y", "z"};
  std::vector<Eigen::Vector3d> ends{Eigen::Vector3d::Zero()};
  for (int i = 0; i < 3; ++i) ends.push_back(Eigen::Vector3d::Unit(i));
  const ParallelCamera camera = FitCamera(ends, axes, direction, box, canvas->Px(10));
  vtkRenderer* renderer = canvas->AddPanel("triad", box, camera);
  const Eigen::Vector2d origin = canvas->DisplayOf("triad", ends[0]);
  for (int i = 0; i < 3; ++i) {
    AddArrow(renderer, {ends[0], ends[i + 1]}, 0.06, kColors[i]);
    const Eigen::Vector2d out = canvas->DisplayOf("triad", ends[i + 1]) - origin;
    Label label;
    label.text = kNames[i];
    label.anchor_in_array_mm = ends[i + 1];
    // y often lies nearly behind z in the picture: its name steps aside.
    label.preferred_deg =
        std::atan2(out.y(), out.x()) * 180 / std::numbers::pi - (i == 1 ? 60.0 : 0.0);
    label.style = {8, true, kColors[i]};
    label.leader = false;
    canvas->AddLabel("triad", label);
  }
}

double RoundLength(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= length) return factor * power;
  return power;
}

void AddScaleBar(Canvas* canvas, const std::string& panel, vtkRenderer* renderer,
                 const ScaleBar& bar) {
  AddLines(renderer, {{bar.start_in_array_mm, bar.End()}}, kInk, canvas->Px(1.8));
  Label label;
  label.text = NumberText(bar.length_mm, bar.length_mm < 1 ? 1 : 0) + " mm";
  label.anchor_in_array_mm = 0.5 * (bar.start_in_array_mm + bar.End());
  label.preferred_deg = -90;
  label.leader = false;
  canvas->AddLabel(panel, label);
}

}  // namespace telestrain::viz
