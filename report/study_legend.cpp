#include "report/study_legend.h"

#include <algorithm>
#include <array>

#include "report/text_wrap.h"

namespace telestrain {
namespace {

constexpr double kRow_pt = 11, kSample_pt = 24, kTextAt_pt = 29, kGap_pt = 16;

TextStyle LegendStyle(const Look& look) { return {Face::kRegular, 7.5, look.ink}; }

}  // namespace

SeriesLook LookOfSeries(std::size_t index) {
  // Dark and bright in turn, and apart for the colour-blind.
  static const std::array<SeriesLook, 6> kLooks = {{
      {ColorOf(0x1F5FA8), Marker::kDot, Dash::kSolid},
      {ColorOf(0xD55E00), Marker::kSquare, Dash::kDashed},
      {ColorOf(0x00735C), Marker::kDiamond, Dash::kLong},
      {ColorOf(0x8E3B8E), Marker::kCross, Dash::kDashDot},
      {ColorOf(0x202020), Marker::kTriangle, Dash::kDotted},
      {ColorOf(0xB58900), Marker::kPlus, Dash::kSolid},
  }};
  SeriesLook look = kLooks[index % kLooks.size()];
  const std::size_t round = index / kLooks.size();  // the same colour again: another marker
  look.marker = kLooks[(index + round) % kLooks.size()].marker;
  look.dash = kLooks[(index + 2 * round) % kLooks.size()].dash;
  return look;
}

Stroke StrokeOfLimit(const Look& look, std::size_t index) {
  const std::array<Stroke, 3> strokes = {{{look.fail, 1, Dash::kDashed},
                                          {look.doubt, 1, Dash::kDashDot},
                                          {look.muted, 1, Dash::kDotted}}};
  return strokes[index % strokes.size()];
}

PlotLegend::PlotLegend(PageFlow& flow, std::vector<LegendItem> items, double width_pt)
    : flow_(flow), items_(std::move(items)) {
  const TextStyle style = LegendStyle(flow.look());
  double x_pt = 0;
  int row = 0;
  for (const LegendItem& item : items_) {
    Placed placed;
    placed.lines = WrapText(flow.pdf(), style, item.text, width_pt - kTextAt_pt);
    double text_pt = 0;
    for (const std::string& line : placed.lines)
      text_pt = std::max(text_pt, flow.pdf().TextWidth_pt(style, line));
    if (x_pt > 0 && x_pt + kTextAt_pt + text_pt > width_pt) {
      x_pt = 0;
      row = rows_;
    }
    placed.x_pt = x_pt;
    placed.row = row;
    x_pt += kTextAt_pt + text_pt + kGap_pt;
    rows_ = std::max(rows_, row + static_cast<int>(placed.lines.size()));
    placed_.push_back(std::move(placed));
  }
}

double PlotLegend::height_pt() const { return kRow_pt * rows_; }

void PlotLegend::DrawSample(const LegendItem& item, PagePoint left) {
  PdfDocument& pdf = flow_.pdf();
  const PagePoint middle{left.x_pt + kSample_pt / 2, left.y_pt};
  const PageBox box{middle.x_pt - 7, middle.y_pt - 3, 14, 6};
  const Stroke stroke{item.look.color, 1.2, item.look.dash};
  switch (item.sample) {
    case LegendSample::kBox:
      pdf.FillBox(box, kBarFill);
      return pdf.StrokeBox(box, {item.look.color, 0.6});
    case LegendSample::kFrame:
      return pdf.DrawPolyline({{box.left_pt, box.bottom_pt},
                               {box.left_pt, box.top_pt()},
                               {box.right_pt(), box.top_pt()},
                               {box.right_pt(), box.bottom_pt}},
                              stroke);
    case LegendSample::kMarker:
      return DrawMarkerShape(pdf, middle, item.look.marker, item.look.color, 2.2);
    case LegendSample::kLine:
    case LegendSample::kLineWithMarker:
      pdf.DrawLine(left, {left.x_pt + kSample_pt, left.y_pt}, stroke);
      if (item.sample == LegendSample::kLineWithMarker)
        DrawMarkerShape(pdf, middle, item.look.marker, item.look.color, 2.2);
  }
}

void PlotLegend::Draw(PagePoint top_left) {
  const TextStyle style = LegendStyle(flow_.look());
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const Placed& placed = placed_[i];
    PagePoint at{top_left.x_pt + placed.x_pt, top_left.y_pt - kRow_pt * (placed.row + 0.5)};
    DrawSample(items_[i], at);
    at.x_pt += kTextAt_pt;
    at.y_pt -= 2.6;
    for (const std::string& line : placed.lines) {
      flow_.pdf().DrawText(style, at, line);
      at.y_pt -= kRow_pt;
    }
  }
}

}  // namespace telestrain
