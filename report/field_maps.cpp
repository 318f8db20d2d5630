#include "report/field_maps.h"

#include <algorithm>
#include <cmath>

#include "report/chart_files.h"
#include "report/report_charts.h"
#include "report/text_wrap.h"

namespace telestrain {
namespace {

constexpr double kTitle_pt = 12, kGap_pt = 6, kOverlap_pt = 0.15;
constexpr double kLeastScalars = 6;  // with fewer mrcal.json gives neither mean nor sd

double WidthOf_px(const FieldMap& map) { return std::max(map.columns - 1, 1) * map.step_x_px; }
double HeightOf_px(const FieldMap& map) { return std::max(map.rows - 1, 1) * map.step_y_px; }

struct Arrangement {
  int columns = 1, rows = 1;
  double points_per_px = 0;
};

// The number of columns that shows the maps largest.
Arrangement Arrange(const std::vector<FieldMap>& maps, double width_pt, double height_pt) {
  double width_px = 1, height_px = 1;
  for (const FieldMap& map : maps) {
    width_px = std::max(width_px, WidthOf_px(map));
    height_px = std::max(height_px, HeightOf_px(map));
  }
  Arrangement best;
  const int count = static_cast<int>(maps.size());
  for (int columns = 1; columns <= count; ++columns) {
    const int rows = (count + columns - 1) / columns;
    const double room_x_pt = (width_pt - kGap_pt * (columns - 1)) / columns;
    const double room_y_pt = (height_pt - kGap_pt * (rows - 1)) / rows - kTitle_pt;
    const double scale = std::min(room_x_pt / width_px, room_y_pt / height_px);
    if (scale > best.points_per_px) best = {columns, rows, scale};
  }
  return best;
}

void DrawMap(PageFlow& flow, const PageBox& area, const FieldMap& map, const ColorScale& colors) {
  PdfDocument& pdf = flow.pdf();
  TextStyle title{Face::kBold, 7.5, flow.look().ink};
  pdf.DrawText(title, {area.left_pt, area.top_pt() + 3},
               ShortenedText(pdf, title, map.title, area.width_pt));
  const double width_pt = area.width_pt / std::max(map.columns - 1, 1);
  const double height_pt = area.height_pt / std::max(map.rows - 1, 1);
  pdf.BeginClip(area);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    if (!map.values[i]) continue;
    const int column = static_cast<int>(i) % map.columns, row = static_cast<int>(i) / map.columns;
    pdf.FillBox({area.left_pt + (column - 0.5) * width_pt - kOverlap_pt,
                 area.top_pt() - (row + 0.5) * height_pt - kOverlap_pt, width_pt + 2 * kOverlap_pt,
                 height_pt + 2 * kOverlap_pt},
                colors.ColorOfValue(*map.values[i]));
  }
  pdf.EndClip();
  pdf.StrokeBox(area, {ColorOf(0x404040), 0.6});
}

// Whether `count` values fill that many columns and rows, both whole numbers.
bool FillsGrid(std::size_t count, std::optional<double> columns, std::optional<double> rows) {
  return columns && rows && *columns >= 1 && *rows >= 1 && std::floor(*columns) == *columns &&
         std::floor(*rows) == *rows && static_cast<double>(count) == *columns * *rows;
}

// The map of one view of mrcal.json, of the list `key`. Empty when it is not one.
std::optional<FieldMap> MapOf(const Json& view, const char* key) {
  const Json& regional = EntryAt(view, "/regional");
  const auto columns = NumberAt(regional, "/columns"), rows = NumberAt(regional, "/rows");
  const auto step_x_px = NumberAt(regional, "/step_x_px");
  const auto step_y_px = NumberAt(regional, "/step_y_px");
  const Json& values = ListAt(regional, key);
  const Json& scalars = ListAt(regional, "/scalars");
  if (!FillsGrid(values.size(), columns, rows) || scalars.size() != values.size()) return {};
  if (!step_x_px || !step_y_px || *step_x_px <= 0 || *step_y_px <= 0) return {};
  FieldMap map{"", static_cast<int>(*columns), static_cast<int>(*rows), *step_x_px, *step_y_px, {}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string at = "/" + std::to_string(i);
    const bool enough = NumberAt(scalars, at).value_or(0) >= kLeastScalars;
    map.values.push_back(enough ? NumberAt(values, at) : std::nullopt);
  }
  return map;
}

std::vector<FieldMap> MapsOf(const ReportContext& context, const Json& diagnosis, const char* key) {
  std::vector<FieldMap> maps;
  for (const Json& view : ListAt(diagnosis, "/residuals/views")) {
    auto map = MapOf(view, key);
    if (!map) continue;
    map->title = context.layout.Say("View") + " " + TextAt(view, "/view", "?");
    maps.push_back(std::move(*map));
  }
  return maps;
}

// The maps of mrcal.json's part `uncertainty`; of the list `key`.
std::vector<FieldMap> UncertaintyMapsOf(const ReportContext& context, const Json& diagnosis,
                                        const char* key) {
  std::vector<FieldMap> maps;
  for (const Json& entry : ListAt(diagnosis, "/uncertainty/maps")) {
    const auto columns = NumberAt(entry, "/columns"), rows = NumberAt(entry, "/rows");
    const auto step_x_px = NumberAt(entry, "/step_x_px");
    const auto step_y_px = NumberAt(entry, "/step_y_px");
    const Json& values = ListAt(entry, key);
    if (!FillsGrid(values.size(), columns, rows) || *columns < 2) continue;
    if (!step_x_px || !step_y_px || *step_x_px <= 0 || *step_y_px <= 0) continue;
    FieldMap map{context.layout.Say("View") + " " + TextAt(entry, "/view", "?"),
                 static_cast<int>(*columns),
                 static_cast<int>(*rows),
                 *step_x_px,
                 *step_y_px,
                 {}};
    for (std::size_t i = 0; i < values.size(); ++i)
      map.values.push_back(NumberAt(values, "/" + std::to_string(i)));
    maps.push_back(std::move(map));
  }
  return maps;
}

double LargestOf(const std::vector<FieldMap>& maps) {
  double largest = 0;
  for (const FieldMap& map : maps)
    for (const auto& value : map.values) largest = std::max(largest, std::abs(value.value_or(0)));
  return largest;
}

}  // namespace

