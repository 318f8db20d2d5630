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

constexpr ViewDirection kOverview{0, 24};
constexpr ViewDirection kCloseUp{28, 26};
constexpr double kFooter_pt = 60, kOverview_pt = 58, kMargin_pt = 6;
constexpr double kRulerStub_mm = 0.35;

std::vector<Board> BoardsOf(const Scene& scene, const std::string& group) {
  std::vector<Board> boards;
  for (const Board& board : scene.boards)
    if (group.empty() || board.group == group) boards.push_back(board);
  return boards;
}

// Everything that a close-up of the boards shows; never empty.
std::vector<Eigen::Vector3d> ExtentOf(const Scene& scene, const std::string& group) {
  std::vector<Eigen::Vector3d> points;
  for (const Board& board : BoardsOf(scene, group))
    points.insert(points.end(), board.outline_in_array_mm.begin(), board.outline_in_array_mm.end());
  if (!points.empty()) return points;
  for (const ViewVolume& view : scene.views)
    if (group.empty() || view.group == group)
      for (const Eigen::Vector3d& corner : view.Section(0)) points.push_back(corner);
  return points;
}

// A bar below the front edge of what the panel shows.
ScaleBar BarBelow(const std::vector<Eigen::Vector3d>& extent, const SceneAxes& axes) {
  Eigen::Matrix3d from_array;
  from_array << axes.along.transpose(), axes.across.transpose(), axes.up.transpose();
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& point : extent) bounds.extend(Eigen::Vector3d(from_array * point));
  const double drop_mm = 0.15 * bounds.sizes().y();
  const Eigen::Vector3d start(bounds.min().x(), bounds.min().y(), bounds.min().z() - drop_mm);
  return {from_array.transpose() * start, axes.along, RoundDown(0.3 * bounds.sizes().x())};
}

void AddOverview(Canvas* canvas, const Scene& scene, const PixelBox& box) {
  const auto extent = ExtentOf(scene, "");
  vtkRenderer* renderer = canvas->AddPanel(
      "overview", box, FitCamera(extent, AxesOf(scene), kOverview, box, canvas->Px(9)));
  AddParts(renderer, BoardParts(scene), nullptr, canvas->Px(0.7));
  AddParts(renderer, RulerParts(scene), nullptr, canvas->Px(1));
}

// One group's boards, with a heading above.
void AddCloseUp(Canvas* canvas, const Scene& scene, const std::string& group, PixelBox box) {
  const std::vector<Board> boards = BoardsOf(scene, group);
  const TextStyle heading{8, true, kInk};
  std::string text =
      "group " + Shortened(group) + ": " + CountOf(static_cast<int>(boards.size()), "board");
  if (!boards.empty()) {
    const auto [best, worst] =
        std::minmax_element(boards.begin(), boards.end(),
                            [](const Board& a, const Board& b) { return a.rms_px < b.rms_px; });
    text += ", " + FormatFixed(best->rms_px, 4) + " to " + FormatFixed(worst->rms_px, 4) + " px";
  }
  const Eigen::Vector2d size = canvas->TextSize(text, heading);
  box.height -= size.y() + canvas->Px(1);
  canvas->AddText(text, {box.left + canvas->Px(kMargin_pt), box.Top()}, heading);

  const std::string panel = "group " + group;
  const SceneAxes axes = AxesOf(scene);
  auto extent = ExtentOf(scene, group);
  const ScaleBar bar = BarBelow(extent, axes);
  extent.push_back(bar.start_in_array_mm);
  vtkRenderer* renderer =
      canvas->AddPanel(panel, box, FitCamera(extent, axes, kCloseUp, box, canvas->Px(9)));
  AddParts(renderer, BoardParts(scene, group), nullptr, canvas->Px(1.2));
  AddParts(renderer, RulerParts(scene, kRulerStub_mm), nullptr, canvas->Px(1));
  AddScaleBar(canvas, panel, renderer, bar);
}

