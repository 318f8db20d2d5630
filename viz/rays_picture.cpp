#include "viz/rays_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/files.h"
#include "base/numbers.h"
#include "viz/legend.h"
#include "viz/part_actors.h"
#include "viz/png_bytes.h"
#include "viz/rig_labels.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene_marks.h"

namespace telestrain::viz {
namespace {

constexpr ViewDirection kOblique{36, 25};
constexpr ViewDirection kAlongPipe{90, 0};
constexpr int kWidth_px = 2008, kHeight_px = 1480;
constexpr double kFooter_pt = 48, kMargin_pt = 6, kHeading_pt = 12;
constexpr double kObliqueShare = 0.60;  // of the picture's width

// Along the pipe's axis: the fields and a little more.
std::array<double, 2> PipeSpan(const Scene& scene) {
  std::array<double, 2> span_mm{std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::lowest()};
  if (!scene.pipe) return span_mm;
  for (const ViewVolume& view : scene.views)
    for (const Eigen::Vector3d& corner : view.Section(0)) {
      const double along_mm =
          scene.pipe->axis_in_array.dot(corner - scene.pipe->axis_point_in_array_mm);
      span_mm = {std::min(span_mm[0], along_mm), std::max(span_mm[1], along_mm)};
    }
  return {span_mm[0] - scene.pipe->radius_mm, span_mm[1] + scene.pipe->radius_mm};
}

std::vector<Eigen::Vector3d> ExtentOf(const RigDrawing& drawing) {
  std::vector<Eigen::Vector3d> points;
  const auto add = [&points](const auto& more) {
    points.insert(points.end(), more.begin(), more.end());
  };
  add(SensorPart(drawing.rig, WholeField(drawing.rig), drawing.sensor_mm));
  for (const ViewDesign& view : drawing.design.views)
    for (const MirrorDesign& mirror : view.plates) add(mirror.plate.Corners());
  for (const ViewVolume& view : drawing.scene.views)
    for (const double side : {-0.5, 0.5}) add(view.Section(side * view.depth_of_field_mm));
  if (drawing.scene.pipe) add(OutlineOfPipe(*drawing.scene.pipe, drawing.pipe_span_mm));
  return points;
}

void AddBodies(vtkRenderer* renderer, const RigDrawing& drawing, double point_px) {
  const auto add = [&](const std::vector<Part>& parts) {
    AddParts(renderer, parts, nullptr, point_px);
  };
  if (drawing.scene.pipe) add({PipePart(*drawing.scene.pipe, drawing.pipe_span_mm)});
  add(FocusParts(drawing.scene));
  add(MirrorParts(drawing.design, drawing.scene));
  add(SensorParts(drawing.rig, drawing.scene, drawing.sensor_mm));
  add(RayParts(drawing.rig, drawing.design, drawing.scene, drawing.sensor_mm));
}

// An arc between the middle rays of the first pair, with the angle.
void AddStereoAngle(Canvas* canvas, const std::string& panel, vtkRenderer* renderer,
                    const RigDrawing& drawing) {
  if (drawing.design.pairs.empty()) return;
  const PairDesign& pair = drawing.design.pairs.front();
  const auto& views = drawing.design.views;
  const auto first = std::find_if(views.begin(), views.end(),
                                  [&](const ViewDesign& v) { return v.name == pair.first; });
  const Eigen::Vector3d start = -first->middle_ray.direction;
  const Eigen::Vector3d axis = start.cross(pair.facing).normalized();
  const Eigen::Vector3d end = Eigen::AngleAxisd(pair.stereo_angle_rad, axis) * start;
  const double radius_mm =
      0.35 * (first->middle_ray.end_mm - first->middle_ray.Corners().rbegin()[1]).norm();
  AddAngle(canvas, panel, renderer, pair.center_in_array_mm, {start, end}, radius_mm);
}

// Below everything, at the front.
ScaleBar BarBelow(const std::vector<Eigen::Vector3d>& extent, const SceneAxes& axes,
                  const Eigen::Vector3d& along) {
  Eigen::Matrix3d from_array;
  from_array << axes.along.transpose(), axes.across.transpose(), axes.up.transpose();
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& point : extent) bounds.extend(Eigen::Vector3d(from_array * point));
  const Eigen::Vector3d start(bounds.min().x(), 0.5 * bounds.min().y(), bounds.min().z());
  return {from_array.transpose() * start, along, RoundDown(0.4 * bounds.sizes().x())};
}

struct PanelPlan {
  std::string name, heading;
  ViewDirection direction;
  PixelBox box;
  Eigen::Vector3d bar_along;
  bool with_angle;
};

void DrawPanel(Canvas* canvas, const RigDrawing& drawing, PanelPlan plan) {
  const TextStyle heading{8, true, kInk};
  const Eigen::Vector2d size = canvas->TextSize(plan.heading, heading);
  canvas->AddText(plan.heading, {plan.box.left + canvas->Px(kMargin_pt), plan.box.Top() - size.y()},
                  heading);
  plan.box.height -= canvas->Px(kHeading_pt);
  const SceneAxes axes = AxesOf(drawing.scene);
  auto extent = ExtentOf(drawing);
  const ScaleBar bar = BarBelow(extent, axes, plan.bar_along);
  extent.push_back(bar.start_in_array_mm);
  extent.push_back(bar.End());
  vtkRenderer* renderer = canvas->AddPanel(
      plan.name, plan.box, FitCamera(extent, axes, plan.direction, plan.box, canvas->Px(20)));
  AddBodies(renderer, drawing, canvas->Px(1));
  AddScaleBar(canvas, plan.name, renderer, bar);
  NameMirrors(canvas, plan.name, drawing);
  NameSensor(canvas, plan.name, drawing);
  if (plan.with_angle) AddStereoAngle(canvas, plan.name, renderer, drawing);
}

std::vector<LegendEntry> LegendOf(const RigDrawing& drawing) {
  using Sign = LegendEntry::Sign;
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < drawing.scene.views.size(); ++i) {
    const ViewDesign& view = drawing.design.views[i];
    entries.push_back({Sign::kLine, ColorOfView(drawing.scene, i), 1,
                       "view " + Shortened(view.name) + ", " +
                           FormatFixed(view.first_mirror_path_mm, 2) + " mm from M1"});
  }
  entries.push_back({Sign::kBox, kMirrorColor, 0.55, "mirror"});
  entries.push_back({Sign::kFrame, kSensorColor, 1, "sensor with the views' parts, object scale"});
  entries.push_back(
      {Sign::kNone,
       {},
       1,
       "boxes: depth of field " + FormatFixed(drawing.rig.depth_of_field_mm, 1) + " mm"});
  if (drawing.scene.pipe)
    entries.push_back({Sign::kBox, kPipeColor, 0.3,
                       "pipe \u00d8 " + FormatFixed(2 * drawing.scene.pipe->radius_mm, 1) + " mm"});
  return entries;
}

