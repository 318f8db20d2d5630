#include "viz/rig_labels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "viz/legend.h"
#include "viz/scene/scene_colors.h"

namespace telestrain::viz {
namespace {

// Mirrors that lie behind one another in a panel, to be named together.
struct MirrorName {
  std::vector<std::string> views, mirrors;  // every mirror of every view
  std::string group;                        // empty: of several groups
  Eigen::Vector2d middle_px;
  Eigen::Vector2d outward_px;  // to the outer side of the bend that light makes there
  std::vector<Eigen::Vector3d> corners;

  std::string Text() const {
    std::string text;
    for (const std::string& view : views) text += (text.empty() ? "" : ", ") + view;
    for (std::size_t i = 0; i < mirrors.size(); ++i)
      text += (i > 0 ? ", " : views.size() > 1 ? ": " : " ") + mirrors[i];
    return text;
  }
};

void AddOnce(std::vector<std::string>& words, const std::string& word) {
  if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
}

// Where a mirror's name goes: to the outer side of the bend of its middle ray in the panel.
Eigen::Vector2d OutwardOf(const Canvas& canvas, const std::string& panel, const ViewDesign& view,
                          std::size_t mirror, const Eigen::Vector2d& middle_px) {
  constexpr double kAsideShare = 0.5;
  const auto corners = view.middle_ray.Corners();
  const auto step = [&](std::size_t i) -> Eigen::Vector2d {
    return canvas.DisplayOf(panel, corners[i + 1]) - canvas.DisplayOf(panel, corners[i]);
  };
  const Eigen::Vector2d before = step(mirror), after = step(mirror + 1);
  const Eigen::Vector2d bend = before.stableNormalized() - after.stableNormalized();
  // Where the bend is not seen, or points to the middle of all: away from it.
  const Eigen::Vector2d aside = canvas.DisplayOf(panel, corners[mirror + 1]) - middle_px;
  const Eigen::Vector2d outward = bend + kAsideShare * aside.stableNormalized();
  return outward.norm() > 1e-3 ? outward.normalized() : Eigen::Vector2d(0, 1);
}

Eigen::Vector2d MiddleOfMirrors(const Canvas& canvas, const std::string& panel,
                                const RigDesign& design) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (const ViewDesign& view : design.views)
    for (const MirrorDesign& mirror : view.plates)
      sum += canvas.DisplayOf(panel, mirror.plate.origin_mm), ++count;
  return sum / std::max(count, 1);
}

std::vector<MirrorName> MirrorNames(const Canvas& canvas, const std::string& panel,
                                    const RigDrawing& drawing) {
  constexpr double kSame_pt = 3;
  std::vector<MirrorName> names;
  const Eigen::Vector2d middle_px = MiddleOfMirrors(canvas, panel, drawing.design);
  for (const ViewDesign& view : drawing.design.views)
    for (const MirrorDesign& mirror : view.plates) {
      const Eigen::Vector2d at_px = canvas.DisplayOf(panel, mirror.plate.origin_mm);
      auto name = std::find_if(names.begin(), names.end(), [&](const MirrorName& other) {
        return (other.middle_px - at_px).norm() < canvas.Px(kSame_pt);
      });
      const auto index = static_cast<std::size_t>(mirror.plate.mirror);
      if (name == names.end())
        name = names.insert(
            name,
            {{}, {}, view.group, at_px, OutwardOf(canvas, panel, view, index, middle_px), {}});
      AddOnce(name->views, Shortened(view.name));
      AddOnce(name->mirrors, "M" + std::to_string(index + 1));
      if (name->group != view.group) name->group.clear();
      for (const Eigen::Vector3d& corner : mirror.plate.Corners()) name->corners.push_back(corner);
    }
  return names;
}

}  // namespace

void NameMirrors(Canvas* canvas, const std::string& panel, const RigDrawing& drawing) {
  for (const MirrorName& name : MirrorNames(*canvas, panel, drawing)) {
    if (name.corners.empty()) continue;
    Label label;
    label.text = name.Text();
    label.anchor_in_array_mm = *std::max_element(
        name.corners.begin(), name.corners.end(), [&](const auto& a, const auto& b) {
          return name.outward_px.dot(canvas->DisplayOf(panel, a) - canvas->DisplayOf(panel, b)) < 0;
        });
    label.preferred_deg =
        std::atan2(name.outward_px.y(), name.outward_px.x()) * 180 / std::numbers::pi;
    label.style = {7, true, name.group.empty() ? kInk : ColorOfGroup(drawing.scene, name.group)};
    canvas->AddLabel(panel, label);
  }
}

void NameSensor(Canvas* canvas, const std::string& panel, const RigDrawing& drawing) {
  const Rectangle sensor = SensorPart(drawing.rig, WholeField(drawing.rig), drawing.sensor_mm);
  Label label;
  label.text = "sensor";
  label.anchor_in_array_mm =
      *std::max_element(sensor.begin(), sensor.end(), [&](const auto& a, const auto& b) {
        return canvas->DisplayOf(panel, a).x() < canvas->DisplayOf(panel, b).x();
      });
  label.preferred_deg = 30;
  label.style = {7, true, kSensorColor};
  canvas->AddLabel(panel, label);
}

}  // namespace telestrain::viz
