#include "viz/rig_scene.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>

#include "viz/actors.h"

namespace telestrain::viz {
namespace {

constexpr double kMirrorOpacity = 0.55, kSensorOpacity = 0.35, kFocusOpacity = 0.10;

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

vtkSmartPointer<vtkPolyData> PolygonOf(const std::vector<Eigen::Vector3d>& corners) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(corners.size()));
  for (const Eigen::Vector3d& corner : corners)
    cells->InsertCellPoint(points->InsertNextPoint(corner.data()));
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

std::vector<Segment> ClosedLine(const std::vector<Eigen::Vector3d>& corners) {
  std::vector<Segment> line;
  for (std::size_t i = 0; i < corners.size(); ++i)
    line.emplace_back(corners[i], corners[(i + 1) % corners.size()]);
  return line;
}

std::vector<Segment> OpenLine(const std::vector<Eigen::Vector3d>& corners) {
  std::vector<Segment> line;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    line.emplace_back(corners[i], corners[i + 1]);
  return line;
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

void AddSensor(vtkRenderer* renderer, const OpticalRig& rig, const Scene& scene, double sensor_mm,
               double point_px) {
  for (std::size_t i = 0; i < rig.paths.size(); ++i) {
    const Rectangle part = SensorPart(rig, rig.paths[i].field_mm, sensor_mm);
    AddFlat(renderer, Sheet(part), ColorOfView(scene, i), kSensorOpacity);
    AddLines(renderer, EdgesOf(part), kSensorColor, 0.7 * point_px);
  }
  AddLines(renderer, EdgesOf(SensorPart(rig, WholeField(rig), sensor_mm)), kSensorColor,
           1.4 * point_px);
}

void AddMirrors(vtkRenderer* renderer, const RigDesign& design, const Scene& scene,
                double point_px) {
  for (std::size_t i = 0; i < design.views.size(); ++i)
    for (const MirrorDesign& mirror : design.views[i].plates) {
      const auto corners = mirror.plate.Corners();
      if (corners.empty()) continue;
      AddFlat(renderer, PolygonOf(corners), kMirrorColor, kMirrorOpacity);
      AddLines(renderer, ClosedLine(corners), ColorOfView(scene, i), 0.9 * point_px);
    }
}

void AddRays(vtkRenderer* renderer, const OpticalRig& rig, const RigDesign& design,
             const Scene& scene, double sensor_mm, double point_px) {
  for (std::size_t i = 0; i < design.views.size(); ++i) {
    const ViewDesign& view = design.views[i];
    const Rgb color = ColorOfView(scene, i);
    for (const TracedRay& corner : view.corner_rays)
      AddLines(renderer, OpenLine(DrawnRay(corner, rig, sensor_mm)), color, 0.45 * point_px);
    AddLines(renderer, OpenLine(DrawnRay(view.middle_ray, rig, sensor_mm)), color, 1.7 * point_px);
  }
}

void AddFocusBoxes(vtkRenderer* renderer, const Scene& scene, double point_px) {
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    const ViewVolume& view = scene.views[i];
    const Rectangle near = view.Section(-0.5 * view.depth_of_field_mm),
                    far = view.Section(0.5 * view.depth_of_field_mm);
    AddBody(renderer, BoxBetween(near, far), ColorOfView(scene, i), kFocusOpacity);
    std::vector<Segment> edges = EdgesBetween(near, far);
    for (const Rectangle& face : {near, far})
      for (const Segment& edge : EdgesOf(face)) edges.push_back(edge);
    AddLines(renderer, edges, ColorOfView(scene, i), 0.7 * point_px);
  }
}

}  // namespace telestrain::viz
