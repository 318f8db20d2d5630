#include <algorithm>
#include <optional>

#include "report/plot.h"
#include "report/report_charts.h"

namespace telestrain {
namespace {

// Columns of the table "pinhole" as results_of_pinhole.cpp writes them.
constexpr const char *kDistance = "/1/value", *kCoefficients = "/2/value", *kRms = "/4/value",
                     *kRulerRmse = "/7/value";

struct Series {
  std::vector<double> distances_m, values;
};

// What a chart compares: without a distance the telecentric model, else one of the pinholes.
struct Comparison {
  std::optional<double> telecentric;
  Series plain, distorted;
};

Comparison ReadComparison(const ReportContext& context, const char* column) {
  Comparison comparison;
  for (const Json& row : ListAt(context.Table("pinhole"), "/rows")) {
    const auto distance_m = NumberAt(row, kDistance), value = NumberAt(row, column);
    if (!value || *value <= 0) continue;  // a logarithmic axis cannot show it
    if (!distance_m) {
      comparison.telecentric = value;
      continue;
    }
    if (*distance_m <= 0) continue;
    Series& series =
        NumberAt(row, kCoefficients).value_or(0) > 0 ? comparison.distorted : comparison.plain;
    series.distances_m.push_back(*distance_m);
    series.values.push_back(*value);
  }
  return comparison;
}

void Widen(const std::vector<double>& values, double& low, double& high) {
  for (const double value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
}

void DrawSeries(Plot& plot, const Series& series, Marker marker, const Stroke& stroke) {
  plot.DrawCurve(series.distances_m, series.values, stroke);
  for (std::size_t i = 0; i < series.values.size(); ++i)
    plot.DrawMarker(series.distances_m[i], series.values[i], marker, stroke.color);
}

Status DrawAgainstDistance(const ReportContext& context, const PageBox& box, const char* column,
                           const char* label) {
  const Comparison comparison = ReadComparison(context, column);
  std::vector<double> distances_m = comparison.plain.distances_m;
  std::vector<double> values = comparison.plain.values;
  distances_m.insert(distances_m.end(), comparison.distorted.distances_m.begin(),
                     comparison.distorted.distances_m.end());
  values.insert(values.end(), comparison.distorted.values.begin(),
                comparison.distorted.values.end());
  if (values.empty()) {
    DrawNoData(context, box);
    return {};
  }
  if (comparison.telecentric) values.push_back(*comparison.telecentric);
  double nearest_m = distances_m[0], farthest_m = nearest_m, low = values[0], high = low;
  Widen(distances_m, nearest_m, farthest_m);
  Widen(values, low, high);
  const auto translate = [&](const char* text) { return context.layout.Say(text); };
  constexpr double kRoom = 1.25;  // so that markers do not stand on the frame
  Plot plot(context.flow, box,
            {translate("Working distance D / m"), nearest_m / kRoom, farthest_m * kRoom, false,
             false, true},
            {translate(label), low / kRoom, high * kRoom, false, true, true});
  const Look& look = context.flow.look();
  if (comparison.telecentric)
    plot.DrawCurve({plot.x_low(), plot.x_high()},
                   {*comparison.telecentric, *comparison.telecentric},
                   {look.reference, 1.2, Dash::kLong});
  DrawSeries(plot, comparison.plain, Marker::kDot, {look.measured, 1});
  DrawSeries(plot, comparison.distorted, Marker::kSquare, {look.ink, 1, Dash::kDotted});
  plot.DrawLegend({{translate("pinhole"), Marker::kDot, look.measured},
                   {translate("5 coefficients"), Marker::kSquare, look.ink},
                   {translate("telecentric"), Marker::kDot, look.reference, true, Dash::kLong}});
  return {};
}

}  // namespace

Status DrawPinholeRms(const ReportContext& context, const PageBox& box) {
  return DrawAgainstDistance(context, box, kRms, "Reprojection RMS / px");
}

Status DrawPinholeRuler(const ReportContext& context, const PageBox& box) {
  return DrawAgainstDistance(context, box, kRulerRmse, "Ruler RMSE / µm");
}

}  // namespace telestrain
