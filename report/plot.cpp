#include "report/plot.h"

#include <algorithm>
#include <cmath>

#include "report/text_wrap.h"

namespace telestrain {
namespace {

constexpr double kTickType_pt = 7.5, kLabelType_pt = 8, kTitleType_pt = 8.5;
constexpr double kTickSpacingX_pt = 38, kTickSpacingY_pt = 24;  // about; labels stay apart
constexpr double kTop_pt = 20;                                  // room for the title or the legend

// A text in the middle of `room_pt`: it shrinks a little, then takes a second line, then shrinks to
// 6 pt; what still does not fit is cut. `up`: one point from the second line to the first.
void DrawFitted(PdfDocument& pdf, TextStyle style, PagePoint middle, PagePoint up,
                const std::string& text, double room_pt, double rotation_deg = 0) {
  constexpr double kOneLine_pt = 7, kSmallest_pt = 6, kStep_pt = 0.25, kLine_pt = 7.6;
  while (style.size_pt > kOneLine_pt && pdf.TextWidth_pt(style, text) > room_pt)
    style.size_pt -= kStep_pt;
  std::vector<std::string> lines = WrapText(pdf, style, text, room_pt);
  for (; lines.size() > 2 && style.size_pt > kSmallest_pt; style.size_pt -= kStep_pt)
    lines = WrapText(pdf, style, text, room_pt);
  for (std::size_t i = 2; i < lines.size(); ++i) lines[1] += lines[i];
  lines.resize(std::min<std::size_t>(lines.size(), 2));
  double shift_pt = lines.size() == 2 ? kLine_pt / 2 : 0;
  for (const std::string& line : lines) {
    pdf.DrawText(style, {middle.x_pt + shift_pt * up.x_pt, middle.y_pt + shift_pt * up.y_pt},
                 ShortenedText(pdf, style, line, room_pt), Align::kCenter, rotation_deg);
    shift_pt -= kLine_pt;
  }
}

}  // namespace

void DrawMarkerShape(PdfDocument& pdf, PagePoint p, Marker marker, Color color, double s) {
  switch (marker) {
    case Marker::kDot:
      return pdf.FillCircle(p, s, color);
    case Marker::kSquare:
      return pdf.StrokeBox({p.x_pt - s, p.y_pt - s, 2 * s, 2 * s}, {color, 0.9});
    case Marker::kDiamond:
      return pdf.FillPolygon({{p.x_pt - 1.3 * s, p.y_pt},
                              {p.x_pt, p.y_pt - 1.3 * s},
                              {p.x_pt + 1.3 * s, p.y_pt},
                              {p.x_pt, p.y_pt + 1.3 * s}},
                             color);
    case Marker::kTriangle:
      return pdf.FillPolygon({{p.x_pt - 1.2 * s, p.y_pt - 0.9 * s},
                              {p.x_pt + 1.2 * s, p.y_pt - 0.9 * s},
                              {p.x_pt, p.y_pt + 1.3 * s}},
                             color);
    case Marker::kPlus:
      pdf.DrawLine({p.x_pt - 1.2 * s, p.y_pt}, {p.x_pt + 1.2 * s, p.y_pt}, {color, 1.3});
      pdf.DrawLine({p.x_pt, p.y_pt - 1.2 * s}, {p.x_pt, p.y_pt + 1.2 * s}, {color, 1.3});
      return;
    case Marker::kCross:
      pdf.DrawLine({p.x_pt - s, p.y_pt - s}, {p.x_pt + s, p.y_pt + s}, {color, 1.3});
      pdf.DrawLine({p.x_pt - s, p.y_pt + s}, {p.x_pt + s, p.y_pt - s}, {color, 1.3});
  }
}

Plot::Plot(PageFlow& flow, const PageBox& outer, const PlotAxis& x, const PlotAxis& y,
           const std::string& title)
    : flow_(flow), pdf_(flow.pdf()), outer_(outer) {
  const TextStyle ticks{Face::kRegular, kTickType_pt, flow.look().ink};
  y_ = PlotScale(y, outer.height_pt - kTop_pt - 30, kTickSpacingY_pt);
  double tick_pt = 0;
  for (const PlotScale::Tick& tick : y_.Ticks())
    tick_pt = std::max(tick_pt, pdf_.TextWidth_pt(ticks, tick.label));
  const double left_pt = tick_pt + (y.label.empty() ? 8 : 21);
  area_ = {outer.left_pt + left_pt, outer.bottom_pt + 30, outer.width_pt - left_pt - 10,
           outer.height_pt - 30 - kTop_pt};
  x_ = PlotScale(x, area_.width_pt, x.spacing_pt > 0 ? x.spacing_pt : kTickSpacingX_pt);
  DrawGrid(x, y);
  if (title.empty()) return;
  const TextStyle style{Face::kBold, kTitleType_pt, flow.look().ink};
  pdf_.DrawText(style, {area_.left_pt, area_.top_pt() + 6}, title);
}

PagePoint Plot::At(double x, double y) const {
  return {area_.left_pt + area_.width_pt * x_.Share(x),
          area_.bottom_pt + area_.height_pt * y_.Share(y)};
}

void Plot::DrawGrid(const PlotAxis& x, const PlotAxis& y) {
  const Look& look = flow_.look();
  const TextStyle tick_style{Face::kRegular, kTickType_pt, look.ink};
  const TextStyle label_style{Face::kRegular, kLabelType_pt, look.ink};
  const Stroke grid{look.line, 0.4}, frame{ColorOf(0x404040), 0.7};
  const Stroke minor{look.zebra, 0.4};
  for (const PlotScale::Tick& tick : x_.Ticks()) {
    const PagePoint p{area_.left_pt + area_.width_pt * x_.Share(tick.value), area_.bottom_pt};
    pdf_.DrawLine(p, {p.x_pt, area_.top_pt()}, tick.label.empty() ? minor : grid);
    pdf_.DrawLine(p, {p.x_pt, p.y_pt - (tick.label.empty() ? 1.5 : 3)}, frame);
    pdf_.DrawText(tick_style, {p.x_pt, p.y_pt - 11}, tick.label, Align::kCenter);
  }
  for (const PlotScale::Tick& tick : y_.Ticks()) {
    const PagePoint p{area_.left_pt, area_.bottom_pt + area_.height_pt * y_.Share(tick.value)};
    pdf_.DrawLine(p, {area_.right_pt(), p.y_pt}, tick.label.empty() ? minor : grid);
    pdf_.DrawLine(p, {p.x_pt - (tick.label.empty() ? 1.5 : 3), p.y_pt}, frame);
    pdf_.DrawText(tick_style, {p.x_pt - 5, p.y_pt - 2.6}, tick.label, Align::kRight);
  }
  pdf_.StrokeBox(area_, frame);
  DrawFitted(pdf_, label_style, {area_.left_pt + area_.width_pt / 2, area_.bottom_pt - 24}, {0, 1},
             x.label, area_.width_pt);
  if (!y.label.empty())
    DrawFitted(pdf_, label_style, {outer_.left_pt + 9, area_.bottom_pt + area_.height_pt / 2},
               {-1, 0}, y.label, area_.height_pt, 90);
}

void Plot::DrawMarker(double x, double y, Marker marker, Color color, double size_pt) {
  DrawMarkerShape(pdf_, At(x, y), marker, color, size_pt);
}

double Plot::MarkerSize_pt() const {
  return std::clamp(0.35 * area_.width_pt / (x_.high() - x_.low()), 0.6, 2.0);
}

void Plot::DrawErrorBar(double x, double y, double half_height, Color color, double cap_pt) {
  const double foot = y_.logarithmic() ? std::max(y - half_height, y_.low()) : y - half_height;
  const PagePoint low = At(x, foot), high = At(x, y + half_height);
  pdf_.DrawLine(low, high, {color, 0.9});
  for (const PagePoint& end : {low, high})
    pdf_.DrawLine({end.x_pt - cap_pt, end.y_pt}, {end.x_pt + cap_pt, end.y_pt}, {color, 0.9});
}

void Plot::DrawCurve(const std::vector<double>& x, const std::vector<double>& y,
                     const Stroke& stroke) {
  std::vector<PagePoint> points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back(At(x[i], y[i]));
  pdf_.BeginClip(area_);
  pdf_.DrawPolyline(points, stroke);
  pdf_.EndClip();
}

void Plot::DrawLimit(double y, const std::string& text) {
  const Color color = flow_.look().fail;
  const PagePoint left = At(x_.low(), y);
  pdf_.DrawLine(left, {area_.right_pt(), left.y_pt}, {color, 1, Dash::kDashed});
  const TextStyle style{Face::kRegular, kTickType_pt, color};
  pdf_.DrawText(style, {area_.right_pt() - 4, left.y_pt + 3}, text, Align::kRight);
}

void Plot::DrawBar(double x_low, double x_high, double y, Color color) {
  const PagePoint low = At(x_low, Baseline()), high = At(x_high, y);
  pdf_.FillBox({low.x_pt, low.y_pt, high.x_pt - low.x_pt, high.y_pt - low.y_pt}, color);
}

void Plot::DrawLegend(const std::vector<LegendEntry>& entries) {
  constexpr double kMark_pt = 18, kGap_pt = 14, kEdge_pt = 4, kSmallest_pt = 6;
  TextStyle style{Face::kRegular, kTickType_pt, flow_.look().ink};
  const double first_pt = area_.left_pt + kEdge_pt, right_pt = outer_.right_pt();
  const auto width_pt = [&](const LegendEntry& entry) {
    return kMark_pt + pdf_.TextWidth_pt(style, entry.text);
  };
  const auto rows = [&] {
    int count = 1;
    double x_pt = first_pt;
    for (const LegendEntry& entry : entries) {
      if (x_pt > first_pt && x_pt + width_pt(entry) > right_pt) ++count, x_pt = first_pt;
      x_pt += width_pt(entry) + kGap_pt;
    }
    return count;
  };
  while (rows() > 2 && style.size_pt > kSmallest_pt) style.size_pt -= 0.25;
  double x_pt = first_pt, y_pt = area_.top_pt() + (rows() > 1 ? 14.5 : 9);
  for (const LegendEntry& entry : entries) {
    if (x_pt > first_pt && x_pt + width_pt(entry) > right_pt) x_pt = first_pt, y_pt -= 9;
    if (entry.line)
      pdf_.DrawLine({x_pt, y_pt}, {x_pt + 14, y_pt}, {entry.color, 1.2, entry.dash});
    else
      DrawMarkerShape(pdf_, {x_pt + 7, y_pt}, entry.marker, entry.color, 2.2);
    pdf_.DrawText(style, {x_pt + kMark_pt, y_pt - 2.6}, entry.text);
    x_pt += width_pt(entry) + kGap_pt;
  }
}

}  // namespace telestrain
