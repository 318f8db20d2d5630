#include "report/error_plot.h"

#include <algorithm>
#include <cmath>

#include "report/report_charts.h"

namespace telestrain {
namespace {

constexpr double kBeyondErrors = 1.05;  // room above the largest error bar
constexpr double kBeyondLimit = 1.15;   // and above a limit, for its text
constexpr double kMostScale = 5;        // the limit may take this many times the errors' range

PlotAxis AxisOf(const std::vector<ErrorPoint>& points, const ErrorChart& chart,
                const std::string& label) {
  double low = points[0].x, high = points[0].x;
  for (const ErrorPoint& point : points) {
    low = std::min(low, point.x);
    high = std::max(high, point.x);
  }
  if (chart.numbered) return {label, low - 0.5, high + 0.5, true, false};
  const double margin = high > low ? 0.04 * (high - low) : 0.5;
  return {label, low - margin, high + margin, false, false};
}

void DrawLimits(const ReportContext& context, const ErrorChart& chart, const ErrorRange& range,
                Plot& plot) {
  if (!chart.limit) return;
  if (range.limit_is_inside) {
    plot.DrawLimit(*chart.limit, chart.limit_text);
    plot.DrawLimit(-*chart.limit, "");
    return;
  }
  const TextStyle style{Face::kRegular, 7.5, context.flow.look().fail};
  context.flow.pdf().DrawText(
      style, {plot.area().right_pt() - 4, plot.area().top_pt() - 9},
      chart.limit_text + " (" + context.layout.Say("outside this chart") + ")", Align::kRight);
}

}  // namespace

ErrorRange RangeOfErrors(const std::vector<ErrorPoint>& points, std::optional<double> limit) {
  ErrorRange range{0, false};
  for (const ErrorPoint& point : points)
    range.reach =
        std::max(range.reach, kBeyondErrors * (std::abs(point.error) + point.expanded_uncertainty));
  if (!(range.reach > 0)) range.reach = limit.value_or(1);
  if (!limit) return range;
  range.limit_is_inside = kBeyondLimit * *limit <= kMostScale * range.reach;
  // Room for the limit, or for the note that it is outside.
  range.reach = range.limit_is_inside ? std::max(range.reach, kBeyondLimit * *limit)
                                      : kBeyondLimit * range.reach;
  return range;
}

Status DrawErrorChart(const ReportContext& context, const PageBox& box,
                      const std::vector<ErrorPoint>& points, const ErrorChart& chart) {
  if (points.empty()) {
    DrawNoData(context, box);
    return {};
  }
  const ErrorRange range = RangeOfErrors(points, chart.limit);
  Plot plot(context.flow, box, AxisOf(points, chart, context.layout.Say(chart.x_label)),
            {context.layout.Say(chart.y_label), -range.reach, range.reach});
  plot.DrawCurve({plot.x_low(), plot.x_high()}, {0, 0}, {context.flow.look().muted, 0.7});
  DrawLimits(context, chart, range, plot);
  const double size_pt = chart.numbered ? 1.15 * plot.MarkerSize_pt() : 2;
  for (const ErrorPoint& point : points) {
    plot.DrawErrorBar(point.x, point.error, point.expanded_uncertainty, point.color, size_pt);
    plot.DrawMarker(point.x, point.error, point.marker, point.color, size_pt);
  }
  if (!chart.legend.empty()) plot.DrawLegend(chart.legend);
  return {};
}

}  // namespace telestrain
