#include "viz/array_key.h"

#include "base/numbers.h"
#include "viz/color_bar.h"
#include "viz/legend.h"
#include "viz/pictures.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene_marks.h"

namespace telestrain::viz {
namespace {

constexpr double kFooter_pt = 60, kMargin_pt = 6;

std::vector<LegendEntry> LegendOf(const Scene& scene) {
  using Sign = LegendEntry::Sign;
  std::vector<LegendEntry> entries;
  std::vector<std::string> groups = scene.Groups();
  for (const std::string& group : groups) {
    std::string names;
    int count = 0;
    for (const ViewVolume& view : scene.views)
      if (view.group == group) names += (count++ == 0 ? "" : ", ") + view.name;
    constexpr int kMostNamed = 3;
    const std::string members = count > kMostNamed ? CountOf(count, "view") : "views " + names;
    entries.push_back({Sign::kBox, ColorOfGroup(scene, group), 0.3,
                       "group " + Shortened(group) + ": " + Shortened(members)});
  }
  const std::string depth_mm = FormatFixed(scene.views.front().depth_of_field_mm, 1);
  entries.push_back({Sign::kNone, {}, 1, "dark: depth of field " + depth_mm + " mm"});
  entries.push_back({Sign::kLine, kImageXColor, 1, "pixel axis u"});
  entries.push_back({Sign::kLine, kImageYColor, 1, "pixel axis v"});
  entries.push_back({Sign::kFrame, ColorMap::Plasma(0, 1).At(0.4), 1,
                     CountOf(static_cast<int>(scene.boards.size()), "board") + " in " +
                         CountOf(scene.target_poses, "pose")});
  if (scene.pipe)
    entries.push_back({Sign::kBox, kPipeColor, 0.3,
                       "pipe, mean \u00d8 " + FormatFixed(scene.pipe->Diameter_mm(), 3) + " mm"});
  else
    entries.push_back({Sign::kNone, {}, 1, "no pipe measured"});
  if (scene.pipe && !scene.pipe->gauges.empty())
    entries.push_back({Sign::kBox, kGaugeColor, 0.9,
                       CountOf(static_cast<int>(scene.pipe->gauges.size()), "strain gauge")});
  return entries;
}

}  // namespace

double ArrayKeyHeight(const Canvas& canvas) { return canvas.Px(kFooter_pt + kMargin_pt); }

Status AddArrayKey(Canvas* canvas, const Scene& scene, const ViewDirection& direction) {
  const double margin = canvas->Px(kMargin_pt), height = canvas->Px(kFooter_pt);
  const double triad_px = canvas->Px(48), bar_px = canvas->Px(104);
  const double bar_left = canvas->Width() - bar_px - canvas->Px(18);
  AddTriad(canvas, AxesOf(scene), direction, {margin, margin, triad_px, height - margin});
  const double legend_left = margin + triad_px + canvas->Px(4);
  const double legend_px = bar_left - legend_left - canvas->Px(6);
  std::optional<ColorMap> strain_colors;
  std::vector<LegendEntry> entries = LegendOf(scene);
  if (scene.pipe) {
    const ColorScale scale = StrainScale(scene.pipe->Largest().surface);
    strain_colors = ValueColorMap(scale);
    entries.push_back({LegendEntry::Sign::kColors,
                       {},
                       1,
                       "axial strain " + NumberText(scale.low, scale.decimals) + " to " +
                           NumberText(scale.high, scale.decimals) + " \u00b5\u03b5",
                       &*strain_colors});
  }
  TELESTRAIN_RETURN_IF_ERROR(
      AddLegend(canvas, entries, {legend_left, margin, legend_px, height - margin}));
  const ColorScale residual = ResidualScale(scene.boards);
  AddColorBar(canvas, ResidualColors(scene.boards), residual, "board residual RMS / px",
              {bar_left, 0, bar_px, height},
              LimitMarks(scene.limits.reprojection_rms_px, "px", residual));
  return {};
}

}  // namespace telestrain::viz
