#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "viz/color_bar.h"
#include "viz/legend.h"
#include "viz/part_actors.h"
#include "viz/pictures.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene_marks.h"

namespace telestrain::viz {
namespace {

constexpr ViewDirection kOverview{6, 34};
constexpr ViewDirection kCloseUp{0, 68};
constexpr double kOverview_pt = 142, kMargin_pt = 6;
const std::string kMicrostrain = "\u00b5\u03b5";

// What the picture shows of the pipe.
struct Shown {
  const Scene& scene;
  std::size_t state;
  Quantity quantity;
  ColorScale scale;

  const Pipe& pipe() const { return *scene.pipe; }
  const PipeState& At() const { return pipe().states[state]; }
  ValueColors Colors() const { return {quantity.key, ValueColorMap(scale)}; }
};

// 0: the results state no uncertainty, and none is printed.
std::string WithUncertainty(const Shown& shown) {
  const double expanded = shown.scene.coverage_factor * shown.At().standard_uncertainty_microstrain;
  const std::string value = NumberText(shown.At().axial_microstrain, 1) + " " + kMicrostrain;
  if (expanded == 0) return value;
  return value + " \u00b1 " + FormatFixed(expanded, 1) + " " + kMicrostrain +
         " (k = " + FormatShortest(shown.scene.coverage_factor) + ")";
}

// Where the two patches' means lie along the pipe's axis, at this distance above it.
std::array<Eigen::Vector3d, 2> BaseEnds(const Shown& shown, double above_axis_mm) {
  const Pipe& pipe = shown.pipe();
  std::array<Eigen::Vector3d, 2> ends;
  for (int group : {0, 1}) {
    const auto points = PointsOfGroup(shown.At().surface, group);
    double along_mm = 0;
    for (const Eigen::Vector3d& point : points)
      along_mm += (point - pipe.axis_point_in_array_mm).dot(pipe.axis_in_array) /
                  static_cast<double>(points.size());
    ends[static_cast<std::size_t>(group)] = pipe.axis_point_in_array_mm +
                                            along_mm * pipe.axis_in_array +
                                            above_axis_mm * AxesOf(shown.scene).up;
  }
  return ends;
}

// Dimension line of the long base with a stroke down to either patch.
void AddBaseLine(Canvas* canvas, const Shown& shown, vtkRenderer* renderer) {
  const double radius_mm = shown.pipe().radius_mm;
  const auto feet = BaseEnds(shown, 1.01 * radius_mm);
  const auto ends = BaseEnds(shown, 1.62 * radius_mm);
  const auto tops = BaseEnds(shown, 1.70 * radius_mm);
  Part strokes;
  strokes.mesh = Lines({{feet[0], tops[0]}, {feet[1], tops[1]}});
  strokes.color = kInk;
  strokes.line_width_pt = 0.5;
  AddParts(renderer, {strokes}, nullptr, canvas->Px(1));
  AddDimension(canvas, "pipe", renderer, {ends[0], ends[1]}, 0.05 * radius_mm,
               "long base " + FormatFixed(shown.pipe().base_length_mm, 3) +
                   " mm:  \u03b5 = " + WithUncertainty(shown));
}

void AddOverview(Canvas* canvas, const Shown& shown, const PixelBox& box) {
  const Pipe& pipe = shown.pipe();
  auto extent = OutlineOfPipe(pipe, DrawnSpanOf(pipe));
  // Room for the dimension line and its text above it.
  for (const Eigen::Vector3d& end : BaseEnds(shown, 2.4 * pipe.radius_mm)) extent.push_back(end);
  vtkRenderer* renderer = canvas->AddPanel(
      "pipe", box, FitCamera(extent, AxesOf(shown.scene), kOverview, box, canvas->Px(5)));
  const ValueColors colors = shown.Colors();
  AddParts(renderer, {PipePart(pipe, DrawnSpanOf(pipe))}, nullptr, canvas->Px(1));
  AddParts(renderer, SurfaceParts(shown.scene, shown.state), &colors, canvas->Px(1));
  AddParts(renderer, GaugeParts(shown.scene), nullptr, canvas->Px(1));
  AddBaseLine(canvas, shown, renderer);
}

// The mean of what the colours show over a group's points.
std::string MeanText(const Shown& shown, int group) {
  const Surface& surface = shown.At().surface;
  const std::vector<double>& values = surface.Find(shown.quantity.key)->values;
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (surface.group[i] != group || !std::isfinite(values[i])) continue;
    sum += values[i];
    ++count;
  }
  if (count == 0) return "no points";
  return "mean " + NumberText(sum / count, shown.scale.decimals + 1) +
         (shown.quantity.unit.empty() ? "" : " " + shown.quantity.unit);
}

// One group's patch seen from the instrument, its heading above.
void AddCloseUp(Canvas* canvas, const Shown& shown, int group, PixelBox box) {
  const auto index = static_cast<std::size_t>(group);
  const std::vector<std::string> groups = shown.scene.Groups();
  const std::string name = index < groups.size() ? groups[index] : std::to_string(group);
  auto points = PointsOfGroup(shown.At().surface, group);
  const TextStyle heading{8, true, kInk};
  const std::string text = "group " + Shortened(name) + ": " + MeanText(shown, group);
  const Eigen::Vector2d size = canvas->TextSize(text, heading);
  box.height -= size.y() + canvas->Px(1);
  canvas->AddText(text, {box.left + 0.5 * (box.width - size.x()), box.Top()}, heading);
  if (points.empty()) return;

  const SceneAxes axes = AxesOf(shown.scene);
  const double radius_mm = shown.pipe().radius_mm;
  const auto lower = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (a - b).dot(axes.along + axes.across) < 0;
  };
  const Eigen::Vector3d corner = *std::min_element(points.begin(), points.end(), lower);
  const ScaleBar bar{corner - 0.12 * radius_mm * axes.across, axes.along, 1.0};
  points.push_back(bar.start_in_array_mm - 0.12 * radius_mm * axes.across);
  const std::string panel = "group " + name;
  vtkRenderer* renderer =
      canvas->AddPanel(panel, box, FitCamera(points, axes, kCloseUp, box, canvas->Px(2)));
  const ValueColors colors = shown.Colors();
  AddParts(renderer, SurfaceParts(shown.scene, shown.state, group), &colors, canvas->Px(1));
  AddScaleBar(canvas, panel, renderer, bar);
}