std::string FactsOf(const RigDrawing& drawing) {
  std::string facts = "thick: middle of a view, thin: its corners; field along the pipe " +
                      FormatFixed(drawing.design.total_field_mm, 2) + " mm";
  if (!drawing.design.pairs.empty())
    facts +=
        ", stereo angle " +
        FormatFixed(drawing.design.pairs.front().stereo_angle_rad * 180 / std::numbers::pi, 1) +
        "\u00b0";
  return facts + ", aperture NA " + FormatFixed(drawing.design.numerical_aperture, 4);
}

}  // namespace

Result<Picture> DrawRays(const OpticalRig& rig, const RigDesign& design,
                         const RenderOptions& options) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto canvas, Canvas::Create(options));
  RigDrawing drawing{rig, design, SceneOfRig(rig, design), SensorPlane_mm(rig, design), {}};
  drawing.pipe_span_mm = PipeSpan(drawing.scene);
  const double top =
      AddTitle(canvas.get(), "The way of light through the mirrors, as designed", FactsOf(drawing));
  const double footer = canvas->Px(kFooter_pt + kMargin_pt), margin = canvas->Px(kMargin_pt);
  const double height = top - footer - canvas->Px(4);
  const double split = kObliqueShare * canvas->Width();
  const SceneAxes axes = AxesOf(drawing.scene);
  DrawPanel(canvas.get(), drawing,
            {"oblique", "oblique", kOblique, {0, footer, split, height}, axes.along, false});
  DrawPanel(canvas.get(), drawing,
            {"along pipe",
             "along the pipe, towards \u2212x",
             kAlongPipe,
             {split, footer, canvas->Width() - split, height},
             axes.across,
             true});
  const double triad_px = canvas->Px(48), triad_height = canvas->Px(kFooter_pt) - margin;
  AddTriad(canvas.get(), axes, kOblique, {margin, margin, triad_px, triad_height});
  const double legend_left = margin + triad_px + canvas->Px(8);
  TELESTRAIN_RETURN_IF_ERROR(
      AddLegend(canvas.get(), LegendOf(drawing),
                {legend_left, margin, canvas->Width() - legend_left - margin, triad_height}));
  return canvas->Finish();
}

Result<Picture> DrawOptics(const Scene& scene, const RenderOptions& options) {
  TELESTRAIN_CHECK(scene.optics.has_value(), "a picture of the rays needs the mirrors");
  TELESTRAIN_ASSIGN_OR_RETURN(const RigDesign design, AnalyseRig(*scene.optics, {}));
  return DrawRays(*scene.optics, design, options);
}

Status RenderRays(const OpticalRig& rig, const RigDesign& design,
                  const std::filesystem::path& path) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Picture picture,
                              DrawRays(rig, design, {kWidth_px, kHeight_px}));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string png, PngBytes(picture.image));
  return WriteFileAtomically(path, png);
}

}  // namespace telestrain::viz
