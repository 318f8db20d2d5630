#include <Eigen/Geometry>
#include <algorithm>

#include "base/numbers.h"
#include "viz/array_key.h"
#include "viz/legend.h"
#include "viz/part_actors.h"
#include "viz/pictures.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene_marks.h"

namespace telestrain::viz {
namespace {

constexpr ViewDirection kOblique{26, 13}, kSide{0, 0}, kAlongPipe{90, 0}, kFromAbove{0, 90};
constexpr double kMargin_pt = 6, kHeading_pt = 12;
constexpr double kSideShare = 0.70;  // of the picture's width

std::vector<Eigen::Vector3d> ExtentOf(const Scene& scene) {
  std::vector<Eigen::Vector3d> points;
  for (const ViewVolume& view : scene.views)
    for (const double along_mm : {-StretchOf(scene), 0.5 * view.depth_of_field_mm})
      for (const Eigen::Vector3d& corner : view.Section(along_mm)) points.push_back(corner);
  for (const Board& board : scene.boards)
    points.insert(points.end(), board.outline_in_array_mm.begin(), board.outline_in_array_mm.end());
  if (!scene.pipe) return points;
  const auto outline = OutlineOfPipe(*scene.pipe, DrawnSpanOf(*scene.pipe));
  points.insert(points.end(), outline.begin(), outline.end());
  return points;
}

void AddBodies(vtkRenderer* renderer, const Scene& scene, double point_px) {
  AddParts(renderer, ViewParts(scene), nullptr, point_px);
  AddParts(renderer, BoardParts(scene), nullptr, point_px);
  if (!scene.pipe) return;
  const ValueColors colors{kAxialStrain, ValueColorMap(StrainScale(scene.pipe->Largest().surface))};
  AddParts(renderer, {PipePart(*scene.pipe, DrawnSpanOf(*scene.pipe))}, nullptr, point_px);
  AddParts(renderer, SurfaceParts(scene, scene.pipe->largest_state), &colors, point_px);
  AddParts(renderer, GaugeParts(scene), nullptr, point_px);
}

// The whole array in a box of the canvas, its views named.
vtkRenderer* AddArrayPanel(Canvas* canvas, const Scene& scene, const std::string& name,
                           const ViewDirection& direction, const PixelBox& box,
                           const std::vector<Eigen::Vector3d>& extent) {
  vtkRenderer* renderer =
      canvas->AddPanel(name, box, FitCamera(extent, AxesOf(scene), direction, box, canvas->Px(13)));
  AddBodies(renderer, scene, canvas->Px(1));
  NameViews(canvas, name, scene);
  return renderer;
}

Eigen::Vector3d MiddleOfGroup(const Scene& scene, const std::string& group) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const ViewVolume& view : scene.views)
    if (view.group == group) {
      sum += view.center_in_array_mm;
      ++count;
    }
  return sum / std::max(count, 1);
}

// How far the fields of the first and the last group lie apart along the pipe; `offset_mm` moves
// the line off the fields.
void AddFieldDistance(Canvas* canvas, const std::string& panel, vtkRenderer* renderer,
                      const Scene& scene, const Eigen::Vector3d& offset_mm) {
  const auto groups = scene.Groups();
  if (groups.size() < 2) return;
  const Eigen::Vector3d from = MiddleOfGroup(scene, groups.front()) + offset_mm;
  const Eigen::Vector3d to = MiddleOfGroup(scene, groups.back()) + offset_mm;
  AddDimension(canvas, panel, renderer, {from, to}, 0.007 * (to - from).norm(),
               "fields " + FormatFixed((to - from).norm(), 2) + " mm apart");
}

// The angle between the first two views of a group that look from different sides.
void AddStereoAngle(Canvas* canvas, const std::string& panel, vtkRenderer* renderer,
                    const Scene& scene) {
  for (const ViewVolume& view : scene.views)
    if (view.group == scene.views[0].group && view.name != scene.views[0].name) {
      AddAngle(canvas, panel, renderer, MiddleOfGroup(scene, view.group),
               {-scene.views[0].axis_in_array, -view.axis_in_array}, 0.72 * StretchOf(scene));
      return;
    }
}

std::string Facts(const Scene& scene) {
  return "magnification " + FormatFixed(scene.magnification_px_per_mm, 3) +
         " px/mm, reprojection RMS " + FormatFixed(scene.reprojection_rms_px, 4) + " px";
}

PixelBox WithHeading(Canvas* canvas, const std::string& text, PixelBox box) {
  const TextStyle heading{8, true, kInk};
  const Eigen::Vector2d size = canvas->TextSize(text, heading);
  canvas->AddText(text, {box.left + canvas->Px(kMargin_pt), box.Top() - size.y()}, heading);
  box.height -= canvas->Px(kHeading_pt);
  return box;
}

}  // namespace

