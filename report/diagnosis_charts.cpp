#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/chart_files.h"
#include "report/plot.h"
#include "report/report_charts.h"

namespace telestrain {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kBand_sigma = 3;       // of a sector's count, around the expected one
constexpr double kTickSpacing_pt = 26;  // these charts are narrow
constexpr double kLeastCount = 0.25;    // drawn on logarithmic counts
const Color kBars = ColorOf(0xA9C2DE);

std::vector<double> NumbersOf(const Json& list) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < list.size(); ++i)
    numbers.push_back(NumberAt(list, "/" + std::to_string(i)).value_or(0));
  return numbers;
}

double LargestOf(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

void DrawBars(Plot& plot, double from_px, double bin_px, const std::vector<double>& counts) {
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double left_px = from_px + bin_px * static_cast<double>(i);
    if (counts[i] > 0) plot.DrawBar(left_px, left_px + 0.92 * bin_px, counts[i], kBars);
  }
}

// A rose: the area from the middle to a circle, between two directions.
class Rose {
 public:
  Rose(PdfDocument& pdf, PagePoint center, double points_per_count)
      : pdf_(pdf), center_(center), points_per_count_(points_per_count) {}
  // Directions as on the image: v points downwards.
  PagePoint At(double direction_rad, double count) const {
    const double radius_pt = points_per_count_ * count;
    return {center_.x_pt + radius_pt * std::cos(direction_rad),
            center_.y_pt - radius_pt * std::sin(direction_rad)};
  }
  void FillSector(double from_rad, double to_rad, double count, Color color) {
    constexpr int kChords = 4;
    std::vector<PagePoint> points{center_};
    for (int i = 0; i <= kChords; ++i)
      points.push_back(At(from_rad + (to_rad - from_rad) * i / kChords, count));
    pdf_.FillPolygon(points, color);
  }
  void DrawCircle(double count, const Stroke& stroke) {
    constexpr int kChords = 120;
    std::vector<PagePoint> points;
    for (int i = 0; i <= kChords; ++i) points.push_back(At(2 * kPi * i / kChords, count));
    pdf_.DrawPolyline(points, stroke);
  }

 private:
  PdfDocument& pdf_;
  PagePoint center_;
  double points_per_count_;
};

// A legend in a row at the top of a box without axes.
void DrawRoseLegend(const ReportContext& context, const PageBox& box) {
  PdfDocument& pdf = context.flow.pdf();
  const Look& look = context.flow.look();
  const TextStyle style{Face::kRegular, 7.5, look.ink};
  const double y_pt = box.top_pt() - 11;
  double x_pt = box.left_pt + 4;
  const auto add = [&](const char* text, const Stroke* line) {
    if (line)
      pdf.DrawLine({x_pt, y_pt}, {x_pt + 12, y_pt}, *line);
    else
      pdf.FillBox({x_pt + 3, y_pt - 3, 6, 6}, kBars);
    const std::string translated = context.layout.Say(text);
    pdf.DrawText(style, {x_pt + 15, y_pt - 2.6}, translated);
    x_pt += 15 + pdf.TextWidth_pt(style, translated) + 8;
  };
  const Stroke expected{look.reference, 1.2}, band{look.reference, 0.8, Dash::kDashed};
  add("corners", nullptr);
  add("expected", &expected);
  add("± 3 σ", &band);
}

void DrawRoseAxes(const ReportContext& context, const Rose& rose, double reach) {
  PdfDocument& pdf = context.flow.pdf();
  const Look& look = context.flow.look();
  const TextStyle style{Face::kRegular, 7.5, look.ink};
  for (int i = 0; i < 4; ++i)
    pdf.DrawLine(rose.At(i * kPi / 2, 0), rose.At(i * kPi / 2, reach), {look.line, 0.5});
  const PagePoint right = rose.At(0, reach), below = rose.At(kPi / 2, reach);
  pdf.DrawText(style, {right.x_pt + 3, right.y_pt - 2.6}, "+u");
  pdf.DrawText(style, {below.x_pt, below.y_pt - 8}, "+v", Align::kCenter);
}

// Corners of a length between x and x + dx when both coordinates are normal: Rayleigh's density.
double Rayleigh(double length_px, double sigma_px) {
  const double t = length_px / sigma_px;
  return t / sigma_px * std::exp(-0.5 * t * t);
}

}  // namespace

