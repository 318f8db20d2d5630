#include <algorithm>

#include "base/numbers.h"
#include "viz/actors.h"
#include "viz/color_bar.h"
#include "viz/legend.h"

namespace telestrain::viz {
namespace {

constexpr ViewDirection kOverview{6, 34};
constexpr ViewDirection kCloseUp{0, 68};
constexpr double kOverview_pt = 142, kMargin_pt = 6;
const std::string kMicrostrain = "\u00b5\u03b5";

ColorMap StrainColors(const Pipe& pipe) {
  const ColorScale scale = StrainScale(pipe.Largest().surface);
  return ColorMap::Viridis(scale.low, scale.high);
}

std::string WithUncertainty(const Scene& scene) {
  const double expanded =
      scene.coverage_factor * scene.pipe->Largest().standard_uncertainty_microstrain;
  return NumberText(scene.pipe->Largest().axial_microstrain, 1) + " " + kMicrostrain + " \u00b1 " +
         FormatFixed(expanded, 1) + " " + kMicrostrain +
         " (k = " + FormatShortest(scene.coverage_factor) + ")";
}

// Where the two patches' means lie along the pipe's axis, at this distance above it.
std::array<Eigen::Vector3d, 2> BaseEnds(const Scene& scene, double above_axis_mm) {
  const Pipe& pipe = *scene.pipe;
  std::array<Eigen::Vector3d, 2> ends;
  for (int group : {0, 1}) {
    const auto points = PointsOfGroup(pipe.Largest().surface, group);
    double along_mm = 0;
    for (const Eigen::Vector3d& point : points)
      along_mm += (point - pipe.axis_point_in_array_mm).dot(pipe.axis_in_array) /
                  static_cast<double>(points.size());
    ends[static_cast<std::size_t>(group)] = pipe.axis_point_in_array_mm +
                                            along_mm * pipe.axis_in_array +
                                            above_axis_mm * AxesOf(scene).up;
  }
  return ends;
}

// Dimension line of the long base with a stroke down to either patch.
void AddBaseLine(Canvas* canvas, const Scene& scene, vtkRenderer* renderer) {
  const Pipe& pipe = *scene.pipe;
  const auto feet = BaseEnds(scene, 1.01 * pipe.radius_mm);
  const auto ends = BaseEnds(scene, 1.62 * pipe.radius_mm);
  const auto tops = BaseEnds(scene, 1.70 * pipe.radius_mm);
  const Eigen::Vector3d middle = 0.5 * (ends[0] + ends[1]);
  AddLines(renderer, {{feet[0], tops[0]}, {feet[1], tops[1]}}, kInk, canvas->Px(0.5));
  const double thickness_mm = 0.05 * pipe.radius_mm;
  AddArrow(renderer, {middle, ends[0]}, thickness_mm, kInk);
  AddArrow(renderer, {middle, ends[1]}, thickness_mm, kInk);
  Label label;
  label.text = "long base " + FormatFixed(pipe.base_length_mm, 3) +
               " mm:  \u03b5 = " + WithUncertainty(scene);
  label.anchor_in_array_mm = middle;
  label.style = {8, true, kInk};
  label.leader = false;
  canvas->AddLabel("pipe", label);
}

void AddOverview(Canvas* canvas, const Scene& scene, const PixelBox& box) {
  const Pipe& pipe = *scene.pipe;
  auto extent = OutlineOfPipe(pipe, DrawnSpanOf(pipe));
  // Room for the dimension line and its text above it.
  for (const Eigen::Vector3d& end : BaseEnds(scene, 2.4 * pipe.radius_mm)) extent.push_back(end);
  vtkRenderer* renderer = canvas->AddPanel(
      "pipe", box, FitCamera(extent, AxesOf(scene), kOverview, box, canvas->Px(5)));
  AddNominalPipe(renderer, pipe, DrawnSpanOf(pipe), canvas->Px(1));
  AddStrainSurface(renderer, pipe.Largest().surface, StrainColors(pipe));
  AddBaseLine(canvas, scene, renderer);
}

// One group's patch seen from the instrument, its heading above.
void AddCloseUp(Canvas* canvas, const Scene& scene, int group, PixelBox box) {
  const Pipe& pipe = *scene.pipe;
  const auto index = static_cast<std::size_t>(group);
  const std::vector<std::string> groups = scene.Groups();
  const std::string name = index < groups.size() ? groups[index] : std::to_string(group);
  auto points = PointsOfGroup(pipe.Largest().surface, group);
  const TextStyle heading{8, true, kInk};
  const std::string text = "group " + Shortened(name) + ": local mean " +
                           NumberText(pipe.Largest().local_microstrain[index], 1) + " " +
                           kMicrostrain + (points.empty() ? ", no points" : "");
  const Eigen::Vector2d size = canvas->TextSize(text, heading);
  box.height -= size.y() + canvas->Px(1);
  canvas->AddText(text, {box.left + 0.5 * (box.width - size.x()), box.Top()}, heading);
  if (points.empty()) return;

  const SceneAxes axes = AxesOf(scene);
  const auto lower = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (a - b).dot(axes.along + axes.across) < 0;
  };
  const Eigen::Vector3d corner = *std::min_element(points.begin(), points.end(), lower);
  const ScaleBar bar{corner - 0.12 * pipe.radius_mm * axes.across, axes.along, 1.0};
  points.push_back(bar.start_in_array_mm - 0.12 * pipe.radius_mm * axes.across);
  const std::string panel = "group " + name;
  vtkRenderer* renderer =
      canvas->AddPanel(panel, box, FitCamera(points, axes, kCloseUp, box, canvas->Px(2)));
  AddStrainSurface(renderer, pipe.Largest().surface, StrainColors(pipe), group);
  AddPatchEdge(renderer, pipe.Largest().surface, group, canvas->Px(1));
  AddScaleBar(canvas, panel, renderer, bar);
}

// What the colours and signs mean, in the space between the close-ups.
Status AddKey(Canvas* canvas, const Scene& scene, const PixelBox& box) {
  const Pipe& pipe = *scene.pipe;
  const double bar_height = canvas->Px(36), triad_px = canvas->Px(40);
  AddColorBar(canvas, StrainColors(pipe), StrainScale(pipe.Largest().surface),
              "axial strain / " + kMicrostrain,
              {box.left, box.Top() - bar_height, box.width, bar_height});
  using Sign = LegendEntry::Sign;
  const std::vector<LegendEntry> entries = {
      {Sign::kBox, kPipeColor, 0.3,
       "pipe, fitted \u00d8 " + FormatFixed(2 * pipe.radius_mm, 3) + " mm"},
      {Sign::kLine, kInk, 1, "long base between patches"},
      {Sign::kNone,
       {},
       1,
       CountOf(static_cast<int>(pipe.Largest().surface.points_in_array_mm.size()), "point")}};
  const double bottom_height = box.height - bar_height - canvas->Px(8);
  AddTriad(canvas, AxesOf(scene), kOverview, {box.left, box.bottom, triad_px, bottom_height});
  const double legend_left = box.left + triad_px + canvas->Px(8);
  return AddLegend(canvas, entries,
                   {legend_left, box.bottom, box.Right() - legend_left + canvas->Px(10),
                    bottom_height - canvas->Px(6)});
}

}  // namespace

