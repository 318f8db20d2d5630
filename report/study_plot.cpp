#include "report/study_plot.h"

#include <algorithm>
#include <cmath>

#include "report/picture_block.h"
#include "report/study_legend.h"

namespace telestrain {
namespace {

constexpr double kLeastChart_pt = 170;
constexpr double kTitleRoom_pt = 20;  // what Plot leaves above its area
constexpr double kLegendGap_pt = 5, kChartGap_pt = 9;

bool HasBins(const StudySeries& series) {
  return series.kind == SeriesKind::kBars || series.kind == SeriesKind::kStep;
}

std::size_t FirstBars(const StudyPlot& plot) {
  const auto at = std::find_if(plot.series.begin(), plot.series.end(),
                               [](const StudySeries& s) { return s.kind == SeriesKind::kBars; });
  return static_cast<std::size_t>(at - plot.series.begin());
}

// Values on a linear or logarithmic axis at equal distances.
double Straighten(const StudyAxis& axis, double value) {
  return axis.logarithmic ? std::log10(value) : value;
}
double Bend(const StudyAxis& axis, double value) {
  return axis.logarithmic ? std::pow(10, value) : value;
}

// Ends of the bars: half-way between their middles, the outer ones as wide as their neighbours.
std::vector<double> BinEdges(const StudyAxis& axis, const std::vector<double>& middles) {
  std::vector<double> at;
  for (const double middle : middles) at.push_back(Straighten(axis, middle));
  const double first = at.size() > 1 ? at[1] - at[0] : 1;
  const double last = at.size() > 1 ? at[at.size() - 1] - at[at.size() - 2] : 1;
  std::vector<double> edges{Bend(axis, at.front() - first / 2)};
  for (std::size_t i = 1; i < at.size(); ++i) edges.push_back(Bend(axis, (at[i - 1] + at[i]) / 2));
  edges.push_back(Bend(axis, at.back() + last / 2));
  return edges;
}

// The smallest and the largest value that an axis must show.
class Range {
 public:
  explicit Range(const StudyAxis& axis) : axis_(axis) {}
  void Add(double value) {
    if (std::isnan(value) || (axis_.logarithmic && value <= 0)) return;
    low_ = is_empty_ ? value : std::min(low_, value);
    high_ = is_empty_ ? value : std::max(high_, value);
    is_empty_ = false;
  }
  // A little room, so that markers do not stand on the frame; not across zero.
  PlotAxis WithRoom(double share) {
    for (const auto& end : {axis_.low, axis_.high})
      if (end) Add(*end);
    PlotAxis axis{axis_.label};
    axis.logarithmic = axis_.logarithmic;
    if (is_empty_) low_ = axis_.logarithmic ? 1 : 0, high_ = axis_.logarithmic ? 10 : 1;
    const double room = share * (Straighten(axis_, high_) - Straighten(axis_, low_));
    axis.low = Bend(axis_, Straighten(axis_, low_) - room);
    axis.high = Bend(axis_, Straighten(axis_, high_) + room);
    if (!axis_.logarithmic && low_ >= 0) axis.low = std::max(0.0, axis.low);
    if (!axis_.logarithmic && high_ <= 0) axis.high = std::min(0.0, axis.high);
    if (axis_.low) axis.low = low_;
    if (axis_.high) axis.high = high_;
    // Ticks lie inside any longer logarithmic range; a shorter one needs whole steps to have some.
    constexpr double kLongRatio = 5;
    if (axis.logarithmic && axis.high > kLongRatio * axis.low) axis.widen = false;
    return axis;
  }