Result<Picture> DrawArray(const Scene& scene, const RenderOptions& options) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto canvas, Canvas::Create(options));
  const double top = AddTitle(canvas.get(), "Telecentric view array",
                              "virtual views through the mirrors, parallel rays; " + Facts(scene));
  const double footer = ArrayKeyHeight(*canvas);
  std::vector<Eigen::Vector3d> extent = ExtentOf(scene);
  const ScaleBar bar = ScaleBarBelow(extent, AxesOf(scene), 0.3);
  extent.push_back(bar.start_in_array_mm);
  vtkRenderer* renderer = AddArrayPanel(canvas.get(), scene, "array", kOblique,
                                        {0, footer, canvas->Width(), top - footer}, extent);
  AddScaleBar(canvas.get(), "array", renderer, bar);
  TELESTRAIN_RETURN_IF_ERROR(AddArrayKey(canvas.get(), scene, kOblique));
  return canvas->Finish();
}

Result<Picture> DrawSide(const Scene& scene, const RenderOptions& options) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto canvas, Canvas::Create(options));
  const double top = AddTitle(canvas.get(), "Telecentric view array, elevations",
                              "parallel projections at two scales; " + Facts(scene));
  const double footer = ArrayKeyHeight(*canvas), height = top - footer - canvas->Px(4);
  const double split = kSideShare * canvas->Width();
  const SceneAxes axes = AxesOf(scene);
  std::vector<Eigen::Vector3d> extent = ExtentOf(scene);
  ScaleBar bar = ScaleBarBelow(extent, axes, 0.3);
  bar.start_in_array_mm -= 0.06 * bar.length_mm * axes.up;
  extent.push_back(bar.start_in_array_mm - 0.1 * bar.length_mm * axes.up);
  const PixelBox left = WithHeading(canvas.get(), "across the pipe", {0, footer, split, height});
  vtkRenderer* renderer = AddArrayPanel(canvas.get(), scene, "side", kSide, left, extent);
  AddScaleBar(canvas.get(), "side", renderer, bar);
  AddFieldDistance(canvas.get(), "side", renderer, scene, 0.5 * StretchOf(scene) * axes.up);
  const PixelBox right = WithHeading(canvas.get(), "along the pipe, towards \u2212x",
                                     {split, footer, canvas->Width() - split, height});
  // Its own scale bar, across the pipe, below the pipe.
  std::vector<Eigen::Vector3d> end_extent = ExtentOf(scene);
  const ScaleBar end_bar{bar.start_in_array_mm, axes.across, 0.5 * bar.length_mm};
  end_extent.push_back(end_bar.start_in_array_mm - 0.1 * bar.length_mm * axes.up);
  renderer = AddArrayPanel(canvas.get(), scene, "along pipe", kAlongPipe, right, end_extent);
  AddScaleBar(canvas.get(), "along pipe", renderer, end_bar);
  AddStereoAngle(canvas.get(), "along pipe", renderer, scene);
  TELESTRAIN_RETURN_IF_ERROR(AddArrayKey(canvas.get(), scene, kSide));
  return canvas->Finish();
}

Result<Picture> DrawTop(const Scene& scene, const RenderOptions& options) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto canvas, Canvas::Create(options));
  const double top = AddTitle(canvas.get(), "Telecentric view array from the instrument",
                              "parallel projection towards the pipe; " + Facts(scene));
  const double footer = ArrayKeyHeight(*canvas);
  const SceneAxes axes = AxesOf(scene);
  std::vector<Eigen::Vector3d> extent = ExtentOf(scene);
  ScaleBar bar = ScaleBarBelow(extent, axes, 0.3);
  double lowest_mm = 0;
  for (const Eigen::Vector3d& point : extent)
    lowest_mm = std::min(lowest_mm, axes.across.dot(point - bar.start_in_array_mm));
  bar.start_in_array_mm += (lowest_mm - 0.12 * bar.length_mm) * axes.across;
  extent.push_back(bar.start_in_array_mm - 0.1 * bar.length_mm * axes.across);
  vtkRenderer* renderer = AddArrayPanel(canvas.get(), scene, "top", kFromAbove,
                                        {0, footer, canvas->Width(), top - footer}, extent);
  AddScaleBar(canvas.get(), "top", renderer, bar);
  // Above everything, so that no volume covers its ends.
  AddFieldDistance(canvas.get(), "top", renderer, scene, StretchOf(scene) * axes.up);
  TELESTRAIN_RETURN_IF_ERROR(AddArrayKey(canvas.get(), scene, kFromAbove));
  return canvas->Finish();
}

}  // namespace telestrain::viz