void DrawFieldMaps(const ReportContext& context, const PageBox& box,
                   const std::vector<FieldMap>& maps, const PlotAxis& scale) {
  if (maps.empty()) return DrawNoData(context, box);
  const double room_pt = box.width_pt - kColorBarWidth_pt - 2 * kGap_pt;
  const Arrangement grid = Arrange(maps, room_pt, box.height_pt - kGap_pt);
  const double cell_x_pt = (room_pt - kGap_pt * (grid.columns - 1)) / grid.columns;
  const ColorScale colors(scale);
  double tallest_px = 1, bottom_pt = box.top_pt();
  for (const FieldMap& map : maps) tallest_px = std::max(tallest_px, HeightOf_px(map));
  const double step_y_pt = grid.points_per_px * tallest_px + kTitle_pt + kGap_pt;
  for (int i = 0; i < static_cast<int>(maps.size()); ++i) {
    const FieldMap& map = maps[static_cast<std::size_t>(i)];
    const double width_pt = grid.points_per_px * WidthOf_px(map);
    const double height_pt = grid.points_per_px * HeightOf_px(map);
    const double x_pt =
        box.left_pt + (i % grid.columns) * (cell_x_pt + kGap_pt) + (cell_x_pt - width_pt) / 2;
    const double top_pt = box.top_pt() - (i / grid.columns) * step_y_pt - kTitle_pt;
    DrawMap(context.flow, {x_pt, top_pt - height_pt, width_pt, height_pt}, map, colors);
    bottom_pt = std::min(bottom_pt, top_pt - height_pt);
  }
  DrawColorBar(context.flow,
               {box.left_pt + room_pt + 2 * kGap_pt, bottom_pt, kColorBarWidth_pt,
                box.top_pt() - kTitle_pt - bottom_pt},
               colors);
}

// The colours reach at least one standard deviation of a residual: noise stays in the middle.
Status DrawRegionalMeans(const ReportContext& context, const PageBox& box) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json diagnosis, ReadDiagnosis(context.folder));
  const std::vector<FieldMap> maps = MapsOf(context, diagnosis, "/mean_px");
  const double sigma_px = NumberAt(diagnosis, "/residuals/sigma_px").value_or(0);
  const double reach_px = std::max(LargestOf(maps), sigma_px);
  DrawFieldMaps(context, box, maps,
                {context.layout.Say("Mean residual / px"), -reach_px, reach_px});
  return {};
}

Status DrawRegionalDeviations(const ReportContext& context, const PageBox& box) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json diagnosis, ReadDiagnosis(context.folder));
  const std::vector<FieldMap> maps = MapsOf(context, diagnosis, "/sd_px");
  DrawFieldMaps(context, box, maps,
                {context.layout.Say("Standard deviation / px"), 0, LargestOf(maps)});
  return {};
}

Status DrawProjectionUncertainty(const ReportContext& context, const PageBox& box) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json diagnosis, ReadDiagnosis(context.folder));
  const std::vector<FieldMap> maps = UncertaintyMapsOf(context, diagnosis, "/sigma_of_noise_um");
  DrawFieldMaps(context, box, maps,
                {context.layout.Say("Standard uncertainty / µm"), 0, LargestOf(maps)});
  return {};
}

Status DrawProjectionUncertaintyOfEverything(const ReportContext& context, const PageBox& box) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json diagnosis, ReadDiagnosis(context.folder));
  const std::vector<FieldMap> maps = UncertaintyMapsOf(context, diagnosis, "/sigma_um");
  DrawFieldMaps(context, box, maps,
                {context.layout.Say("Standard uncertainty / µm"), 0, LargestOf(maps)});
  return {};
}

}  // namespace telestrain
