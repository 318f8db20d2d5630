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

constexpr ViewDirection kFront{0, 24}, kFromInstrument{0, 90};
constexpr double kMargin_pt = 6, kFooter_pt = 48, kFrontShare = 0.52;
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

// Gauges on the near side of the pipe, named.
void NameGauges(Canvas* canvas, const std::string& panel, const Scene& scene,
                const Eigen::Vector3d& towards_viewer) {
  const Pipe& pipe = *scene.pipe;
  for (std::size_t i = 0; i < pipe.gauges.size(); ++i) {
    if (pipe.gauges[i].outward_in_array.dot(towards_viewer) < -0.2) continue;
    Label label;
    label.text = GaugeText(scene, i);
    label.anchor_in_array_mm = pipe.gauges[i].center_in_array_mm;
    canvas->AddLabel(panel, label);
  }
}

void AddPanelOfPipe(Canvas* canvas, const Scene& scene, const std::string& name,
                    const ViewDirection& direction, const PixelBox& box, bool with_arrows) {
  const Pipe& pipe = *scene.pipe;
  const ColorScale scale = StrainScale(StateOf(scene).surface);
  const ValueColors colors{kAxialStrain, ValueColorMap(scale)};
  auto extent = OutlineOfPipe(pipe, DrawnSpanOf(pipe));
  const SceneAxes axes = AxesOf(scene);
  const ScaleBar bar = ScaleBarBelow(extent, axes, 0.3);
  const double drop_mm = 0.35 * pipe.radius_mm;
  const ScaleBar lower{bar.start_in_array_mm - drop_mm * (axes.up + axes.across), bar.direction,
                       bar.length_mm};
  extent.push_back(lower.start_in_array_mm - drop_mm * (axes.up + axes.across));
  extent.push_back(pipe.axis_point_in_array_mm + 2.1 * pipe.radius_mm * axes.up);
  const ParallelCamera camera = FitCamera(extent, axes, direction, box, canvas->Px(8));
  vtkRenderer* renderer = canvas->AddPanel(name, box, camera);
  AddParts(renderer, {PipePart(pipe, DrawnSpanOf(pipe))}, nullptr, canvas->Px(1));
  AddParts(renderer, SurfaceParts(scene, pipe.largest_state), &colors, canvas->Px(1));
  AddParts(renderer, GaugeParts(scene), nullptr, canvas->Px(1));
  if (with_arrows)
    AddParts(renderer, DisplacementParts(scene, pipe.largest_state, DisplacementFactor(scene)),
             nullptr, canvas->Px(1));
  AddScaleBar(canvas, name, renderer, lower);
  NameGauges(canvas, name, scene, camera.towards_viewer);
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
       "nominal pipe; fitted \u00d8 " + FormatFixed(2 * pipe.radius_mm, 3) + " mm"}};
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
  AddPanelOfPipe(canvas.get(), scene, "front", kFront, {0, split, canvas->Width(), top - split},
                 true);
  AddPanelOfPipe(canvas.get(), scene, "from the instrument", kFromInstrument,
                 {0, footer, canvas->Width(), split - footer}, false);
  TELESTRAIN_RETURN_IF_ERROR(AddFooter(canvas.get(), scene));
  return canvas->Finish();
}

}  // namespace telestrain::viz
