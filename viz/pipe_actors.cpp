#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <limits>
#include <map>

#include "viz/actors.h"

namespace telestrain::viz {
namespace {

vtkSmartPointer<vtkPolyData> SurfaceData(const Surface& surface, int group) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> strain;
  strain->SetName("axial_microstrain");
  for (std::size_t i = 0; i < surface.points_in_array_mm.size(); ++i) {
    points->InsertNextPoint(surface.points_in_array_mm[i].data());
    strain->InsertNextValue(surface.values.front().values[i]);
  }
  vtkNew<vtkCellArray> quads;
  for (const std::array<int, 4>& quad : surface.quads) {
    if (group >= 0 && surface.group[static_cast<std::size_t>(quad[0])] != group) continue;
    const vtkIdType ids[4] = {quad[0], quad[1], quad[2], quad[3]};
    quads->InsertNextCell(4, ids);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(quads);
  data->GetPointData()->SetScalars(strain);
  return data;
}

vtkSmartPointer<vtkLookupTable> TableOf(const ColorMap& colors) {
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(ColorMap::kEntries);
  for (int i = 0; i < ColorMap::kEntries; ++i) {
    const Rgb& color = colors.table()[static_cast<std::size_t>(i)];
    table->SetTableValue(i, color.r, color.g, color.b, 1);
  }
  table->SetTableRange(colors.low(), colors.high());
  return table;
}

}  // namespace

void AddNominalPipe(vtkRenderer* renderer, const Pipe& pipe, const std::array<double, 2>& span_mm,
                    double point_px) {
  constexpr double kDrawnShare = 0.99;
  const Eigen::Vector3d from = pipe.axis_point_in_array_mm + span_mm[0] * pipe.axis_in_array;
  const Eigen::Vector3d to = pipe.axis_point_in_array_mm + span_mm[1] * pipe.axis_in_array;
  const double radius_mm = kDrawnShare * pipe.radius_mm;
  AddBody(renderer, TubeWall(from, to, radius_mm), kPipeColor, 0.22);
  for (const Eigen::Vector3d& end : {from, to})
    AddLines(renderer, Ring(end, pipe.axis_in_array, radius_mm), kPipeColor, 0.6 * point_px);
}

void AddStrainSurface(vtkRenderer* renderer, const Surface& surface, const ColorMap& colors,
                      int group) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(SurfaceData(surface, group));
  mapper->SetLookupTable(TableOf(colors));
  mapper->SetScalarRange(colors.low(), colors.high());
  mapper->InterpolateScalarsBeforeMappingOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  renderer->AddActor(actor);
}

std::array<double, 2> SpanOf(const Pipe& pipe) {
  std::array<double, 2> span_mm{std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::lowest()};
  for (const Eigen::Vector3d& point : pipe.Largest().surface.points_in_array_mm) {
    const double along_mm = (point - pipe.axis_point_in_array_mm).dot(pipe.axis_in_array);
    span_mm = {std::min(span_mm[0], along_mm), std::max(span_mm[1], along_mm)};
  }
  return span_mm;
}

std::array<double, 2> DrawnSpanOf(const Pipe& pipe) {
  const auto span_mm = SpanOf(pipe);
  return {span_mm[0] - 0.4 * pipe.radius_mm, span_mm[1] + 0.4 * pipe.radius_mm};
}

std::vector<Eigen::Vector3d> OutlineOfPipe(const Pipe& pipe, const std::array<double, 2>& span_mm) {
  std::vector<Eigen::Vector3d> points;
  for (const double along_mm : span_mm) {
    const Eigen::Vector3d center = pipe.axis_point_in_array_mm + along_mm * pipe.axis_in_array;
    for (const auto& [point, next] : Ring(center, pipe.axis_in_array, pipe.radius_mm))
      points.push_back(point);
  }
  return points;
}

void AddPatchEdge(vtkRenderer* renderer, const Surface& surface, int group, double point_px) {
  std::map<std::pair<int, int>, int> uses;  // of an edge, by its points in ascending order
  for (const std::array<int, 4>& quad : surface.quads) {
    if (surface.group[static_cast<std::size_t>(quad[0])] != group) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [low, high] = std::minmax(quad[i], quad[(i + 1) % 4]);
      ++uses[{low, high}];
    }
  }
  std::vector<Segment> edge;
  for (const auto& [points, count] : uses)
    if (count == 1)
      edge.emplace_back(surface.points_in_array_mm[static_cast<std::size_t>(points.first)],
                        surface.points_in_array_mm[static_cast<std::size_t>(points.second)]);
  if (!edge.empty()) AddLines(renderer, edge, kInk, 0.5 * point_px);
}

std::vector<Eigen::Vector3d> PointsOfGroup(const Surface& surface, int group) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < surface.points_in_array_mm.size(); ++i)
    if (surface.group[i] == group) points.push_back(surface.points_in_array_mm[i]);
  return points;
}

}  // namespace telestrain::viz