// What the colours and signs mean, in the space between the close-ups.
Status AddKey(Canvas* canvas, const Shown& shown, const PixelBox& box) {
  const double bar_height = canvas->Px(36), triad_px = canvas->Px(40);
  const std::string unit = shown.quantity.unit.empty() ? "" : " / " + shown.quantity.unit;
  AddColorBar(canvas, ValueColorMap(shown.scale), shown.scale, shown.quantity.name + unit,
              {box.left, box.Top() - bar_height, box.width, bar_height});
  using Sign = LegendEntry::Sign;
  std::vector<LegendEntry> entries = {
      {Sign::kBox, kPipeColor, 0.3,
       "pipe, mean \u00d8 " + FormatFixed(shown.pipe().Diameter_mm(), 3) + " mm"},
      {Sign::kLine, kInk, 1, "long base between patches"},
      {Sign::kNone,
       {},
       1,
       CountOf(static_cast<int>(shown.At().surface.points_in_array_mm.size()), "point")}};
  if (!shown.pipe().gauges.empty())
    entries.push_back({Sign::kBox, kGaugeColor, 0.9,
                       CountOf(static_cast<int>(shown.pipe().gauges.size()), "strain gauge")});
  const double bottom_height = box.height - bar_height - canvas->Px(8);
  AddTriad(canvas, AxesOf(shown.scene), kOverview, {box.left, box.bottom, triad_px, bottom_height});
  const double legend_left = box.left + triad_px + canvas->Px(8);
  return AddLegend(canvas, entries,
                   {legend_left, box.bottom, box.Right() - legend_left + canvas->Px(10),
                    bottom_height - canvas->Px(6)});
}

std::string FactsOf(const Shown& shown) {
  const bool is_largest = shown.state == shown.pipe().largest_state;
  const bool is_strain = shown.quantity.key.ends_with("_microstrain");
  return "state " + std::to_string(shown.state) +
         (is_largest ? ", the one with the largest strain: cycle " : ": cycle ") +
         Shortened(shown.At().cycle) + ", step " + Shortened(shown.At().step) +
         (is_strain ? "; change against the reference state" : "");
}

}  // namespace

ColorScale StrainScale(const Surface& surface) { return ValueScale({&surface}, kAxialStrain); }

Result<Picture> DrawPipeStrain(const Scene& scene, const RenderOptions& options,
                               const PictureChoices& choices) {
  TELESTRAIN_CHECK(scene.pipe && !scene.pipe->states.empty(), "a strain picture needs a pipe");
  const std::size_t state = choices.state.value_or(scene.pipe->largest_state);
  TELESTRAIN_CHECK(state < scene.pipe->states.size(), "no such state");
  const Surface& surface = scene.pipe->states[state].surface;
  const PointValues* values = surface.Find(choices.quantity);
  TELESTRAIN_CHECK(values != nullptr, "no quantity " + choices.quantity);
  const Shown shown{scene, state, values->quantity,
                    choices.range ? ScaleOfRange(*choices.range, values->values)
                                  : ValueScale({&surface}, choices.quantity)};
  TELESTRAIN_ASSIGN_OR_RETURN(const auto canvas, Canvas::Create(options));
  const bool names_pipe = values->quantity.name.find("pipe") != std::string::npos;
  std::string title = values->quantity.name + (names_pipe ? "" : " of the pipe");
  title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
  const double top = AddTitle(canvas.get(), title, FactsOf(shown));
  const double width = canvas->Width(), overview = canvas->Px(kOverview_pt);
  const double margin = canvas->Px(kMargin_pt), lower = top - overview - margin;
  AddOverview(canvas.get(), shown, {0, top - overview, width, overview});
  AddCloseUp(canvas.get(), shown, 0, {0, margin, 0.32 * width, lower});
  AddCloseUp(canvas.get(), shown, 1, {0.68 * width, margin, 0.32 * width, lower});
  TELESTRAIN_RETURN_IF_ERROR(
      AddKey(canvas.get(), shown, {0.335 * width, margin, 0.33 * width, lower - canvas->Px(12)}));
  return canvas->Finish();
}

}  // namespace telestrain::viz