// A hundredth of the points at either end may be noise of single subsets.
ColorScale StrainScale(const Surface& surface) {
  return ScaleFor(surface.values.front().values, 0.01);
}

Result<Picture> DrawPipeStrain(const Scene& scene, const RenderOptions& options) {
  TELESTRAIN_CHECK(scene.pipe.has_value(), "a strain picture needs a measured pipe");
  TELESTRAIN_ASSIGN_OR_RETURN(const auto canvas, Canvas::Create(options));
  const double top =
      AddTitle(canvas.get(), "Axial strain of the pipe",
               "state with the largest strain: cycle " + Shortened(scene.pipe->Largest().cycle) +
                   ", step " + Shortened(scene.pipe->Largest().step) +
                   "; change against the reference state, positive in tension");
  const double width = canvas->Width(), overview = canvas->Px(kOverview_pt);
  const double margin = canvas->Px(kMargin_pt), lower = top - overview - margin;
  AddOverview(canvas.get(), scene, {0, top - overview, width, overview});
  AddCloseUp(canvas.get(), scene, 0, {0, margin, 0.32 * width, lower});
  AddCloseUp(canvas.get(), scene, 1, {0.68 * width, margin, 0.32 * width, lower});
  TELESTRAIN_RETURN_IF_ERROR(
      AddKey(canvas.get(), scene, {0.335 * width, margin, 0.33 * width, lower - canvas->Px(12)}));
  return canvas->Finish();
}

}  // namespace telestrain::viz
