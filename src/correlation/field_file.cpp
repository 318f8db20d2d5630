#include "correlation/field_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/csv.h"
#include "base/numbers.h"
#include "correlation/field_summary.h"

namespace telestrain {
namespace {

constexpr double kMicro = 1e6;
// A tenth of what the quietest subsets of practice resolve: 1e-4 px, 1e-7 strain at a point.
constexpr int kPixelDecimals = 6, kStrainDecimals = 9, kMicrostrainDecimals = 3;

std::string Cell(double value, int decimals) {
  return std::isfinite(value) ? FormatFixed(value, decimals) : std::string();
}

std::string Number(double value, int decimals) {
  return std::isfinite(value) ? FormatFixed(value, decimals) : std::string("nan");
}

double SigmaOf(const SubsetMatch& match, int axis) {
  return std::sqrt(match.covariance(axis, axis));
}

std::string DataArray(const std::string& type, const std::string& name, int components,
                      const std::string& values) {
  std::string text = "        <DataArray type=\"" + type + "\" Name=\"" + name + "\"";
  if (components > 1) text += " NumberOfComponents=\"" + std::to_string(components) + "\"";
  return text + " format=\"ascii\">\n" + values + "        </DataArray>\n";
}

// Which points a cell of the file joins.
struct Cells {
  std::vector<std::array<std::size_t, 4>> quads;
  std::vector<std::size_t> vertices;
};

Cells CellsOf(const CorrelationField& field) {
  constexpr auto kNone = static_cast<std::size_t>(-1);
  const auto columns = static_cast<std::size_t>(field.columns);
  std::vector<std::size_t> at(columns * static_cast<std::size_t>(field.rows), kNone);
  for (std::size_t i = 0; i < field.points.size(); ++i)
    if (const FieldPoint& point = field.points[i]; point.match.ok())
      at[static_cast<std::size_t>(point.row) * columns + static_cast<std::size_t>(point.column)] =
          i;
  Cells cells;
  std::vector<bool> joined(field.points.size(), false);
  for (std::size_t i = 0; i + columns < at.size(); ++i) {
    if (i % columns + 1 == columns) continue;
    const std::array<std::size_t, 4> quad{at[i], at[i + 1], at[i + columns + 1], at[i + columns]};
    if (std::find(quad.begin(), quad.end(), kNone) != quad.end()) continue;
    cells.quads.push_back(quad);
    for (const std::size_t point : quad) joined[point] = true;
  }
  for (std::size_t i = 0; i < joined.size(); ++i)
    if (!joined[i]) cells.vertices.push_back(i);
  return cells;
}

std::string Offsets(std::size_t count, std::size_t size) {
  std::string text;
  for (std::size_t i = 1; i <= count; ++i) text += std::to_string(i * size) + "\n";
  return DataArray("Int64", "offsets", 1, text);
}

std::string VerticesXml(const Cells& cells) {
  std::string connectivity;
  for (const std::size_t point : cells.vertices) connectivity += std::to_string(point) + "\n";
  return "      <Verts>\n" + DataArray("Int64", "connectivity", 1, connectivity) +
         Offsets(cells.vertices.size(), 1) + "      </Verts>\n";
}

std::string QuadsXml(const Cells& cells) {
  std::string connectivity;
  for (const auto& quad : cells.quads)
    connectivity += std::to_string(quad[0]) + " " + std::to_string(quad[1]) + " " +
                    std::to_string(quad[2]) + " " + std::to_string(quad[3]) + "\n";
  return "      <Polys>\n" + DataArray("Int64", "connectivity", 1, connectivity) +
         Offsets(cells.quads.size(), 4) + "      </Polys>\n";
}

std::string PointsXml(const CorrelationField& field) {
  std::string text;
  for (const FieldPoint& point : field.points)
    text +=
        std::to_string(point.center_px.x()) + " " + std::to_string(point.center_px.y()) + " 0\n";
  return "      <Points>\n" + DataArray("Float64", "position_px", 3, text) + "      </Points>\n";
}

// One array with `value` of every point that converged.
template <class Value>
std::string ScalarXml(const CorrelationField& field, const std::string& name, int decimals,
                      const Value& value) {
  std::string text;
  for (const FieldPoint& point : field.points)
    text += (point.match.ok() ? Number(value(point), decimals) : "nan") + "\n";
  return DataArray("Float64", name, 1, text);
}

std::string PointDataXml(const CorrelationField& field) {
  std::string displacement, status;
  for (const FieldPoint& point : field.points) {
    const Eigen::Vector2d& moved_px = point.match.shape.displacement_px;
    displacement += point.match.ok() ? Number(moved_px.x(), kPixelDecimals) + " " +
                                           Number(moved_px.y(), kPixelDecimals) + " 0\n"
                                     : "nan nan 0\n";
    status += std::to_string(static_cast<int>(point.match.status)) + "\n";
  }
  const auto strain = [&](const std::string& name, int row, int column) {
    return ScalarXml(field, name, kMicrostrainDecimals,
                     [=](const FieldPoint& point) { return kMicro * point.strain(row, column); });
  };
  const auto sigma = [&](const std::string& name, int axis) {
    return ScalarXml(field, name, kPixelDecimals,
                     [=](const FieldPoint& point) { return SigmaOf(point.match, axis); });
  };
  return "      <PointData Scalars=\"status\" Vectors=\"displacement_px\">\n" +
         DataArray("Float64", "displacement_px", 3, displacement) +
         strain("exx_microstrain", 0, 0) + strain("eyy_microstrain", 1, 1) +
         strain("exy_microstrain", 0, 1) +
         ScalarXml(field, "zncc", kPixelDecimals,
                   [](const FieldPoint& point) { return point.match.zncc; }) +
         sigma("sigma_u_px", 0) + sigma("sigma_v_px", 1) + DataArray("Int32", "status", 1, status) +
         "      </PointData>\n";
}

// Which number of the array "status" means what.
std::string StatusCodes() {
  std::string text = "status:";
  for (std::size_t code = 0; code < kStatusCount; ++code)
    text += code == 0 ? " 0 ok"
                      : ", " + std::to_string(code) + " " + ToText(static_cast<MatchStatus>(code));
  return text;
}

}  // namespace

int StrainGauge_px(const FieldOptions& options) {
  return (options.strain_window_points - 1) * options.step_px + options.correlation.subset_px;
}

std::vector<std::string> FieldDefinitions(const FieldOptions& options) {
  const int window = options.strain_window_points;
  return {
      "u, v: displacement in px from the reference to the image, x to the right, y down; "
      "pixel (0, 0) is the centre of the top left one; x, y: place on the reference image",
      "exx, eyy, exy: Green-Lagrange strain, exy the tensor's (half of gamma), of a plane "
      "through u and v of " +
          std::to_string(window) + " x " + std::to_string(window) + " points; strain gauge " +
          std::to_string(StrainGauge_px(options)) + " px wide, subset included",
      "sigma_u, sigma_v: standard deviation from the images' noise as the match shows it"};
}

CorrelationField PointsInside(CorrelationField field, const PixelMask& mask) {
  std::erase_if(field.points, [&](const FieldPoint& point) {
    return !mask.At(point.center_px.x(), point.center_px.y());
  });
  return field;
}

std::string FieldCsv(const CorrelationField& field) {
  std::string text = "x_px,y_px,u_px,v_px,exx,eyy,exy,zncc,sigma_u_px,sigma_v_px,status\n";
  for (const FieldPoint& point : field.points) {
    const SubsetMatch& match = point.match;
    text += std::to_string(point.center_px.x()) + "," + std::to_string(point.center_px.y()) + ",";
    if (!match.ok()) {
      text += ",,,,,,,," + ToText(match.status) + "\n";
      continue;
    }
    for (const int axis : {0, 1})
      text += Cell(match.shape.displacement_px[axis], kPixelDecimals) + ",";
    for (const double strain : {point.strain(0, 0), point.strain(1, 1), point.strain(0, 1)})
      text += Cell(strain, kStrainDecimals) + ",";
    text += Cell(match.zncc, kPixelDecimals) + ",";
    for (const int axis : {0, 1}) text += Cell(SigmaOf(match, axis), kPixelDecimals) + ",";
    text += "ok\n";
  }
  return text;
}

std::string FieldVtp(const CorrelationField& field, const std::vector<std::string>& definitions) {
  const Cells cells = CellsOf(field);
  std::string text = "<?xml version=\"1.0\"?>\n<!--\n";
  for (const std::string& line : definitions) text += line + "\n";
  text += StatusCodes() + "\n-->\n";
  text +=
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <PolyData>\n    <Piece NumberOfPoints=\"" +
      std::to_string(field.points.size()) + "\" NumberOfVerts=\"" +
      std::to_string(cells.vertices.size()) + "\" NumberOfPolys=\"" +
      std::to_string(cells.quads.size()) + "\">\n";
  text += PointsXml(field);
  text += PointDataXml(field);
  text += VerticesXml(cells);
  text += QuadsXml(cells);
  return text + "    </Piece>\n  </PolyData>\n</VTKFile>\n";
}

}  // namespace telestrain
