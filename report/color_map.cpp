#include "report/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace telestrain {
namespace {

constexpr double kBar_pt = 9, kTickType_pt = 7;
constexpr double kTicks = 6;  // at most, about
constexpr int kSteps = 96;
constexpr double kOverlap_pt = 0.2;  // of neighbours, so that viewers draw no seams

// viridis at 0, 0.1, ... 1.
constexpr std::array<unsigned, 11> kViridis{0x440154, 0x482475, 0x414487, 0x355F8D,
                                            0x2A788E, 0x21918C, 0x22A884, 0x44BF70,
                                            0x7AD151, 0xBDDF26, 0xFDE725};

}  // namespace

Color MapColor(double share) {
  constexpr int kLast = static_cast<int>(kViridis.size()) - 1;
  const double at = std::clamp(share, 0.0, 1.0) * kLast;
  const int below = std::min(static_cast<int>(at), kLast - 1);
  const Color a = ColorOf(kViridis[static_cast<std::size_t>(below)]);
  const Color b = ColorOf(kViridis[static_cast<std::size_t>(below) + 1]);
  const double t = at - below;
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green),
          a.blue + t * (b.blue - a.blue)};
}

ColorScale::ColorScale(const PlotAxis& axis) : label_(axis.label), scale_(axis, kTicks, 1) {}

void DrawColorBar(PageFlow& flow, const PageBox& box, const ColorScale& colors) {
  PdfDocument& pdf = flow.pdf();
  const PlotScale& scale = colors.scale();
  const double step_pt = box.height_pt / kSteps;
  const PageBox bar{box.left_pt, box.bottom_pt, kBar_pt, box.height_pt};
  pdf.BeginClip(bar);
  for (int i = 0; i < kSteps; ++i)
    pdf.FillBox({bar.left_pt, bar.bottom_pt + i * step_pt, kBar_pt, step_pt + kOverlap_pt},
                MapColor((i + 0.5) / kSteps));
  pdf.EndClip();
  const Stroke frame{ColorOf(0x404040), 0.6};
  pdf.StrokeBox(bar, frame);
  const TextStyle ticks{Face::kRegular, kTickType_pt, flow.look().ink};
  for (const PlotScale::Tick& tick : scale.Ticks()) {
    const double y_pt = bar.bottom_pt + bar.height_pt * scale.Share(tick.value);
    pdf.DrawLine({bar.right_pt(), y_pt}, {bar.right_pt() + 2.5, y_pt}, frame);
    pdf.DrawText(ticks, {bar.right_pt() + 4, y_pt - 2.4}, tick.label);
  }
  TextStyle label{Face::kRegular, 7.5, flow.look().ink};
  while (label.size_pt > 5.5 && pdf.TextWidth_pt(label, colors.label()) > box.height_pt)
    label.size_pt -= 0.25;
  pdf.DrawText(label, {box.left_pt + kColorBarWidth_pt - 1, box.bottom_pt + box.height_pt / 2},
               colors.label(), Align::kCenter, 90);
}

}  // namespace telestrain