Status DrawDiagnosisHistogram(const ReportContext& context, const PageBox& box) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json diagnosis, ReadDiagnosis(context.folder));
  const Json& histogram = EntryAt(diagnosis, "/residuals/histogram");
  const auto bin_px = NumberAt(histogram, "/bin_px");
  const auto first_px = NumberAt(histogram, "/first_center_px");
  const std::vector<double> counts = NumbersOf(ListAt(histogram, "/counts"));
  const std::vector<double> gaussian = NumbersOf(ListAt(histogram, "/gaussian"));
  if (counts.empty() || gaussian.size() != counts.size() || !bin_px || !first_px || *bin_px <= 0) {
    DrawNoData(context, box);
    return {};
  }
  const auto center_px = [&](std::size_t i) {
    return *first_px + *bin_px * static_cast<double>(i);
  };
  const auto translate = [&](const char* text) { return context.layout.Say(text); };
  // One count stands well above the foot of the logarithmic axis.
  const PlotAxis y{
      translate("Count"), 0.5, 1.5 * std::max(1.0, LargestOf(counts)), false, false, true};
  const double reach_px =
      std::max(std::abs(center_px(0)), std::abs(center_px(counts.size() - 1))) + *bin_px;
  const PlotAxis x{translate("Residual of one coordinate / px"),
                   -reach_px,
                   reach_px,
                   false,
                   false,
                   false,
                   kTickSpacing_pt};
  Plot plot(context.flow, box, x, y);
  const Look& look = context.flow.look();
  DrawBars(plot, center_px(0) - *bin_px / 2, *bin_px, counts);
  std::vector<double> curve_x, curve_y;
  for (std::size_t i = 0; i < gaussian.size(); ++i) {
    curve_x.push_back(center_px(i));
    curve_y.push_back(std::max(gaussian[i], kLeastCount));  // the axis has no zero
  }
  plot.DrawCurve(curve_x, curve_y, {look.reference, 1.2});
  plot.DrawLegend({{translate("residuals"), Marker::kSquare, look.measured},
                   {translate("Gaussian"), Marker::kDot, look.reference, true}});
  return {};
}

Status DrawDiagnosisLengths(const ReportContext& context, const PageBox& box) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json diagnosis, ReadDiagnosis(context.folder));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::vector<Residual> residuals, ReadResiduals(context.folder));
  const auto bin_px = NumberAt(diagnosis, "/residuals/histogram/bin_px");
  const auto sigma_px = NumberAt(diagnosis, "/residuals/rms_px");
  if (residuals.empty() || !bin_px || !sigma_px || *bin_px <= 0 || *sigma_px <= 0) {
    DrawNoData(context, box);
    return {};
  }
  double longest_px = 0;
  for (const Residual& r : residuals)
    longest_px = std::max(longest_px, std::hypot(r.du_px, r.dv_px));
  // A single far corner must not ask for millions of bins.
  const double width_px = std::max(*bin_px, longest_px / 100);
  std::vector<double> counts(static_cast<std::size_t>(longest_px / width_px) + 1);
  for (const Residual& r : residuals)
    ++counts[static_cast<std::size_t>(std::hypot(r.du_px, r.dv_px) / width_px)];
  const double scale = static_cast<double>(residuals.size()) * width_px;
  const double peak = scale * Rayleigh(*sigma_px, *sigma_px);
  const auto translate = [&](const char* text) { return context.layout.Say(text); };
  const double reach_px = width_px * static_cast<double>(counts.size());
  Plot plot(context.flow, box,
            {translate("Length of a corner's residual / px"), 0, reach_px, false, false, false,
             kTickSpacing_pt},
            {translate("Count"), 0, 1.05 * std::max(LargestOf(counts), peak), true});
  std::vector<double> x, y;
  DrawBars(plot, 0, width_px, counts);
  for (int i = 0; i <= 200; ++i) {
    x.push_back(reach_px * i / 200);
    y.push_back(scale * Rayleigh(x.back(), *sigma_px));
  }
  const Look& look = context.flow.look();
  plot.DrawCurve(x, y, {look.reference, 1.2});
  plot.DrawLegend({{translate("corners"), Marker::kSquare, look.measured},
                   {translate("Rayleigh"), Marker::kDot, look.reference, true}});
  return {};
}

Status DrawDiagnosisDirections(const ReportContext& context, const PageBox& box) {
  TELESTRAIN_ASSIGN_OR_RETURN(const Json diagnosis, ReadDiagnosis(context.folder));
  const Json& directions = EntryAt(diagnosis, "/residuals/directions");
  const std::vector<double> counts = NumbersOf(ListAt(directions, "/counts"));
  double total = 0;
  for (const double count : counts) total += count;
  if (counts.empty() || total <= 0) {
    DrawNoData(context, box);
    return {};
  }
  const double sectors = static_cast<double>(counts.size());
  const double expected = total / sectors, band = kBand_sigma * std::sqrt(expected);
  const double reach = 1.04 * std::max(LargestOf(counts), expected + band);
  const double radius_pt = std::min(box.width_pt / 2 - 14, (box.height_pt - 20 - 12) / 2 - 4);
  Rose rose(context.flow.pdf(), {box.left_pt + box.width_pt / 2, box.top_pt() - 20 - 4 - radius_pt},
            radius_pt / reach);
  const Look& look = context.flow.look();
  rose.DrawCircle(reach, {look.line, 0.6});
  DrawRoseAxes(context, rose, reach);
  const double from_rad = NumberAt(directions, "/from_deg").value_or(-180) * kPi / 180;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double left_rad = from_rad + 2 * kPi * static_cast<double>(i) / sectors;
    rose.FillSector(left_rad, left_rad + 0.92 * 2 * kPi / sectors, counts[i], kBars);
  }
  rose.DrawCircle(expected, {look.reference, 1.2});
  for (const double circle : {expected - band, expected + band})
    if (circle > 0) rose.DrawCircle(circle, {look.reference, 0.8, Dash::kDashed});
  DrawRoseLegend(context, box);
  return {};
}

}  // namespace telestrain
