#include "viz/scene/scene_colors.h"

#include <algorithm>
#include <cmath>

namespace telestrain::viz {
namespace {

constexpr Rgb kGroupColors[] = {
    {0.00, 0.45, 0.70}, {0.84, 0.37, 0.00}, {0.80, 0.47, 0.65}, {0.90, 0.62, 0.00}};

Rgb Lighter(const Rgb& color) {
  constexpr double kShare = 0.35;
  return {color.r + kShare * (1 - color.r), color.g + kShare * (1 - color.g),
          color.b + kShare * (1 - color.b)};
}

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

ColorScale ResidualScale(const std::vector<Board>& boards) {
  std::vector<double> values_px{0};
  for (const Board& board : boards) values_px.push_back(board.rms_px);
  return ScaleFor(values_px, 0);
}

ColorMap ResidualColors(const std::vector<Board>& boards) {
  const ColorScale scale = ResidualScale(boards);
  return ColorMap::Plasma(scale.low, scale.high);
}

ColorScale RulerScale(const std::vector<RulerPosition>& rulers) {
  double largest_um = 0;
  for (const RulerPosition& ruler : rulers)
    largest_um = std::max(largest_um, std::abs(ruler.error_um));
  return ScaleFor({-largest_um, largest_um}, 0);
}

ColorMap RulerColors(const std::vector<RulerPosition>& rulers) {
  const ColorScale scale = RulerScale(rulers);
  return ColorMap::DarkViridis(scale.low, scale.high);
}

ColorScale ValueScale(const std::vector<const Surface*>& surfaces, const std::string& quantity) {
  std::vector<double> values;
  for (const Surface* surface : surfaces)
    if (const PointValues* found = surface->Find(quantity))
      for (const double value : found->values)
        if (std::isfinite(value)) values.push_back(value);
  return ScaleFor(std::move(values), 0.01);
}

ColorScale ValueScale(const Pipe& pipe, const std::string& quantity) {
  std::vector<const Surface*> surfaces;
  for (const PipeState& state : pipe.states) surfaces.push_back(&state.surface);
  return ValueScale(surfaces, quantity);
}

ColorMap ValueColorMap(const ColorScale& scale) { return ColorMap::Viridis(scale.low, scale.high); }

}  // namespace telestrain::viz
