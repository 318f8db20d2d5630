#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/csv.h"
#include "base/numbers.h"
#include "viz/results_parts.h"

namespace telestrain::viz {
namespace {

constexpr std::size_t kCells = kResidualCellColumns * kResidualCellRows;
constexpr std::array kNumberColumns{"u_px", "v_px", "du_px", "dv_px"};

// Sums over the corners of one cell.
struct CellSum {
  Eigen::Vector2d error_px = Eigen::Vector2d::Zero();
  double squares_px2 = 0;
  int corners = 0;
};
using ViewSums = std::array<CellSum, kCells>;

struct ResidualColumns {
  std::size_t view = 0;
  std::array<std::size_t, kNumberColumns.size()> numbers{};
};

ResidualColumns ColumnsOf(const CsvTable& table) {
  const auto find = [&](const char* name) {
    const int column = table.Find(name);
    if (column < 0) throw BadField("the column '" + std::string(name) + "' is missing");
    return static_cast<std::size_t>(column);
  };
  ResidualColumns columns;
  columns.view = find("view");
  for (std::size_t i = 0; i < kNumberColumns.size(); ++i)
    columns.numbers[i] = find(kNumberColumns[i]);
  return columns;
}

// u, v, du and dv of a row.
std::array<double, kNumberColumns.size()> NumbersOf(const CsvTable::Row& row,
                                                    const ResidualColumns& columns) {
  std::array<double, kNumberColumns.size()> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string& cell = row.cells[columns.numbers[i]];
    const auto number = ParseDouble(cell);
    if (!number)
      throw BadField("line " + std::to_string(row.line) + ": " + kNumberColumns[i] +
                     ": a number is wanted, found '" + cell + "'");
    numbers[i] = *number;
  }
  return numbers;
}

// The share of the way through `extent_px` pixels from pixel `first`, as one of `cells`; a place on
// the far edge belongs to the last one. Nothing outside.
std::optional<std::size_t> CellAt(double place_px, int first, int extent_px, int cells) {
  const double share = (place_px - (first - 0.5)) / extent_px;
  if (!(share >= 0 && share <= 1)) return {};
  return static_cast<std::size_t>(std::min(static_cast<int>(share * cells), cells - 1));
}

void AddRow(const CsvTable::Row& row, const ResidualColumns& columns, const Scene& scene,
            std::vector<ViewSums>* sums) {
  const std::string where = "line " + std::to_string(row.line) + ": ";
  const auto view =
      std::find_if(scene.views.begin(), scene.views.end(),
                   [&](const ViewVolume& known) { return known.name == row.cells[columns.view]; });
  if (view == scene.views.end())
    throw BadField(where +
                   "view: the name of one of the views of calibration.json is wanted, "
                   "found '" +
                   row.cells[columns.view] + "'");
  const auto index = static_cast<std::size_t>(view - scene.views.begin());
  const auto [u, v, du, dv] = NumbersOf(row, columns);
  const Eigen::Vector4i& region = scene.view_regions_px[index];
  const auto column = CellAt(u, region.x(), region.z(), kResidualCellColumns);
  const auto line = CellAt(v, region.y(), region.w(), kResidualCellRows);
  if (!column || !line)
    throw BadField(where + "u_px, v_px: a place in region_px of view " + view->name +
                   " is wanted, found " + FormatFixed(u, 2) + ", " + FormatFixed(v, 2));
  CellSum& sum = (*sums)[index][*line * kResidualCellColumns + *column];
  sum.error_px += Eigen::Vector2d(du, dv);
  sum.squares_px2 += du * du + dv * dv;
  ++sum.corners;
}

void AppendCells(const ViewSums& sums, const Eigen::Vector4i& region,
                 std::vector<ResidualCell>* cells) {
  for (std::size_t i = 0; i < kCells; ++i) {
    const CellSum& sum = sums[i];
    if (sum.corners == 0) continue;
    const Eigen::Vector2d place(static_cast<double>(i % kResidualCellColumns) + 0.5,
                                static_cast<double>(i / kResidualCellColumns) + 0.5);
    const Eigen::Vector2d size_px(static_cast<double>(region.z()) / kResidualCellColumns,
                                  static_cast<double>(region.w()) / kResidualCellRows);
    ResidualCell cell;
    cell.center_px = region.head<2>().cast<double>() - Eigen::Vector2d::Constant(0.5) +
                     place.cwiseProduct(size_px);
    cell.mean_px = sum.error_px / sum.corners;
    cell.rms_px = std::sqrt(sum.squares_px2 / (2 * sum.corners));
    cell.corners = sum.corners;
    cells->push_back(cell);
  }
}

}  // namespace

Result<std::vector<ResidualCell>> ResidualCellsOf(const std::filesystem::path& results,
                                                  const Scene& scene) {
  std::vector<ResidualCell> cells;
  const auto path = results / "residuals.csv";
  if (!std::filesystem::exists(path)) return cells;
  TELESTRAIN_ASSIGN_OR_RETURN(const CsvTable table, ReadCsv(path));
  std::vector<ViewSums> sums(scene.views.size());
  TELESTRAIN_RETURN_IF_ERROR(ReadFields(path, "telestrain calibrate", [&] {
    const ResidualColumns columns = ColumnsOf(table);
    for (const CsvTable::Row& row : table.rows) AddRow(row, columns, scene, &sums);
  }));
  for (std::size_t i = 0; i < sums.size(); ++i)
    AppendCells(sums[i], scene.view_regions_px[i], &cells);
  return cells;
}

}  // namespace telestrain::viz
