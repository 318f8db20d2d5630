#include <algorithm>

#include "report/error_plot.h"
#include "report/report_charts.h"

namespace telestrain {
namespace {

// Columns of the table "ruler" as MakeResults writes them.
constexpr const char *kError = "/2/value", *kU = "/3/value", *kVerdict = "/4/verdict",
                     *kPosition = "/5/value", *kDepth = "/7/value";

Marker MarkerOf(const std::string& verdict) {
  if (verdict == "doubt") return Marker::kDiamond;
  return verdict == "fail" ? Marker::kCross : Marker::kDot;
}

bool IsDecided(const std::string& verdict) {
  return verdict == "pass" || verdict == "doubt" || verdict == "fail";
}

Color ColorOfVerdict(const Look& look, const std::string& verdict) {
  return IsDecided(verdict) ? look.OfVerdict(verdict) : look.measured;
}

// E of every ruler image over `coordinate` of its row, or over the row itself.
std::vector<ErrorPoint> RulerPoints(const ReportContext& context, const char* coordinate) {
  std::vector<ErrorPoint> points;
  double row_number = 0;
  for (const Json& row : ListAt(context.Table("ruler"), "/rows")) {
    const auto error = NumberAt(row, kError);
    if (!error) continue;
    row_number += 1;
    const auto at = coordinate ? NumberAt(row, coordinate) : row_number;
    const std::string verdict = TextAt(row, kVerdict);
    if (at)
      points.push_back({*at, *error, NumberAt(row, kU).value_or(0), MarkerOf(verdict),
                        ColorOfVerdict(context.flow.look(), verdict)});
  }
  return points;
}

ErrorChart RulerChart(const ReportContext& context, const char* x_label) {
  ErrorChart chart;
  chart.x_label = x_label;
  chart.y_label = "E / µm";
  const Json& quantity = FindBy(ListAt(context.results, "/quantities"), "id", "ruler_error");
  chart.limit = NumberAt(quantity, "/limit");
  chart.limit_text = "MPE " + TextAt(quantity, "/printed_limit") + " µm";
  return chart;
}

// The verdicts that occur.
std::vector<Plot::LegendEntry> VerdictLegend(const ReportContext& context) {
  const Look& look = context.flow.look();
  std::vector<Plot::LegendEntry> legend;
  for (const char* verdict : {"pass", "doubt", "fail"})
    for (const Json& row : ListAt(context.Table("ruler"), "/rows"))
      if (TextAt(row, kVerdict) == verdict) {
        legend.push_back(
            {"E ± U, " + context.layout.Say(verdict), MarkerOf(verdict), look.OfVerdict(verdict)});
        break;
      }
  if (legend.empty()) legend.push_back({"E ± U", Marker::kDot, look.measured});
  return legend;
}

}  // namespace

Status DrawRulerErrors(const ReportContext& context, const PageBox& box) {
  ErrorChart chart = RulerChart(context, "Ruler image, row of the table");
  chart.numbered = true;
  chart.legend = VerdictLegend(context);
  return DrawErrorChart(context, box, RulerPoints(context, nullptr), chart);
}

Status DrawRulerPositions(const ReportContext& context, const PageBox& box) {
  return DrawErrorChart(context, box, RulerPoints(context, kPosition),
                        RulerChart(context, "Middle of the ruler, x / mm"));
}

Status DrawRulerDepths(const ReportContext& context, const PageBox& box) {
  return DrawErrorChart(context, box, RulerPoints(context, kDepth),
                        RulerChart(context, "Depth of the middle / mm"));
}

}  // namespace telestrain
