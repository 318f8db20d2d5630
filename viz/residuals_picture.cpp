#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "viz/color_bar.h"
#include "viz/legend.h"
#include "viz/pictures.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene_marks.h"

namespace telestrain::viz {
namespace {

constexpr int kColumns = 12, kRows = 9;  // cells of a view's region, as ResidualCell
constexpr double kMargin_pt = 6, kFooter_pt = 40, kNames_pt = 60;

// Sensor pixels on the canvas: one scale, row 0 at the top.
struct SensorMap {
  PixelBox box;
  double px_per_px = 1;

  Eigen::Vector2d At(const Eigen::Vector2d& sensor_px) const {
    return {box.left + (sensor_px.x() + 0.5) * px_per_px,
            box.Top() - (sensor_px.y() + 0.5) * px_per_px};
  }
  // `size_px` about a centre.
  PixelBox Around(const Eigen::Vector2d& center_px, const Eigen::Vector2d& size_px) const {
    const Eigen::Vector2d low = At(center_px - 0.5 * size_px), high = At(center_px + 0.5 * size_px);
    const double left = std::round(low.x()), bottom = std::round(high.y());
    return {left, bottom, std::round(high.x()) - left, std::round(low.y()) - bottom};
  }
};

SensorMap MapInto(const Scene& scene, const PixelBox& room) {
  const Eigen::Vector2d sensor = scene.sensor_px.cast<double>();
  SensorMap map;
  map.px_per_px = std::min(room.width / sensor.x(), room.height / sensor.y());
  map.box = {std::round(room.left + 0.5 * (room.width - map.px_per_px * sensor.x())),
             std::round(room.bottom + 0.5 * (room.height - map.px_per_px * sensor.y())),
             std::round(map.px_per_px * sensor.x()), std::round(map.px_per_px * sensor.y())};
  return map;
}

ColorScale CellScale(const Scene& scene) {
  std::vector<double> values_px{0};
  for (const ResidualCell& cell : scene.residual_cells) values_px.push_back(cell.rms_px);
  return ScaleFor(values_px, 0);
}

// The size of a cell: that of the view whose region holds it.
Eigen::Vector2d CellSize(const Scene& scene, const ResidualCell& cell) {
  for (const Eigen::Vector4i& region : scene.view_regions_px) {
    const Eigen::Vector2d from_px = cell.center_px - region.head<2>().cast<double>();
    if ((from_px.array() >= -0.5).all() && from_px.x() < region[2] && from_px.y() < region[3])
      return {region[2] / double{kColumns}, region[3] / double{kRows}};
  }
  return Eigen::Vector2d::Zero();
}

// Length on paper over length on the sensor at which the longest mean residual spans a cell.
double ArrowFactor(const Scene& scene) {
  double longest_px = 0, cell_px = 0;
  for (const ResidualCell& cell : scene.residual_cells) {
    longest_px = std::max(longest_px, cell.mean_px.norm());
    cell_px = std::max(cell_px, CellSize(scene, cell).minCoeff());
  }
  return longest_px > 0 && cell_px > 0 ? RoundDown(cell_px / longest_px) : 0;
}

void AddCells(Canvas* canvas, const Scene& scene, const SensorMap& map, const ColorMap& colors) {
  for (const ResidualCell& cell : scene.residual_cells)
    canvas->Shapes().AddBox(map.Around(cell.center_px, CellSize(scene, cell)),
                            colors.At(cell.rms_px));
  const double factor = ArrowFactor(scene);
  for (const ResidualCell& cell : scene.residual_cells)
    AddFlatArrow(canvas, map.At(cell.center_px - 0.5 * factor * cell.mean_px),
                 map.At(cell.center_px + 0.5 * factor * cell.mean_px));
}

void AddRegions(Canvas* canvas, const Scene& scene, const SensorMap& map) {
  for (std::size_t i = 0; i < scene.view_regions_px.size(); ++i) {
    const Eigen::Vector4i& region = scene.view_regions_px[i];
    const Eigen::Vector2d size = region.tail<2>().cast<double>();
    const Eigen::Vector2d first = region.head<2>().cast<double>() - Eigen::Vector2d(0.5, 0.5);
    const PixelBox box = map.Around(first + 0.5 * size, size);
    canvas->Shapes().AddFrame(box, kInk, canvas->Px(0.8));
    const TextStyle style{9, true, ColorOfGroup(scene, scene.views[i].group)};
    const std::string name = Shortened(scene.views[i].name);
    const Eigen::Vector2d text = canvas->TextSize(name, style);
    // Beside the sensor where the region reaches its edge, else in the region.
    const double gap = canvas->Px(4);
    double left = box.left + gap;
    if (region[0] == 0)
      left = map.box.left - gap - text.x();
    else if (region[0] + region[2] == scene.sensor_px.x())
      left = map.box.Right() + gap;
    const Eigen::Vector2d at(left, box.Top() - text.y() - gap);
    canvas->Shapes().AddBox({at.x(), at.y(), text.x(), text.y()}, {1, 1, 1});
    canvas->AddText(name, at, style);
  }
}

Status AddFooter(Canvas* canvas, const Scene& scene) {
  const double margin = canvas->Px(kMargin_pt), height = canvas->Px(kFooter_pt);
  const double bar_px = canvas->Px(160), bar_left = canvas->Width() - bar_px - canvas->Px(14);
  const double factor = ArrowFactor(scene);
  double longest_px = 0;
  int corners = 0;
  for (const ResidualCell& cell : scene.residual_cells) {
    longest_px = std::max(longest_px, cell.mean_px.norm());
    corners += cell.corners;
  }
  using Sign = LegendEntry::Sign;
  const TextStyle style;
  const double decimals = longest_px > 0 ? std::ceil(1.5 - std::log10(longest_px)) : 3;
  const std::vector<LegendEntry> entries{
      {Sign::kLine, kInk, 1,
       "arrow: mean of a cell, \u00d7 " + FormatFixed(factor, 0) + ", longest " +
           FormatFixed(longest_px, std::clamp(static_cast<int>(decimals), 2, 6)) + " px"},
      {Sign::kNone,
       {},
       1,
       CountOf(corners, "corner") + ", observed \u2212 modelled; grey: no corner"}};
  TELESTRAIN_RETURN_IF_ERROR(AddLegend(
      canvas, entries, {margin, margin, bar_left - margin - canvas->Px(8), height - margin}));
  const ColorScale scale = CellScale(scene);
  AddColorBar(canvas, ColorMap::Viridis(scale.low, scale.high), scale, "RMS per coordinate / px",
              {bar_left, 0, bar_px, height});
  return {};
}

}  // namespace

Result<Picture> DrawResiduals(const Scene& scene, const RenderOptions& options) {
  TELESTRAIN_CHECK(!scene.residual_cells.empty(), "a picture of residuals needs some");
  TELESTRAIN_ASSIGN_OR_RETURN(const auto canvas, Canvas::Create(options));
  const double top =
      AddTitle(canvas.get(), "Residuals over the sensor",
               "reprojection RMS " + FormatFixed(scene.reprojection_rms_px, 4) + " px; cells of " +
                   std::to_string(kColumns) + " \u00d7 " + std::to_string(kRows) +
                   " per view; a pattern in the arrows is what the model leaves unexplained");
  const double footer = canvas->Px(kFooter_pt + kMargin_pt), gap = canvas->Px(4);
  const SensorMap map =
      MapInto(scene, {canvas->Px(kNames_pt), footer, canvas->Width() - 2 * canvas->Px(kNames_pt),
                      top - footer - gap});
  const ColorScale scale = CellScale(scene);
  canvas->Shapes().AddBox(map.box, {0.95, 0.95, 0.95});
  AddCells(canvas.get(), scene, map, ColorMap::Viridis(scale.low, scale.high));
  AddRegions(canvas.get(), scene, map);
  TELESTRAIN_RETURN_IF_ERROR(AddFooter(canvas.get(), scene));
  return canvas->Finish();
}

}  // namespace telestrain::viz
