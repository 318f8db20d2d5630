#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "report/chart_files.h"
#include "report/plot.h"
#include "report/report_charts.h"

namespace telestrain {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kCellsAcross = 14;     // of the field's grid, along the longer side of a view
constexpr double kArrowKey_pt = 16;  // length of the arrow that the key explains

struct Region {
  double x = 0, y = 0, width = 1, height = 1;  // px
};

Region RegionOf(const Json& view) {
  Region region;
  double* const values[] = {&region.x, &region.y, &region.width, &region.height};
  for (int i = 0; i < 4; ++i)
    if (const auto value = NumberAt(view, "/region_px/" + std::to_string(i))) *values[i] = *value;
  region.width = std::max(region.width, 1.0);
  region.height = std::max(region.height, 1.0);
  return region;
}

struct Mean {
  double u = 0, v = 0, du = 0, dv = 0;
  int count = 0;
};

// Means of the residuals in the cells of a grid over the view's region.
std::map<std::pair<int, int>, Mean> CellMeans(const std::vector<Residual>& residuals,
                                              const std::string& view, const Region& region) {
  const double cell_px = std::max(region.width, region.height) / kCellsAcross;
  // A corner far outside the region is a fault of the file; it has a cell of its own.
  const auto cell = [cell_px](double place_px) {
    return static_cast<int>(std::clamp(place_px / cell_px, -1e6, 1e6));
  };
  std::map<std::pair<int, int>, Mean> cells;
  for (const Residual& residual : residuals) {
    if (residual.view != view) continue;
    Mean& mean = cells[{cell(residual.u_px - region.x), cell(residual.v_px - region.y)}];
    mean.u += residual.u_px;
    mean.v += residual.v_px;
    mean.du += residual.du_px;
    mean.dv += residual.dv_px;
    ++mean.count;
  }
  for (auto& [index, mean] : cells)
    for (double* sum : {&mean.u, &mean.v, &mean.du, &mean.dv}) *sum /= mean.count;
  return cells;
}

void DrawArrow(PdfDocument& pdf, PagePoint from, double dx_pt, double dy_pt, Color color) {
  const PagePoint to{from.x_pt + dx_pt, from.y_pt + dy_pt};
  const double length_pt = std::hypot(dx_pt, dy_pt);
  pdf.DrawLine(from, to, {color, 0.7});
  if (length_pt < 0.5) return;
  const double ux = dx_pt / length_pt, uy = dy_pt / length_pt;
  const double head_pt = std::min(3.2, 0.45 * length_pt), half_pt = 0.38 * head_pt;
  pdf.FillPolygon({to,
                   {to.x_pt - ux * head_pt - uy * half_pt, to.y_pt - uy * head_pt + ux * half_pt},
                   {to.x_pt - ux * head_pt + uy * half_pt, to.y_pt - uy * head_pt - ux * half_pt}},
                  color);
}

// One view's panel: its region to scale, image y downwards, an arrow per cell.
void DrawPanel(PageFlow& flow, const PageBox& box, const Region& region, const std::string& title,
               const std::map<std::pair<int, int>, Mean>& cells, double points_per_px_error) {
  PdfDocument& pdf = flow.pdf();
  const double scale = std::min(box.width_pt / region.width, (box.height_pt - 14) / region.height);
  const double left_pt = box.left_pt + (box.width_pt - scale * region.width) / 2;
  const PageBox area{left_pt, box.top_pt() - 12 - scale * region.height, scale * region.width,
                     scale * region.height};
  pdf.DrawText({Face::kBold, 8, flow.look().ink}, {area.left_pt, area.top_pt() + 3.5}, title);
  pdf.FillBox(area, ColorOf(0xFAFBFC));
  pdf.BeginClip(area);
  for (const auto& [index, mean] : cells) {
    const PagePoint at{area.left_pt + scale * (mean.u - region.x),
                       area.top_pt() - scale * (mean.v - region.y)};
    pdf.FillCircle(at, 0.7, flow.look().muted);
    DrawArrow(pdf, at, points_per_px_error * mean.du, -points_per_px_error * mean.dv,
              flow.look().measured);
  }
  pdf.EndClip();
  pdf.StrokeBox(area, {ColorOf(0x404040), 0.6});
}

}  // namespace

