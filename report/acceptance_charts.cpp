#include <algorithm>
#include <cmath>

#include "report/plot.h"
#include "report/report_charts.h"

namespace telestrain {
namespace {

struct ErrorPoint {
  double x = 0, error = 0, expanded_uncertainty = 0;
  bool second = false;  // drawn as the second series
};

struct ErrorChart {
  std::string x_label, y_label;
  std::vector<Plot::LegendEntry> legend;
};

// Errors over a coordinate with their uncertainties, about a zero line.
Status DrawErrors(const ReportContext& context, const PageBox& box,
                  const std::vector<ErrorPoint>& points, const ErrorChart& chart) {
  if (points.empty()) {
    DrawNoData(context, box);
    return {};
  }
  double low = points[0].x, high = points[0].x, reach = 0;
  for (const ErrorPoint& p : points) {
    low = std::min(low, p.x);
    high = std::max(high, p.x);
    reach = std::max(reach, 1.05 * (std::abs(p.error) + p.expanded_uncertainty));
  }
  const double margin = high > low ? 0.04 * (high - low) : 0.5;
  const auto translate = [&](const std::string& text) { return context.layout.Say(text); };
  Plot plot(context.flow, box,
            {translate(chart.x_label), low - margin, high + margin, false, false},
            {translate(chart.y_label), -reach, reach});
  const Look& look = context.flow.look();
  plot.DrawCurve({plot.x_low(), plot.x_high()}, {0, 0}, {look.muted, 0.7});
  for (const ErrorPoint& p : points) {
    const Color color = p.second ? look.reference : look.measured;
    plot.DrawErrorBar(p.x, p.error, p.expanded_uncertainty, color, 1.2);
    plot.DrawMarker(p.x, p.error, p.second ? Marker::kSquare : Marker::kDot, color, 1.6);
  }
  if (!chart.legend.empty()) plot.DrawLegend(chart.legend);
  return {};
}

// Columns of the table "ruler" as MakeResults writes them.
std::vector<ErrorPoint> RulerPoints(const ReportContext& context, const char* coordinate) {
  std::vector<ErrorPoint> points;
  for (const Json& row : ListAt(context.Table("ruler"), "/rows")) {
    const auto error = NumberAt(row, "/2/value"), at = NumberAt(row, coordinate);
    if (error && at) points.push_back({*at, *error, NumberAt(row, "/3/value").value_or(0), false});
  }
  return points;
}

}  // namespace

Status DrawRulerPositions(const ReportContext& context, const PageBox& box) {
  return DrawErrors(context, box, RulerPoints(context, "/5/value"),
                    {"Middle of the ruler, x / mm", "E / µm", {}});
}

Status DrawRulerDepths(const ReportContext& context, const PageBox& box) {
  return DrawErrors(context, box, RulerPoints(context, "/7/value"),
                    {"Depth of the middle / mm", "E / µm", {}});
}

// Camera minus gauges over the gauges' change; the unloading states of every cycle apart.
Status DrawStrainHysteresis(const ReportContext& context, const PageBox& box) {
  std::vector<ErrorPoint> points;
  std::string cycle;
  double peak = 0;
  bool unloading = false;
  double before = 0;
  for (const Json& row : ListAt(context.Table("strain-states"), "/rows")) {
    const auto gauges = NumberAt(row, "/9/value"), error = NumberAt(row, "/10/value");
    if (!gauges || !error) continue;
    const std::string of = row.size() > 1 && row[1].is_string() ? row[1].get<std::string>() : "";
    if (of != cycle) unloading = false, peak = 0;
    cycle = of;
    peak = std::max(peak, std::abs(*gauges));
    // From the first state on that falls back by a tenth of what the cycle reached.
    unloading = unloading || (peak > 0 && std::abs(*gauges) < std::abs(before) - 0.1 * peak);
    before = *gauges;
    points.push_back({*gauges, *error, NumberAt(row, "/8/value").value_or(0), unloading});
  }
  const Look& look = context.flow.look();
  return DrawErrors(context, box, points,
                    {"Gauges, change / µε",
                     "Camera - gauges / µε",
                     {{context.layout.Say("loading"), Marker::kDot, look.measured},
                      {context.layout.Say("unloading"), Marker::kSquare, look.reference}}});
}

}  // namespace telestrain