 private:
  const StudyAxis& axis_;
  double low_ = 0, high_ = 0;
  bool is_empty_ = true;
};

PlotAxis XAxis(const StudyPlot& plot) {
  Range range(plot.x);
  bool has_bins = false;
  for (const StudySeries& series : plot.series) {
    if (HasBins(series) && !series.x.empty()) {
      has_bins = true;
      for (const double edge : BinEdges(plot.x, series.x)) range.Add(edge);
    }
    for (const double x : series.x) range.Add(x);
  }
  PlotAxis axis = range.WithRoom(has_bins ? 0 : 0.02);
  if (!axis.logarithmic) axis.widen = false;  // the whole width for the values
  return axis;
}

PlotAxis YAxis(const StudyPlot& plot) {
  Range range(plot.y);
  for (const StudySeries& series : plot.series) {
    if (HasBins(series)) range.Add(0);
    for (std::size_t i = 0; i < series.y.size(); ++i) {
      range.Add(series.y[i]);
      if (series.half_height.empty()) continue;
      range.Add(series.y[i] - series.half_height[i]);
      range.Add(series.y[i] + series.half_height[i]);
    }
  }
  for (const StudyLimit& limit : plot.limits) range.Add(limit.y);
  return range.WithRoom(0.03);
}

// One plot under construction.
class StudyChart {
 public:
  StudyChart(PageFlow& flow, const StudyPlot& study, const PageBox& box)
      : pdf_(flow.pdf()),
        look_(flow.look()),
        study_(study),
        plot_(flow, box, XAxis(study), YAxis(study)) {}
  void Draw();

 private:
  void DrawBars(const StudySeries& series, const SeriesLook& look);
  void DrawStep(const StudySeries& series, const SeriesLook& look);
  void DrawLine(const StudySeries& series, const SeriesLook& look);
  void DrawMarkers(const StudySeries& series, const SeriesLook& look);
  void DrawLimits();

  PdfDocument& pdf_;
  const Look& look_;
  const StudyPlot& study_;
  Plot plot_;
};

void StudyChart::DrawBars(const StudySeries& series, const SeriesLook& look) {
  const std::vector<double> edges = BinEdges(study_.x, series.x);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (std::isnan(series.y[i])) continue;
    const PagePoint low = plot_.At(edges[i], plot_.Baseline());
    const PagePoint high = plot_.At(edges[i + 1], series.y[i]);
    const double gap_pt = std::min(1.5, 0.06 * (high.x_pt - low.x_pt));
    const PageBox box{low.x_pt + gap_pt, std::min(low.y_pt, high.y_pt),
                      high.x_pt - low.x_pt - 2 * gap_pt, std::abs(high.y_pt - low.y_pt)};
    pdf_.FillBox(box, kBarFill);
    pdf_.StrokeBox(box, {look.color, 0.6});
  }
}

void StudyChart::DrawStep(const StudySeries& series, const SeriesLook& look) {
  const std::vector<double> edges = BinEdges(study_.x, series.x);
  std::vector<double> x{edges.front()}, y{plot_.Baseline()};
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const double height = std::isnan(series.y[i]) ? plot_.Baseline() : series.y[i];
    x.insert(x.end(), {edges[i], edges[i + 1]});
    y.insert(y.end(), {height, height});
  }
  x.push_back(edges.back());
  y.push_back(plot_.Baseline());
  plot_.DrawCurve(x, y, {look.color, 1.2, look.dash});
}

void StudyChart::DrawLine(const StudySeries& series, const SeriesLook& look) {
  std::vector<double> x, y;
  const auto draw_piece = [&] {
    plot_.DrawCurve(x, y, {look.color, 1.2, look.dash});
    x.clear();
    y.clear();
  };
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (std::isnan(series.x[i]) || std::isnan(series.y[i])) {
      draw_piece();
      continue;
    }
    x.push_back(series.x[i]);
    y.push_back(series.y[i]);
  }
  draw_piece();
}

constexpr std::size_t kMostMarkersOnALine = 40;

void StudyChart::DrawMarkers(const StudySeries& series, const SeriesLook& look) {
  const std::size_t count = series.x.size();
  const double size_pt = count > 400 ? 0.9 : count > 100 ? 1.5 : 2.2;
  const bool has_markers = series.kind == SeriesKind::kMarkers ||
                           (series.kind == SeriesKind::kLine && count <= kMostMarkersOnALine);
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isnan(series.x[i]) || std::isnan(series.y[i])) continue;
    if (!series.half_height.empty() && !std::isnan(series.half_height[i]))
      plot_.DrawErrorBar(series.x[i], series.y[i], series.half_height[i], look.color, size_pt);
    if (has_markers) plot_.DrawMarker(series.x[i], series.y[i], look.marker, look.color, size_pt);
  }
}

