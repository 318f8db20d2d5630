#include "viz/surface_file.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "base/files.h"
#include "base/numbers.h"
#include "viz/quantity.h"
#include "viz/vtk_messages.h"

namespace telestrain::viz {
namespace {

constexpr const char* kAxial = "axial_microstrain";
constexpr const char* kSigma = "sigma_um";
constexpr const char* kDisplacement = "displacement_mm";
constexpr const char* kGroup = "group";

Error Malformed(const std::filesystem::path& path, const std::string& problem) {
  return BadInput(path.string() + ": " + problem +
                  "; make the file again with 'telestrain measure'");
}

// VTK takes memory for the counts that a file states before it reads what is there. In text, as
// `measure` writes it, a point or a cell takes a byte at least; packed files are none of ours.
std::string CountFault(const std::string& text) {
  if (text.find("compressor=") != std::string::npos) return "is packed";
  constexpr std::string_view kBegin = "NumberOf";
  double components = 1, others = 1;  // the largest ones
  for (std::size_t at = text.find(kBegin); at != std::string::npos; at = text.find(kBegin, at)) {
    at += kBegin.size();
    const std::size_t quote = text.find('"', at), end = text.find('"', quote + 1);
    if (end == std::string::npos) break;  // VTK says what is wrong
    const auto count = ParseDouble(text.substr(quote + 1, end - quote - 1));
    double& largest = text.compare(at, 10, "Components") == 0 ? components : others;
    largest = std::max(largest, count.value_or(-1));
    if (!count || *count < 0 || components * others > static_cast<double>(text.size()))
      return "states a count at byte " + std::to_string(quote + 1) + " that its " +
             std::to_string(text.size()) + " bytes cannot hold";
  }
  return "";
}

// Whether the array has a row of `components` numbers for every point.
bool FitsPoints(vtkDataArray* array, vtkPolyData* data, int components) {
  return array != nullptr && array->GetNumberOfComponents() == components &&
         array->GetNumberOfTuples() == data->GetNumberOfPoints();
}

// One number per point, NaN where it is not finite.
std::vector<double> Numbers(vtkDataArray* array) {
  std::vector<double> numbers(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = array->GetComponent(static_cast<vtkIdType>(i), 0);
    if (!std::isfinite(numbers[i])) numbers[i] = std::numeric_limits<double>::quiet_NaN();
  }
  return numbers;
}

// False when a point has no finite axial strain.
bool ReadQuantities(vtkPolyData* data, Surface* surface) {
  vtkPointData* arrays = data->GetPointData();
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = arrays->GetArray(i);
    const std::string key = arrays->GetArrayName(i) == nullptr ? "" : arrays->GetArrayName(i);
    if (key.empty() || key == kGroup || !FitsPoints(array, data, 1)) continue;
    PointValues values{QuantityOf(key), Numbers(array)};
    if (key == kSigma) surface->sigma_um = values.values;
    surface->values.insert(key == kAxial ? surface->values.begin() : surface->values.end(),
                           std::move(values));
  }
  const PointValues* axial = surface->Find(kAxial);
  return axial != nullptr && std::all_of(axial->values.begin(), axial->values.end(),
                                         [](double value) { return std::isfinite(value); });
}

bool ReadGroups(vtkPolyData* data, int group_count, Surface* surface) {
  vtkDataArray* array = data->GetPointData()->GetArray(kGroup);
  if (!FitsPoints(array, data, 1)) return false;
  for (const double group : Numbers(array)) {
    if (!(group >= 0 && group < group_count && group == std::floor(group))) return false;
    surface->group.push_back(static_cast<int>(group));
  }
  return true;
}

bool ReadDisplacements(vtkPolyData* data, Surface* surface) {
  vtkDataArray* array = data->GetPointData()->GetArray(kDisplacement);
  if (!FitsPoints(array, data, 3)) return false;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
    Eigen::Vector3d displacement_mm;
    array->GetTuple(i, displacement_mm.data());
    if (!displacement_mm.allFinite()) return false;
    surface->displacement_mm.push_back(displacement_mm);
  }
  return true;
}

// A quad lies in one group: what joins two would be a surface between the fields.
bool QuadsKeepToGroups(const Surface& surface) {
  const auto group = [&](int point) { return surface.group[static_cast<std::size_t>(point)]; };
  return std::all_of(surface.quads.begin(), surface.quads.end(), [&](const auto& quad) {
    return std::all_of(quad.begin(), quad.end(),
                       [&](int point) { return group(point) == group(quad[0]); });
  });
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

Result<Surface> ReadSurface(const std::filesystem::path& path, int group_count) {
  if (!std::filesystem::is_regular_file(path))
    return Malformed(path, "does not exist, strain.json names it");
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(path, kMostJsonBytes));
  if (const std::string fault = CountFault(text); !fault.empty()) return Malformed(path, fault);
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
  if (!ReadQuantities(data, &surface))
    return Malformed(path, "point data 'axial_microstrain' with a finite number per point missing");
  if (!ReadDisplacements(data, &surface))
    return Malformed(path, "point data 'displacement_mm' with 3 finite numbers per point missing");
  if (!ReadGroups(data, group_count, &surface))
    return Malformed(path, "point data 'group' with whole numbers from 0 to " +
                               std::to_string(group_count - 1) + " missing");
  if (!QuadsKeepToGroups(surface)) return Malformed(path, "a quad joins points of two groups");
  return surface;
}

}  // namespace telestrain::viz
