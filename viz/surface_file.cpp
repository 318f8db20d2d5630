#include "viz/surface_file.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>

#include "viz/vtk_messages.h"

namespace telestrain::viz {
namespace {

Error Malformed(const std::filesystem::path& path, const std::string& problem) {
  return BadInput(path.string() + ": " + problem +
                  "; make the file again with 'telestrain measure'");
}

// The point data array of that name with one finite number per point, or an empty vector.
std::vector<double> PointNumbers(vtkPolyData* data, const char* name) {
  vtkDataArray* array = data->GetPointData()->GetArray(name);
  if (array == nullptr || array->GetNumberOfComponents() != 1 ||
      array->GetNumberOfTuples() != data->GetNumberOfPoints())
    return {};
  std::vector<double> numbers(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = array->GetComponent(static_cast<vtkIdType>(i), 0);
    if (!std::isfinite(numbers[i])) return {};
  }
  return numbers;
}

// False when a cell is no quad or names a point that does not exist.
bool ReadQuads(vtkPolyData* data, Surface* surface) {
  auto iterator = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell()) {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    iterator->GetCurrentCell(size, points);
    if (size != 4) return false;
    std::array<int, 4> quad{};
    for (std::size_t i = 0; i < 4; ++i) {
      if (points[i] < 0 || points[i] >= data->GetNumberOfPoints()) return false;
      quad[i] = static_cast<int>(points[i]);
    }
    surface->quads.push_back(quad);
  }
  return !surface->quads.empty();
}

bool ReadPoints(vtkPolyData* data, Surface* surface) {
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    Eigen::Vector3d point_mm;
    data->GetPoint(i, point_mm.data());
    if (!point_mm.allFinite()) return false;
    surface->points_in_array_mm.push_back(point_mm);
  }
  return true;
}

}  // namespace

Result<Surface> ReadSurface(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path))
    return Malformed(path, "does not exist, strain.json names it");
  VtkMessages messages;
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  if (const std::string problem = messages.FirstError(); !problem.empty())
    return Malformed(path, "is no VTK XML PolyData: " + problem);
  Surface surface;
  if (!ReadPoints(data, &surface)) return Malformed(path, "a point is not finite");
  if (!ReadQuads(data, &surface)) return Malformed(path, "valid quads are wanted as polygons");
  PointValues axial{{"axial_microstrain", "axial strain", "\u00b5\u03b5"},
                    PointNumbers(data, "axial_microstrain")};
  if (axial.values.empty())
    return Malformed(path, "point data 'axial_microstrain' with a finite number per point missing");
  surface.values.push_back(std::move(axial));
  const std::vector<double> groups = PointNumbers(data, "group");
  if (groups.empty()) return Malformed(path, "point data 'group' is missing");
  for (const double group : groups) surface.group.push_back(group < 0.5 ? 0 : 1);
  return surface;
}

}  // namespace telestrain::viz
