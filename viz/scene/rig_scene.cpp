#include "viz/scene/rig_scene.h"

#include <Eigen/Geometry>
#include <limits>

#include "base/numbers.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene/scene_parts.h"

namespace telestrain::viz {
namespace {

constexpr double kMirrorOpacity = 0.55, kSensorOpacity = 0.35;

ViewVolume VolumeOf(const OpticalRig& rig, const OpticalPath& path) {
  const PhysicalCamera camera = VirtualCamera(rig, path);
  ViewVolume view;
  view.name = path.name;
  view.group = path.group;
  view.axis_in_array = camera.axis;
  view.image_x_in_array = camera.image_x;
  view.image_y_in_array = camera.image_y;
  view.width_mm = path.field_mm.sizes().x();
  view.height_mm = path.field_mm.sizes().y();
  view.depth_of_field_mm = rig.depth_of_field_mm;
  return view;
}

constexpr double kSensorFields = 1.8;  // from the first mirror to the sensor, in sensor widths

// The view's colour in the scene, which may name its views in another order than the rig.
Rgb ColorOfPath(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.views.size(); ++i)
    if (scene.views[i].name == name) return ColorOfView(scene, i);
  return kInk;
}

Part OpticsPart(const std::string& name, const Mesh& mesh, const Rgb& color) {
  Part part;
  part.name = name;
  part.layer = Layer::kOptics;
  part.mesh = mesh;
  part.color = color;
  return part;
}

}  // namespace

Scene SceneOfRig(const OpticalRig& rig, const RigDesign& design) {
  Scene scene;
  scene.magnification_px_per_mm = rig.magnification_px_per_mm;
  for (std::size_t i = 0; i < rig.paths.size(); ++i) {
    scene.views.push_back(VolumeOf(rig, rig.paths[i]));
    scene.views.back().center_in_array_mm = design.views[i].middle_ray.end_mm;
  }
  if (!rig.pipe_diameter_mm || design.pairs.empty()) return scene;
  Pipe pipe;
  pipe.radius_mm = 0.5 * *rig.pipe_diameter_mm;
  const PairDesign& pair = design.pairs.front();
  pipe.axis_point_in_array_mm = pair.center_in_array_mm - pipe.radius_mm * pair.facing;
  scene.pipe = pipe;
  return scene;
}

Rectangle SensorPart(const OpticalRig& rig, const Eigen::AlignedBox2d& field_mm, double along_mm) {
  const PhysicalCamera& camera = rig.camera;
  const auto at = [&](double x_mm, double y_mm) -> Eigen::Vector3d {
    return camera.position_mm + along_mm * camera.axis + x_mm * camera.image_x +
           y_mm * camera.image_y;
  };
  const Eigen::Vector2d low = field_mm.min(), high = field_mm.max();
  return {at(low.x(), low.y()), at(high.x(), low.y()), at(high.x(), high.y()),
          at(low.x(), high.y())};
}

Eigen::AlignedBox2d WholeField(const OpticalRig& rig) {
  Eigen::AlignedBox2d whole;
  for (const OpticalPath& path : rig.paths) whole.extend(path.field_mm);
  return whole;
}

std::vector<Eigen::Vector3d> DrawnRay(const TracedRay& ray, const OpticalRig& rig,
                                      double sensor_mm) {
  std::vector<Eigen::Vector3d> corners = ray.Corners();
  corners.front() += sensor_mm * rig.camera.axis;
  return corners;
}

double SensorPlane_mm(const OpticalRig& rig, const RigDesign& design) {
  const double away_mm = kSensorFields * WholeField(rig).sizes().maxCoeff();
  double first_mm = std::numeric_limits<double>::max();
  for (const ViewDesign& view : design.views) {
    first_mm = std::min(first_mm, view.focus_path_mm);
    for (const MirrorDesign& mirror : view.plates)
      for (const Eigen::Vector3d& corner : mirror.plate.Corners())
        first_mm = std::min(first_mm, rig.camera.axis.dot(corner - rig.camera.position_mm));
  }
  return first_mm - away_mm;
}

std::vector<Part> SensorParts(const OpticalRig& rig, const Scene& scene, double sensor_mm) {
  std::vector<Part> parts;
  for (const OpticalPath& path : rig.paths) {
    const Rectangle region = SensorPart(rig, path.field_mm, sensor_mm);
    Part part = OpticsPart("sensor: region of view " + path.name, Sheet(region),
                           ColorOfPath(scene, path.name));
    part.opacity = kSensorOpacity;
    parts.push_back(part);
    parts.push_back(
        OpticsPart("sensor: edge of view " + path.name, Lines(EdgesOf(region)), kSensorColor));
    parts.back().line_width_pt = 0.7;
  }
  parts.push_back(OpticsPart("sensor", Lines(EdgesOf(SensorPart(rig, WholeField(rig), sensor_mm))),
                             kSensorColor));
  parts.back().line_width_pt = 1.4;
  return parts;
}

std::vector<Part> MirrorParts(const RigDesign& design, const Scene& scene) {
  std::vector<Part> parts;
  for (const ViewDesign& view : design.views)
    for (const MirrorDesign& mirror : view.plates) {
      const auto corners = mirror.plate.Corners();
      if (corners.empty()) continue;
      Part plate = OpticsPart("mirror " + mirror.plate.name, Sheet(corners), kMirrorColor);
      plate.opacity = kMirrorOpacity;
      plate.facts = {
          {"mirror", mirror.plate.name},
          {"view", view.name},
          {"size that the light needs", FormatFixed(mirror.needed_size_mm.x(), 1) + " \u00d7 " +
                                            FormatFixed(mirror.needed_size_mm.y(), 1) + " mm"}};
      parts.push_back(plate);
      parts.push_back(OpticsPart("mirror " + mirror.plate.name + ": rim",
                                 Lines(ClosedLine(corners)), ColorOfPath(scene, view.name)));
      parts.back().line_width_pt = 0.9;
    }
  return parts;
}

std::vector<Part> RayParts(const OpticalRig& rig, const RigDesign& design, const Scene& scene,
                           double sensor_mm) {
  std::vector<Part> parts;
  for (const ViewDesign& view : design.views) {
    std::vector<Segment> corner_rays;
    for (const TracedRay& corner : view.corner_rays)
      for (const Segment& segment : OpenLine(DrawnRay(corner, rig, sensor_mm)))
        corner_rays.push_back(segment);
    const Rgb color = ColorOfPath(scene, view.name);
    parts.push_back(OpticsPart("corner rays of view " + view.name, Lines(corner_rays), color));
    parts.back().line_width_pt = 0.45;
    parts.push_back(OpticsPart("middle ray of view " + view.name,
                               Lines(OpenLine(DrawnRay(view.middle_ray, rig, sensor_mm))), color));
    parts.back().line_width_pt = 1.7;
    parts.back().facts = {
        {"view", view.name},
        {"from the first mirror to the object", FormatFixed(view.first_mirror_path_mm, 3) + " mm"}};
  }
  return parts;
}

std::vector<Part> OpticsParts(const Scene& scene) {
  std::vector<Part> parts;
  if (!scene.optics) return parts;
  const auto design = AnalyseRig(*scene.optics, {});
  if (!design.ok()) return parts;
  const double sensor_mm = SensorPlane_mm(*scene.optics, *design);
  for (auto& more : {SensorParts(*scene.optics, scene, sensor_mm), MirrorParts(*design, scene),
                     RayParts(*scene.optics, *design, scene, sensor_mm)})
    parts.insert(parts.end(), more.begin(), more.end());
  return parts;
}

}  // namespace telestrain::viz