void StudyChart::DrawLimits() {
  for (std::size_t i = 0; i < study_.limits.size(); ++i)
    plot_.DrawCurve({plot_.x_low(), plot_.x_high()}, {study_.limits[i].y, study_.limits[i].y},
                    StrokeOfLimit(look_, i));
}

// The first bars are filled and lie below everything; others are outlines over them.
void StudyChart::Draw() {
  const auto& all = study_.series;
  const std::size_t filled = FirstBars(study_);
  if (filled < all.size() && !all[filled].x.empty()) DrawBars(all[filled], LookOfSeries(filled));
  DrawLimits();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].x.empty()) continue;
    const SeriesLook look = LookOfSeries(i);
    if (all[i].kind == SeriesKind::kLine) DrawLine(all[i], look);
    if (HasBins(all[i]) && i != filled) DrawStep(all[i], look);
    DrawMarkers(all[i], look);
  }
}

LegendSample SampleOf(const StudySeries& series, bool is_filled) {
  switch (series.kind) {
    case SeriesKind::kBars:
      return is_filled ? LegendSample::kBox : LegendSample::kFrame;
    case SeriesKind::kStep:
      return LegendSample::kFrame;
    case SeriesKind::kMarkers:
      return LegendSample::kMarker;
    case SeriesKind::kLine:
      break;
  }
  return series.x.size() <= kMostMarkersOnALine ? LegendSample::kLineWithMarker
                                                : LegendSample::kLine;
}

std::vector<LegendItem> LegendItems(const StudyPlot& plot, const Look& look) {
  std::vector<LegendItem> items;
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    items.push_back(
        {plot.series[i].name, SampleOf(plot.series[i], i == FirstBars(plot)), LookOfSeries(i)});
  for (std::size_t i = 0; i < plot.limits.size(); ++i) {
    const Stroke stroke = StrokeOfLimit(look, i);
    items.push_back(
        {plot.limits[i].text, LegendSample::kLine, {stroke.color, Marker::kDot, stroke.dash}});
  }
  return items;
}

// What the plot shows, in words.
std::string Words(const StudyPlot& plot) {
  std::string words = "Plot of " + plot.y.label + " over " + plot.x.label + ": " + plot.title + ".";
  for (const StudySeries& series : plot.series) words += " " + series.name + ";";
  for (const StudyLimit& limit : plot.limits) words += " " + limit.text + ";";
  if (words.back() == ';') words.back() = '.';
  return words;
}

void DrawFigure(PageFlow& flow, const StudyPlot& plot, PlotLegend& legend, double legend_pt,
                double chart_pt) {
  const double height_pt = legend_pt + chart_pt;
  const PageBox box{flow.left_pt(), flow.y_pt() - height_pt, flow.width_pt(), height_pt};
  const ScopedTag figure(flow.pdf(), PdfTag{"Figure", Words(plot), "", box});
  legend.Draw({flow.left_pt(), flow.y_pt()});
  StudyChart(flow, plot, {box.left_pt, box.bottom_pt, box.width_pt, chart_pt}).Draw();
  flow.Advance(height_pt);
}

}  // namespace

void DrawStudyPlot(PageFlow& flow, const StudyPlot& plot, double height_pt) {
  const TextStyle title{Face::kBold, 9.5, flow.look().ink};
  PlotLegend legend(flow, LegendItems(plot, flow.look()), flow.width_pt());
  const double above_pt = flow.TextHeight_pt(title, flow.width_pt(), plot.title) + kLegendGap_pt;
  const double legend_pt = legend.height_pt() + kChartGap_pt - kTitleRoom_pt;
  const double below_pt = CaptionHeight_pt(flow, plot.caption);
  const double chart_pt = std::max(kLeastChart_pt, height_pt - above_pt - legend_pt - below_pt);
  flow.Require(above_pt + legend_pt + chart_pt + below_pt);
  flow.Paragraph(title, plot.title, {"H3"});
  flow.Advance(kLegendGap_pt);
  DrawFigure(flow, plot, legend, legend_pt, chart_pt);
  DrawCaption(flow, plot.caption);
}

}  // namespace telestrain
