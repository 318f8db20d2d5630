#include "viz/color_bar.h"

#include <algorithm>
#include <cmath>

namespace telestrain::viz {
namespace {

// Every how many ticks a number fits without touching the next one.
std::size_t LabelStride(const Canvas& canvas, const ColorScale& scale, const TextStyle& style,
                        double width_px) {
  double widest_px = 0;
  for (const double tick : scale.ticks)
    widest_px = std::max(widest_px, canvas.TextSize(NumberText(tick, scale.decimals), style).x());
  std::size_t every = 1;
  const double gap_px = canvas.Px(4);
  const double step_px = width_px / std::max(1.0, static_cast<double>(scale.ticks.size()) - 1);
  while (static_cast<double>(every) * step_px < widest_px + gap_px) ++every;
  return every;
}

}  // namespace

void AddColorBar(Canvas* canvas, const ColorMap& colors, const ColorScale& scale,
                 const std::string& title, const PixelBox& box) {
  const TextStyle style;
  const std::string shown = scale.clipped ? title + ", ends open" : title;
  const Eigen::Vector2d title_size = canvas->TextSize(shown, style);
  double bottom = box.Top() - title_size.y();
  canvas->AddText(shown, {box.left, bottom}, style);

  const double bar_px = std::round(canvas->Px(8)), tick_px = std::round(canvas->Px(2));
  bottom = std::round(bottom - canvas->Px(2) - bar_px);
  Overlay& shapes = canvas->Shapes();
  const double left = std::round(box.left), width = std::round(box.width);
  for (int i = 0; i < ColorMap::kEntries; ++i) {
    const double from = left + std::round(width * i / ColorMap::kEntries);
    const double to = left + std::round(width * (i + 1) / ColorMap::kEntries);
    shapes.AddBox({from, bottom, to - from, bar_px}, colors.table()[static_cast<std::size_t>(i)]);
  }
  shapes.AddFrame({left, bottom, width, bar_px}, style.color, canvas->Px(0.4));
  const std::size_t every = LabelStride(*canvas, scale, style, width);
  for (std::size_t i = 0; i < scale.ticks.size(); ++i) {
    const double tick = scale.ticks[i];
    const double x = left + width * (tick - scale.low) / (scale.high - scale.low);
    const double line = std::max(1.0, std::round(canvas->Px(0.5)));
    shapes.AddBox({std::round(x - 0.5 * line), bottom - tick_px, line, tick_px}, style.color);
    if (i % every != 0) continue;
    const std::string text = NumberText(tick, scale.decimals);
    const Eigen::Vector2d size = canvas->TextSize(text, style);
    canvas->AddText(text, {x - 0.5 * size.x(), bottom - tick_px - canvas->Px(0.5) - size.y()},
                    style);
  }
}

}  // namespace telestrain::viz
