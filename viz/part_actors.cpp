#include "viz/part_actors.h"

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

#include "viz/scene/scene_colors.h"

namespace telestrain::viz {
namespace {

const PointValues* Find(const Part& part, const std::string& quantity) {
  const auto found =
      std::find_if(part.values.begin(), part.values.end(),
                   [&](const PointValues& values) { return values.quantity.key == quantity; });
  return found == part.values.end() ? nullptr : &*found;
}

vtkSmartPointer<vtkCellArray> CellsOf(const std::vector<std::vector<int>>& faces) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const std::vector<int>& face : faces) {
    cells->InsertNextCell(static_cast<int>(face.size()));
    for (const int point : face) cells->InsertCellPoint(point);
  }
  return cells;
}

void Shade(const Part& part, vtkProperty* property) {
  property->SetColor(part.color.r, part.color.g, part.color.b);
  property->SetOpacity(part.mesh.faces.empty() ? 1 : part.opacity);
  if (!part.lit || part.mesh.faces.empty()) {
    property->LightingOff();
    return;
  }
  property->SetAmbient(0.55);
  property->SetDiffuse(0.5);
  property->SetSpecular(0);
}

vtkSmartPointer<vtkActor> ActorOfData(vtkPolyData* data) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

void ColorByValues(const ValueColors& colors, vtkActor* actor) {
  vtkMapper* mapper = actor->GetMapper();
  mapper->ScalarVisibilityOn();
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray(colors.quantity.c_str());
  mapper->SetLookupTable(TableOf(colors.colors));
  mapper->SetScalarRange(colors.colors.low(), colors.colors.high());
  mapper->InterpolateScalarsBeforeMappingOn();
}

}  // namespace

vtkSmartPointer<vtkPolyData> DataOf(const Part& part) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Eigen::Vector3d& point : part.mesh.points_in_array_mm)
    points->InsertNextPoint(point.data());
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  if (!part.mesh.faces.empty()) data->SetPolys(CellsOf(part.mesh.faces));
  if (!part.mesh.lines.empty()) {
    vtkNew<vtkCellArray> lines;
    for (const auto& [from, to] : part.mesh.lines) {
      const vtkIdType ends[2] = {from, to};
      lines->InsertNextCell(2, ends);
    }
    data->SetLines(lines);
  }
  for (const PointValues& values : part.values) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(values.quantity.key.c_str());
    for (const double value : values.values) array->InsertNextValue(value);
    data->GetPointData()->AddArray(array);
  }
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
  table->SetNanColor(kNoValueColor.r, kNoValueColor.g, kNoValueColor.b, 1);
  return table;
}

std::vector<vtkSmartPointer<vtkActor>> ActorsOf(const Part& part, const ValueColors* colors,
                                                double point_px) {
  std::vector<vtkSmartPointer<vtkActor>> actors;
  const auto data = DataOf(part);
  if (!part.mesh.faces.empty()) {
    vtkNew<vtkPolyData> faces;
    faces->ShallowCopy(data);
    faces->SetLines(nullptr);
    actors.push_back(ActorOfData(faces));
    Shade(part, actors.back()->GetProperty());
    if (colors != nullptr && Find(part, colors->quantity) != nullptr)
      ColorByValues(*colors, actors.back());
  }
  if (part.mesh.lines.empty()) return actors;
  vtkNew<vtkPolyData> lines;
  lines->SetPoints(data->GetPoints());
  lines->SetLines(data->GetLines());
  actors.push_back(ActorOfData(lines));
  vtkProperty* property = actors.back()->GetProperty();
  property->SetColor(part.color.r, part.color.g, part.color.b);
  property->LightingOff();
  property->SetLineWidth(static_cast<float>(part.line_width_pt * point_px));
  return actors;
}

void AddParts(vtkRenderer* renderer, const std::vector<Part>& parts, const ValueColors* colors,
              double point_px) {
  for (const Part& part : parts)
    for (const auto& actor : ActorsOf(part, colors, point_px)) renderer->AddActor(actor);
}

}  // namespace telestrain::viz
