#include <Eigen/Geometry>
#include <algorithm>

#include "base/numbers.h"
#include "viz/color_bar.h"
#include "viz/legend.h"
#include "viz/part_actors.h"
#include "viz/pictures.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene_marks.h"

namespace telestrain::viz {
namespace {

constexpr ViewDirection kFront{0, 24}, kCloseUp{0, 68};
constexpr double kMargin_pt = 6, kFooter_pt = 48, kFrontShare = 0.55;
const std::string kMicrostrain = "\u00b5\u03b5";

const PipeState& StateOf(const Scene& scene) { return scene.pipe->Largest(); }

// The gauge with what it read in this state.
std::string GaugeText(const Scene& scene, std::size_t index) {
  std::string text = Shortened(scene.pipe->gauges[index].name);
  const auto& read = StateOf(scene).gauge_microstrain;
  if (index < read.size() && read[index])
    text += ": " + NumberText(*read[index], 1) + " " + kMicrostrain;
  return text;
}

// Every gauge with its reading; those on the far side are seen through the pipe.
void NameGauges(Canvas* canvas, const std::string& panel, const Scene& scene,
                const Eigen::Vector3d& towards_viewer) {
  const Pipe& pipe = *scene.pipe;
  for (std::size_t i = 0; i < pipe.gauges.size(); ++i) {
    const bool behind = pipe.gauges[i].outward_in_array.dot(towards_viewer) < 0;
    Label label;
    label.text = GaugeText(scene, i) + (behind ? ", behind" : "");
    label.anchor_in_array_mm = pipe.gauges[i].center_in_array_mm;
    label.preferred_deg = pipe.gauges[i].outward_in_array.dot(AxesOf(scene).up) < -0.5 ? -90 : 90;
    canvas->AddLabel(panel, label);
  }
}

void AddFront(Canvas* canvas, const Scene& scene, const PixelBox& box) {
  const Pipe& pipe = *scene.pipe;
  const ValueColors colors{kAxialStrain, ValueColorMap(StrainScale(StateOf(scene).surface))};
  auto extent = OutlineOfPipe(pipe, DrawnSpanOf(pipe));
  const SceneAxes axes = AxesOf(scene);
  ScaleBar bar = ScaleBarBelow(extent, axes, 0.3);
  bar.start_in_array_mm -= 0.5 * pipe.radius_mm * axes.across;
  extent.push_back(bar.start_in_array_mm - 0.3 * pipe.radius_mm * axes.up);
  extent.push_back(pipe.axis_point_in_array_mm + 1.4 * pipe.radius_mm * axes.up);
  const ParallelCamera camera = FitCamera(extent, axes, kFront, box, canvas->Px(4));
  vtkRenderer* renderer = canvas->AddPanel("front", box, camera);
  AddParts(renderer, {PipePart(pipe, DrawnSpanOf(pipe))}, nullptr, canvas->Px(1));
  AddParts(renderer, SurfaceParts(scene, pipe.largest_state), &colors, canvas->Px(1));
  AddParts(renderer, GaugeParts(scene), nullptr, canvas->Px(1));
  AddParts(renderer, DisplacementParts(scene, pipe.largest_state, DisplacementFactor(scene)),
           nullptr, canvas->Px(1));
  AddScaleBar(canvas, "front", renderer, bar);
  NameGauges(canvas, "front", scene, camera.towards_viewer);
}

// One group's region with its arrows, its heading above.
void AddCloseUp(Canvas* canvas, const Scene& scene, int group, PixelBox box) {
  const Pipe& pipe = *scene.pipe;
  const std::vector<std::string> groups = scene.Groups();
  const auto points = PointsOfGroup(StateOf(scene).surface, group);
  const auto index = static_cast<std::size_t>(group);
  if (points.empty() || index >= groups.size()) return;
  const TextStyle heading{8, true, kInk};
  const std::string text = "displacement in group " + Shortened(groups[index]);
  const Eigen::Vector2d size = canvas->TextSize(text, heading);
  box.height -= size.y() + canvas->Px(2);
  canvas->AddText(text, {box.left + 0.5 * (box.width - size.x()), box.Top()}, heading);
  const std::vector<Part> arrows =
      DisplacementParts(scene, pipe.largest_state, DisplacementFactor(scene));
  std::vector<Eigen::Vector3d> extent = points;
  // The arrows of both groups are one part: those near this group's points count.
  for (const Eigen::Vector3d& point : PointsOf(arrows))
    if ((point - points[points.size() / 2]).norm() < 0.35 * pipe.base_length_mm)
      extent.push_back(point);
  const std::string panel = "group " + groups[index];
  vtkRenderer* renderer =
      canvas->AddPanel(panel, box, FitCamera(extent, AxesOf(scene), kCloseUp, box, canvas->Px(3)));
  const ValueColors colors{kAxialStrain, ValueColorMap(StrainScale(StateOf(scene).surface))};
  AddParts(renderer, SurfaceParts(scene, pipe.largest_state, group), &colors, canvas->Px(1));
  AddParts(renderer, arrows, nullptr, canvas->Px(1));
}

Status AddFooter(Canvas* canvas, const Scene& scene) {
  const Pipe& pipe = *scene.pipe;
  const Surface& surface = StateOf(scene).surface;
  const double margin = canvas->Px(kMargin_pt), height = canvas->Px(kFooter_pt);
  const double triad_px = canvas->Px(48), bar_px = canvas->Px(134);
  const double bar_left = canvas->Width() - bar_px - canvas->Px(14);
  AddTriad(canvas, AxesOf(scene), kFront, {margin, margin, triad_px, height - margin});
  double longest_mm = 0;
  for (const Eigen::Vector3d& displacement : surface.displacement_mm)
    longest_mm = std::max(longest_mm, displacement.norm());
  using Sign = LegendEntry::Sign;
  std::vector<LegendEntry> entries{
      {Sign::kBox, kPipeColor, 0.3,
       "nominal pipe; mean \u00d8 " + FormatFixed(pipe.Diameter_mm(), 3) + " mm"}};
  if (longest_mm > 0)
    entries.push_back({Sign::kLine, kArrowColor, 1,
                       "displacement \u00d7 " + FormatShortest(DisplacementFactor(scene)) +
                           ", longest " + FormatFixed(1000 * longest_mm, 1) + " \u00b5m"});
  if (!pipe.gauges.empty())
    entries.push_back({Sign::kBox, kGaugeColor, 0.9, "strain gauge with its reading"});
  TELESTRAIN_RETURN_IF_ERROR(
      AddLegend(canvas, entries,
                {margin + triad_px + canvas->Px(8), margin,
                 bar_left - 2 * margin - triad_px - canvas->Px(8), height - margin}));
  const ColorScale scale = StrainScale(surface);
  AddColorBar(canvas, ValueColorMap(scale), scale, "axial strain / " + kMicrostrain,
              {bar_left, 0, bar_px, height});
  return {};
}

}  // namespace

Result<Picture> DrawPipe(const Scene& scene, const RenderOptions& options) {
  TELESTRAIN_CHECK(scene.pipe && !scene.pipe->states.empty(), "a picture of a pipe needs one");
  TELESTRAIN_ASSIGN_OR_RETURN(const auto canvas, Canvas::Create(options));
  const PipeState& state = StateOf(scene);
  const double top = AddTitle(canvas.get(), "The pipe: displacement and strain gauges",
                              "state with the largest strain: cycle " + Shortened(state.cycle) +
                                  ", step " + Shortened(state.step) +
                                  "; displacement against the reference state, rigid motion in it");
  const double footer = canvas->Px(kFooter_pt + kMargin_pt);
  const double height = top - footer, split = footer + (1 - kFrontShare) * height;
  AddFront(canvas.get(), scene, {0, split, canvas->Width(), top - split});
  for (const int group : {0, 1})
    AddCloseUp(canvas.get(), scene, group,
               {0.5 * group * canvas->Width(), footer, 0.5 * canvas->Width(),
                split - footer - canvas->Px(6)});
  TELESTRAIN_RETURN_IF_ERROR(AddFooter(canvas.get(), scene));
  return canvas->Finish();
}

}  // namespace telestrain::viz
