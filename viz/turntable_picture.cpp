#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/numbers.h"
#include "viz/array_key.h"
#include "viz/legend.h"
#include "viz/part_actors.h"
#include "viz/pictures.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene_marks.h"

namespace telestrain::viz {
namespace {

constexpr double kElevation_deg = 16;

std::vector<Part> PartsToTurn(const Scene& scene) {
  std::vector<Part> parts = ViewParts(scene);
  const auto add = [&](std::vector<Part> more) {
    parts.insert(parts.end(), more.begin(), more.end());
  };
  add(BoardParts(scene));
  if (scene.pipe) {
    add({PipePart(*scene.pipe, DrawnSpanOf(*scene.pipe))});
    if (!scene.pipe->states.empty()) add(SurfaceParts(scene, scene.pipe->largest_state));
    add(GaugeParts(scene));
  }
  for (const Part& part : FrameParts(scene, PointsOf(parts)))
    if (part.name != "scale bar") parts.push_back(part);  // comes with its length
  return parts;
}

// The circles that the points run through about the upward axis through their middle: a camera that
// shows these never has to zoom.
std::vector<Eigen::Vector3d> SweptPoints(const std::vector<Eigen::Vector3d>& points,
                                         const SceneAxes& axes) {
  Eigen::Matrix3d from_array;
  from_array << axes.along.transpose(), axes.across.transpose(), axes.up.transpose();
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& point : points) bounds.extend(Eigen::Vector3d(from_array * point));
  double radius_mm = 0;
  for (const Eigen::Vector3d& point : points)
    radius_mm = std::max(radius_mm, (from_array * point - bounds.center()).head<2>().norm());
  std::vector<Eigen::Vector3d> swept;
  constexpr int kSteps = 72;
  for (int i = 0; i < kSteps; ++i)
    for (const double height_mm : {bounds.min().z(), bounds.max().z()}) {
      const double angle = 2 * std::numbers::pi * i / kSteps;
      swept.push_back(from_array.transpose() *
                      Eigen::Vector3d(bounds.center().x() + radius_mm * std::cos(angle),
                                      bounds.center().y() + radius_mm * std::sin(angle),
                                      height_mm));
    }
  return swept;
}

}  // namespace

Result<Picture> DrawTurntable(const Scene& scene, const RenderOptions& options,
                              double azimuth_deg) {
  TELESTRAIN_ASSIGN_OR_RETURN(const auto canvas, Canvas::Create(options));
  const double top =
      AddTitle(canvas.get(), "Telecentric view array",
               "virtual views through the mirrors, parallel rays; magnification " +
                   FormatFixed(scene.magnification_px_per_mm, 3) + " px/mm, reprojection RMS " +
                   FormatFixed(scene.reprojection_rms_px, 4) + " px");
  const double footer = ArrayKeyHeight(*canvas);
  const PixelBox box{0, footer, canvas->Width(), top - footer};
  const SceneAxes axes = AxesOf(scene);
  const ViewDirection direction{azimuth_deg, kElevation_deg};
  const std::vector<Part> parts = PartsToTurn(scene);
  std::vector<Eigen::Vector3d> extent = PointsOf(parts);
  const ScaleBar bar = ScaleBarBelow(extent, axes, 0.3);
  extent.push_back(bar.start_in_array_mm);
  const ParallelCamera camera =
      FitCamera(SweptPoints(extent, axes), axes, direction, box, canvas->Px(11));
  vtkRenderer* renderer = canvas->AddPanel("turntable", box, camera);
  std::optional<ValueColors> strain;
  if (scene.pipe && !scene.pipe->states.empty())
    strain.emplace(kAxialStrain, ValueColorMap(StrainScale(scene.pipe->Largest().surface)));
  AddParts(renderer, parts, strain ? &*strain : nullptr, canvas->Px(1));
  NameViews(canvas.get(), "turntable", scene);
  AddScaleBar(canvas.get(), "turntable", renderer, bar);
  TELESTRAIN_RETURN_IF_ERROR(AddArrayKey(canvas.get(), scene, direction));
  return canvas->Finish();
}

}  // namespace telestrain::viz
