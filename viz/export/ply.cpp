#include "viz/export/ply.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "viz/export/little_endian.h"
#include "viz/export/shown_values.h"

namespace telestrain::viz {
namespace {

// A comment is one line.
std::string OneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '\r', ' ');
  return text;
}

// A column of the file: its name and a number per point.
struct Column {
  std::string name;
  std::vector<double> numbers;
};

void AddVectors(const std::array<std::string, 3>& names,
                const std::vector<Eigen::Vector3d>& vectors, std::vector<Column>* columns) {
  for (int axis = 0; axis < 3; ++axis) {
    Column column{names[static_cast<std::size_t>(axis)], {}};
    for (const Eigen::Vector3d& vector : vectors) column.numbers.push_back(vector[axis]);
    columns->push_back(std::move(column));
  }
}

// What the file holds of a surface; what was not measured has no column.
std::vector<Column> ColumnsOf(const Surface& surface) {
  std::vector<Column> columns;
  AddVectors({"x", "y", "z"}, surface.points_in_array_mm, &columns);
  AddVectors({"displacement_x_mm", "displacement_y_mm", "displacement_z_mm"},
             surface.displacement_mm, &columns);
  columns.push_back({"sigma_um", surface.sigma_um});
  for (const PointValues& values : surface.values)
    if (values.quantity.key != "sigma_um") columns.push_back({values.quantity.key, values.values});
  std::erase_if(columns, [](const Column& column) { return column.numbers.empty(); });
  return columns;
}

std::string HeaderOf(const Pipe& pipe, std::size_t state, const std::vector<Column>& columns) {
  const std::size_t points = pipe.states[state].surface.points_in_array_mm.size();
  std::string text =
      "ply\nformat binary_little_endian 1.0\ncomment telestrain, measured pipe surface, " +
      OneLine(StateText(pipe, state)) +
      "\ncomment x y z in mm, array frame (x along the pipe); a name's end is its unit\n"
      "comment displacement from the reference state; sigma_um is the standard uncertainty along "
      "the "
      "pipe; nan: no value\nelement vertex " +
      std::to_string(points) + "\n";
  for (const Column& column : columns) text += "property double " + column.name + "\n";
  return text + "property int group\nend_header\n";
}

}  // namespace

std::string PlyBytes(const Pipe& pipe, std::size_t state) {
  const Surface& surface = pipe.states[state].surface;
  const auto columns = ColumnsOf(surface);
  std::string bytes = HeaderOf(pipe, state, columns);
  for (std::size_t i = 0; i < surface.points_in_array_mm.size(); ++i) {
    for (const Column& column : columns) AppendLittleEndian(column.numbers[i], &bytes);
    AppendLittleEndian(static_cast<std::uint32_t>(surface.group[i]), &bytes);
  }
  return bytes;
}

}  // namespace telestrain::viz
