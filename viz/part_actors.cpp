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
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cstdint>

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

// Parts that look alike but for their colour, drawn as one: every actor costs time in every layer
// of transparency, and there are hundreds of boards.
class Batch {
 public:
  explicit Batch(const Part& part) : all_(part) {
    all_.values.clear();
    all_.mesh = {};
    Add(part);
  }
  bool Takes(const Part& part) const {
    return part.opacity == all_.opacity && part.lit == all_.lit &&
           part.line_width_pt == all_.line_width_pt;
  }
  void Add(const Part& part) {
    all_.mesh.Append(part.mesh);
    colors_.resize(all_.mesh.points_in_array_mm.size(), BytesOf(part.color));
  }
  std::vector<vtkSmartPointer<vtkActor>> Actors(double point_px) const {
    vtkNew<vtkUnsignedCharArray> rgb;
    rgb->SetNumberOfComponents(3);
    for (const auto& color : colors_) rgb->InsertNextTypedTuple(color.data());
    auto actors = ActorsOf(all_, nullptr, point_px);
    for (const auto& actor : actors) {
      auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
      mapper->GetInput()->GetPointData()->SetScalars(rgb);
      mapper->SetScalarModeToUsePointData();
      mapper->ScalarVisibilityOn();
    }
    return actors;
  }

 private:
  Part all_;
  std::vector<std::array<std::uint8_t, 3>> colors_;  // per point
};

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
  std::vector<Batch> batches;
  for (const Part& part : parts) {
    if (colors != nullptr && Find(part, colors->quantity) != nullptr) {
      for (const auto& actor : ActorsOf(part, colors, point_px)) renderer->AddActor(actor);
      continue;
    }
    const auto like = std::find_if(batches.begin(), batches.end(),
                                   [&](const Batch& batch) { return batch.Takes(part); });
    if (like == batches.end())
      batches.emplace_back(part);
    else
      like->Add(part);
  }
  for (const Batch& batch : batches)
    for (const auto& actor : batch.Actors(point_px)) renderer->AddActor(actor);
}

}  // namespace telestrain::viz