std::vector<LegendEntry> LegendOf(const Scene& scene) {
  using Sign = LegendEntry::Sign;
  std::vector<LegendEntry> entries;
  entries.push_back({Sign::kFrame, ColorMap::Plasma(0, 1).At(0.4), 1,
                     std::to_string(scene.boards.size()) + " boards"});
  entries.push_back({Sign::kBox,
                     {0.6, 0.6, 0.6},
                     0.5,
                     CountOf(scene.rejected_board_views, "board view") + " rejected"});
  if (scene.rulers.empty() && scene.rejected_rulers == 0) {
    entries.push_back({Sign::kNone, {}, 1, "no ruler measured"});
    return entries;
  }
  entries.push_back({Sign::kLine, RulerColors(scene.rulers).At(0), 1,
                     CountOf(static_cast<int>(scene.rulers.size()), "ruler position")});
  const auto failed = std::count_if(scene.rulers.begin(), scene.rulers.end(),
                                    [](const RulerPosition& r) { return r.verdict == "fail"; });
  if (failed > 0)
    entries.push_back({Sign::kLine, kFailColor, 1,
                       CountOf(static_cast<int>(failed), "ruler position") + " outside the limit"});
  if (scene.rejected_rulers > 0)
    entries.push_back({Sign::kBox,
                       {0.6, 0.6, 0.6},
                       0.5,
                       CountOf(scene.rejected_rulers, "ruler image") + " rejected"});
  return entries;
}

Status AddFooter(Canvas* canvas, const Scene& scene) {
  const double margin = canvas->Px(kMargin_pt), height = canvas->Px(kFooter_pt);
  const double triad_px = canvas->Px(50), bar_px = canvas->Px(92), gap_px = canvas->Px(30);
  const double bar_left = canvas->Width() - 2 * bar_px - gap_px - canvas->Px(18);
  AddTriad(canvas, AxesOf(scene), kCloseUp, {margin, margin, triad_px, height - margin});
  const double legend_left = margin + triad_px + canvas->Px(8);
  TELESTRAIN_RETURN_IF_ERROR(
      AddLegend(canvas, LegendOf(scene),
                {legend_left, margin, bar_left - legend_left - canvas->Px(8), height - margin}));
  const ColorScale residual = ResidualScale(scene.boards), error = RulerScale(scene.rulers);
  AddColorBar(canvas, ResidualColors(scene.boards), residual, "board residual RMS / px",
              {bar_left, 0, bar_px, height},
              LimitMarks(scene.limits.reprojection_rms_px, "px", residual));
  if (!scene.rulers.empty())
    AddColorBar(canvas, RulerColors(scene.rulers), error, "ruler length error / \u00b5m",
                {bar_left + bar_px + gap_px, 0, bar_px, height},
                LimitMarks(scene.limits.ruler_mpe_um, "\u00b5m", error));
  return {};
}

}  // namespace

Result<Picture> DrawTargets(const Scene& scene, const RenderOptions& options) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto canvas, Canvas::Create(options));
  const double top =
      AddTitle(canvas.get(), "Target poses and ruler positions",
               CountOf(scene.target_poses, "target image") + "; reprojection RMS " +
                   FormatFixed(scene.reprojection_rms_px, 4) + " px over all boards");
  const double footer = canvas->Px(kFooter_pt + kMargin_pt);
  const double overview = canvas->Px(kOverview_pt);
  AddOverview(canvas.get(), scene, {0, top - overview, canvas->Width(), overview});
  const std::vector<std::string> groups = scene.Groups();
  const double width = canvas->Width() / static_cast<double>(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i)
    AddCloseUp(canvas.get(), scene, groups[i],
               {static_cast<double>(i) * width, footer, width, top - overview - footer});
  TELESTRAIN_RETURN_IF_ERROR(AddFooter(canvas.get(), scene));
  return canvas->Finish();
}

}  // namespace telestrain::viz
