#include "viz/solids.h"

#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkCellArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace telestrain::viz {
namespace {

constexpr int kRoundSegments = 96;

// Two directions that span the plane across `axis`.
std::pair<Eigen::Vector3d, Eigen::Vector3d> Across(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d first = axis.unitOrthogonal();
  return {first, axis.cross(first).normalized()};
}

void AddQuad(const Rectangle& corners, vtkPoints* points, vtkCellArray* cells) {
  cells->InsertNextCell(4);
  for (const Eigen::Vector3d& corner : corners)
    cells->InsertCellPoint(points->InsertNextPoint(corner.data()));
}

vtkSmartPointer<vtkPolyData> Quads(const std::vector<Rectangle>& quads) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (const Rectangle& quad : quads) AddQuad(quad, points, cells);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

vtkActor* AddActor(vtkRenderer* renderer, vtkPolyData* data, const Rgb& color) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.r, color.g, color.b);
  renderer->AddActor(actor);
  return actor;
}

}  // namespace

vtkSmartPointer<vtkPolyData> BoxBetween(const Rectangle& near, const Rectangle& far) {
  std::vector<Rectangle> faces{near, far};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    faces.push_back({near[i], near[next], far[next], far[i]});
  }
  return Quads(faces);
}

vtkSmartPointer<vtkPolyData> Sheet(const Rectangle& outline) { return Quads({outline}); }

vtkSmartPointer<vtkPolyData> TubeWall(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                      double radius_mm) {
  const Eigen::Vector3d axis = (to - from).normalized();
  const auto start = Ring(from, axis, radius_mm), end = Ring(to, axis, radius_mm);
  std::vector<Rectangle> strips;
  for (std::size_t i = 0; i < start.size(); ++i)
    strips.push_back({start[i].first, start[i].second, end[i].second, end[i].first});
  return Quads(strips);
}

vtkActor* AddBody(vtkRenderer* renderer, vtkPolyData* data, const Rgb& color, double opacity) {
  vtkActor* actor = AddActor(renderer, data, color);
  actor->GetProperty()->SetAmbient(0.55);
  actor->GetProperty()->SetDiffuse(0.5);
  actor->GetProperty()->SetSpecular(0);
  actor->GetProperty()->SetOpacity(opacity);
  return actor;
}

vtkActor* AddFlat(vtkRenderer* renderer, vtkPolyData* data, const Rgb& color, double opacity) {
  vtkActor* actor = AddActor(renderer, data, color);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetOpacity(opacity);
  return actor;
}

void AddLines(vtkRenderer* renderer, const std::vector<Segment>& segments, const Rgb& color,
              double width_px) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (const auto& [from, to] : segments) {
    cells->InsertNextCell(2);
    cells->InsertCellPoint(points->InsertNextPoint(from.data()));
    cells->InsertCellPoint(points->InsertNextPoint(to.data()));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  AddFlat(renderer, data, color, 1)->GetProperty()->SetLineWidth(static_cast<float>(width_px));
}

void AddArrow(vtkRenderer* renderer, const Segment& from_to, double thickness_mm,
              const Rgb& color) {
  const Eigen::Vector3d along = from_to.second - from_to.first;
  const double length_mm = along.norm();
  vtkNew<vtkArrowSource> source;  // of length 1 along x
  source->SetShaftRadius(0.5 * thickness_mm / length_mm);
  source->SetTipRadius(1.4 * thickness_mm / length_mm);
  source->SetTipLength(std::min(0.6, 3.6 * thickness_mm / length_mm));
  source->SetShaftResolution(24);
  source->SetTipResolution(24);
  source->Update();
  vtkActor* actor = AddBody(renderer, source->GetOutput(), color, 1);
  const auto [side, other] = Across(along.normalized());
  vtkNew<vtkMatrix4x4> place;
  for (int row = 0; row < 3; ++row) {
    place->SetElement(row, 0, along[row]);
    place->SetElement(row, 1, length_mm * side[row]);
    place->SetElement(row, 2, length_mm * other[row]);
    place->SetElement(row, 3, from_to.first[row]);
  }
  actor->SetUserMatrix(place);
}

std::vector<Segment> EdgesOf(const Rectangle& outline) {
  return {{outline[0], outline[1]},
          {outline[1], outline[2]},
          {outline[2], outline[3]},
          {outline[3], outline[0]}};
}

std::vector<Segment> EdgesBetween(const Rectangle& near, const Rectangle& far) {
  std::vector<Segment> edges;
  for (std::size_t i = 0; i < 4; ++i) edges.emplace_back(near[i], far[i]);
  return edges;
}

std::vector<Segment> Ring(const Eigen::Vector3d& center, const Eigen::Vector3d& axis,
                          double radius_mm) {
  const auto [first, second] = Across(axis);
  const auto at = [&, &u = first, &v = second](int i) -> Eigen::Vector3d {
    const double angle = 2 * std::numbers::pi * (i % kRoundSegments) / kRoundSegments;
    return center + radius_mm * (std::cos(angle) * u + std::sin(angle) * v);
  };
  std::vector<Segment> ring;
  for (int i = 0; i < kRoundSegments; ++i) ring.emplace_back(at(i), at(i + 1));
  return ring;
}

}  // namespace telestrain::viz
