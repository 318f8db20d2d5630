#include "viz/export/paraview.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>

#include "base/numbers.h"
#include "viz/export/shown_values.h"
#include "viz/part_actors.h"
#include "viz/vtk_messages.h"

namespace telestrain::viz {
namespace {

// One block of the scene: what it is called and its data.
struct Block {
  std::string name;
  vtkSmartPointer<vtkPolyData> data;
};

void AddNumbers(const std::string& name, const std::vector<double>& numbers, vtkPolyData* data) {
  if (numbers.empty()) return;
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  for (const double number : numbers) array->InsertNextValue(number);
  data->GetPointData()->AddArray(array);
}

void AddDisplacement(const Surface& surface, vtkPolyData* data) {
  if (surface.displacement_mm.empty()) return;
  vtkNew<vtkDoubleArray> array;
  array->SetName("displacement_mm");
  array->SetNumberOfComponents(3);
  for (const Eigen::Vector3d& vector : surface.displacement_mm)
    array->InsertNextTuple(vector.data());
  data->GetPointData()->AddArray(array);
}

void AddGroups(const Surface& surface, vtkPolyData* data) {
  vtkNew<vtkIntArray> array;
  array->SetName("group");
  for (const int group : surface.group) array->InsertNextValue(group);
  data->GetPointData()->AddArray(array);
}

vtkSmartPointer<vtkPolyData> DataOfSurface(const Surface& surface) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Eigen::Vector3d& point : surface.points_in_array_mm)
    points->InsertNextPoint(point.data());
  vtkNew<vtkCellArray> quads;
  for (const std::array<int, 4>& quad : surface.quads) {
    quads->InsertNextCell(4);
    for (const int point : quad) quads->InsertCellPoint(point);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(quads);
  AddDisplacement(surface, data);
  AddNumbers("sigma_um", surface.sigma_um, data);
  for (const PointValues& values : surface.values)
    if (values.quantity.key != "sigma_um") AddNumbers(values.quantity.key, values.values, data);
  AddGroups(surface, data);
  return data;
}

void AddFacts(const Part& part, vtkPolyData* data) {
  if (part.facts.empty()) return;
  vtkNew<vtkStringArray> array;
  array->SetName("facts");
  for (const Fact& fact : part.facts) array->InsertNextValue(fact.name + ": " + fact.value);
  data->GetFieldData()->AddArray(array);
}

std::vector<Block> BlocksOf(const Scene& scene, const std::vector<Part>& parts, Layer layer) {
  std::vector<Block> blocks;
  if (layer == Layer::kSurface) {
    if (scene.pipe)
      for (std::size_t i = 0; i < scene.pipe->states.size(); ++i)
        blocks.push_back({StateText(*scene.pipe, i), DataOfSurface(scene.pipe->states[i].surface)});
    return blocks;
  }
  for (const Part& part : parts) {
    if (part.layer != layer) continue;
    blocks.push_back({part.name, DataOf(part)});
    AddFacts(part, blocks.back().data);
  }
  return blocks;
}

Result<std::string> VtpBytes(vtkPolyData* data) {
  VtkMessages messages;
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->WriteToOutputStringOn();
  writer->SetCompressorTypeToNone();
  writer->SetDataModeToBinary();
  writer->SetByteOrderToLittleEndian();
  if (writer->Write() != 1 || !messages.FirstError().empty())
    return OutputFailed("export: writing VTK XML failed: " + messages.FirstError());
  return writer->GetOutputString();
}

// As an attribute's value in double quotes.
std::string XmlText(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped.push_back(static_cast<unsigned char>(c) < ' ' ? ' ' : c);
  }
  return escaped;
}

std::string FileName(Layer layer, std::size_t number) {
  std::string digits = std::to_string(number);
  digits.insert(0, digits.size() < 3 ? 3 - digits.size() : 0, '0');
  return "scene/" + NameOf(layer) + "_" + digits + ".vtp";
}

}  // namespace

Result<std::vector<std::pair<std::string, std::string>>> ParaViewFiles(
    const Scene& scene, const std::vector<Part>& parts) {
  std::vector<std::pair<std::string, std::string>> files;
  std::string index =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n  <vtkMultiBlockDataSet>\n";
  int layers = 0;
  for (const Layer layer : kAllLayers) {
    const auto blocks = BlocksOf(scene, parts, layer);
    if (blocks.empty()) continue;
    index +=
        "    <Block index=\"" + std::to_string(layers++) + "\" name=\"" + NameOf(layer) + "\">\n";
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const std::string name = FileName(layer, i);
      TELESTRAIN_ASSIGN_OR_RETURN(std::string bytes, VtpBytes(blocks[i].data));
      files.emplace_back(name, std::move(bytes));
      index += "      <DataSet index=\"" + std::to_string(i) + "\" name=\"" +
               XmlText(blocks[i].name) + "\" file=\"" + name + "\"/>\n";
    }
    index += "    </Block>\n";
  }
  files.emplace_back("scene.vtm", index + "  </vtkMultiBlockDataSet>\n</VTKFile>\n");
  return files;
}

bool IsParaViewPiece(const std::string& file_name) {
  constexpr std::string_view kEnd = ".vtp";
  if (!file_name.ends_with(kEnd)) return false;
  const std::string stem = file_name.substr(0, file_name.size() - kEnd.size());
  const std::optional<int> number = ParseInt(stem.substr(stem.rfind('_') + 1));
  if (!number || *number < 0) return false;
  const auto names_it = [&](Layer layer) {
    return "scene/" + file_name == FileName(layer, static_cast<std::size_t>(*number));
  };
  return std::any_of(std::begin(kAllLayers), std::end(kAllLayers), names_it);
}

}  // namespace telestrain::viz