Status DrawResidualField(const ReportContext& context, const PageBox& box) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<Residual> residuals, ReadResiduals(context.folder));
  TELESTRAIN_ASSIGN_OR_RETURN(const Json calibration, ReadCalibration(context.folder));
  const Json& views = ListAt(calibration, "/views");
  const Json& key = FindBy(ListAt(context.results, "/quantities"), "id", "residual_arrow");
  const auto key_px = NumberAt(key, "/value");
  if (residuals.empty() || views.empty() || !key_px) {
    DrawNoData(context, box);
    return {};
  }
  const double key_row_pt = 14, gap_pt = 8;
  const int count = static_cast<int>(views.size());
  const int columns = count > 1 ? 2 : 1, rows = (count + columns - 1) / columns;
  const double width_pt = (box.width_pt - gap_pt * (columns - 1)) / columns;
  const double height_pt = (box.height_pt - key_row_pt - gap_pt * (rows - 1)) / rows;
  for (int i = 0; i < count; ++i) {
    const Json& view = views[static_cast<std::size_t>(i)];
    const std::string name = TextAt(view, "/name", "?");
    const Region region = RegionOf(view);
    const PageBox panel{box.left_pt + (i % columns) * (width_pt + gap_pt),
                        box.top_pt() - (i / columns) * (height_pt + gap_pt) - height_pt, width_pt,
                        height_pt};
    DrawPanel(context.flow, panel, region, context.layout.Say("View") + " " + name,
              CellMeans(residuals, name, region), kArrowKey_pt / *key_px);
  }
  const Look& look = context.flow.look();
  const PagePoint at{box.left_pt, box.bottom_pt + 4};
  DrawArrow(context.flow.pdf(), at, kArrowKey_pt, 0, look.measured);
  context.flow.pdf().DrawText({Face::kRegular, 7.5, look.ink},
                              {at.x_pt + kArrowKey_pt + 6, at.y_pt - 2.6},
                              TextAt(key, "/printed") + " px");
  return {};
}

Status DrawResidualHistogram(const ReportContext& context, const PageBox& box) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json calibration, ReadCalibration(context.folder));
  const Json& histogram = EntryAt(calibration, "/reprojection/histogram");
  const auto bin_px = NumberAt(histogram, "/bin_px"), from_px = NumberAt(histogram, "/from_px");
  const auto rms_px = NumberAt(calibration, "/reprojection/rms_px");
  const Json& counts = ListAt(histogram, "/counts");
  if (counts.empty() || !bin_px || !from_px || !rms_px || *rms_px <= 0 || *bin_px <= 0) {
    DrawNoData(context, box);
    return {};
  }
  double total = 0, highest = 1;
  for (const Json& count : counts) total += count.is_number() ? count.get<double>() : 0;
  const double peak = total * *bin_px / (*rms_px * std::sqrt(2 * kPi));
  for (const Json& count : counts)
    highest = std::max(highest, count.is_number() ? count.get<double>() : 0);
  const double to_px = *from_px + *bin_px * static_cast<double>(counts.size());
  const auto translate = [&](const char* text) { return context.layout.Say(text); };
  Plot plot(context.flow, box, {translate("Residual of one coordinate / px"), *from_px, to_px},
            {translate("Count"), 0, 1.05 * std::max(highest, peak), true});
  const Look& look = context.flow.look();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double left_px = *from_px + *bin_px * static_cast<double>(i);
    const double count = counts[i].is_number() ? counts[i].get<double>() : 0;
    if (count > 0) plot.DrawBar(left_px, left_px + 0.92 * *bin_px, count, ColorOf(0xA9C2DE));
  }
  std::vector<double> x, y;
  for (int i = 0; i <= 200; ++i) {
    x.push_back(*from_px + (to_px - *from_px) * i / 200);
    y.push_back(peak * std::exp(-0.5 * x.back() * x.back() / (*rms_px * *rms_px)));
  }
  plot.DrawCurve(x, y, {look.reference, 1.2});
  plot.DrawLegend({{translate("residuals"), Marker::kSquare, look.measured},
                   {translate("Gaussian of the same RMS"), Marker::kDot, look.reference, true}});
  return {};
}

Status DrawResidualScatter(const ReportContext& context, const PageBox& box) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<Residual> residuals, ReadResiduals(context.folder));
  if (residuals.empty()) {
    DrawNoData(context, box);
    return {};
  }
  double reach_px = 0;
  for (const Residual& residual : residuals)
    reach_px = std::max({reach_px, std::abs(residual.du_px), std::abs(residual.dv_px)});
  Plot plot(context.flow, box, {"Δu / px", -reach_px, reach_px}, {"Δv / px", -reach_px, reach_px});
  const Look& look = context.flow.look();
  constexpr double kDot_pt = 0.8;
  for (const Residual& residual : residuals) {
    const PagePoint at = plot.At(residual.du_px, residual.dv_px);
    context.flow.pdf().FillBox({at.x_pt - kDot_pt / 2, at.y_pt - kDot_pt / 2, kDot_pt, kDot_pt},
                               look.measured);
  }
  plot.DrawLegend({{context.layout.Say("corner residuals"), Marker::kDot, look.measured}});
  return {};
}

}  // namespace telestrain
