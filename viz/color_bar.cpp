#include "viz/color_bar.h"

#include <algorithm>
#include <cmath>

#include "base/numbers.h"

namespace telestrain::viz {
namespace {

constexpr Rgb kMarkColor{0.08, 0.08, 0.08};
constexpr double kBar_pt = 8, kTick_pt = 2, kTriangle_pt = 4;

// The bar while it is drawn, from the top downwards.
class Bar {
 public:
  Bar(Canvas* canvas, const ColorScale& scale, const PixelBox& box)
      : canvas_(canvas),
        scale_(scale),
        left_(std::round(box.left)),
        width_(std::round(box.width)),
        bottom_(box.Top()) {}

  void AddLine(const std::string& text) {
    bottom_ -= canvas_->TextSize(text, style_).y();
    canvas_->AddText(text, {left_, bottom_}, style_);
  }

  // Texts of marks inside share a line as long as they do not touch.
  void AddMarks(std::vector<ColorBarMark> marks) {
    std::sort(marks.begin(), marks.end(),
              [](const ColorBarMark& a, const ColorBarMark& b) { return a.value < b.value; });
    std::vector<double> places;
    double free_from = 0;
    for (const ColorBarMark& mark : marks) {
      if (!IsInside(mark.value)) continue;
      const Eigen::Vector2d size = canvas_->TextSize(mark.text, style_);
      const double most_left = left_ + width_ - size.x();
      const double text_left =
          std::clamp(PlaceOf(mark.value) - 0.5 * size.x(), left_, std::max(left_, most_left));
      if (places.empty() || text_left < free_from) bottom_ -= size.y();
      canvas_->AddText(mark.text, {text_left, bottom_}, style_);
      free_from = text_left + size.x() + canvas_->Px(4);
      places.push_back(PlaceOf(mark.value));
    }
    if (places.empty()) return;
    const double height = canvas_->Px(kTriangle_pt), half = 0.6 * height;
    bottom_ -= canvas_->Px(1) + height;
    // The tip touches the bar, which comes two points further down.
    const double tip = bottom_ - canvas_->Px(2);
    for (const double x : places)
      canvas_->Shapes().AddTriangle(
          {Eigen::Vector2d(x - half, tip + height), Eigen::Vector2d(x + half, tip + height),
           Eigen::Vector2d(x, tip)},
          kMarkColor);
  }

  void AddColors(const ColorMap& colors) {
    const double height = std::round(canvas_->Px(kBar_pt));
    bottom_ = std::round(bottom_ - canvas_->Px(2) - height);
    Overlay& shapes = canvas_->Shapes();
    for (int i = 0; i < ColorMap::kEntries; ++i) {
      const double from = left_ + std::round(width_ * i / ColorMap::kEntries);
      const double to = left_ + std::round(width_ * (i + 1) / ColorMap::kEntries);
      shapes.AddBox({from, bottom_, to - from, height},
                    colors.table()[static_cast<std::size_t>(i)]);
    }
    shapes.AddFrame({left_, bottom_, width_, height}, style_.color, canvas_->Px(0.4));
  }

  // Both ends have their numbers; between them those that touch no other.
  void AddTicks() {
    const double tick_px = std::round(canvas_->Px(kTick_pt)), gap_px = canvas_->Px(4);
    const double line = std::max(1.0, std::round(canvas_->Px(0.5)));
    const std::size_t last = scale_.ticks.size() - 1;
    const double end = PlaceOf(scale_.ticks[last]) - 0.5 * TickSize(last).x() - gap_px;
    double lowest = bottom_ - tick_px, free_from = 0;
    for (std::size_t i = 0; i <= last; ++i) {
      const double x = PlaceOf(scale_.ticks[i]);
      canvas_->Shapes().AddBox({std::round(x - 0.5 * line), bottom_ - tick_px, line, tick_px},
                               style_.color);
      const Eigen::Vector2d size = TickSize(i);
      const double left = x - 0.5 * size.x(), right = x + 0.5 * size.x();
      const bool is_end = i == 0 || i == last;
      if (!is_end && (left < free_from || right > end)) continue;
      const double text_bottom = bottom_ - tick_px - canvas_->Px(0.5) - size.y();
      canvas_->AddText(NumberText(scale_.ticks[i], scale_.decimals), {left, text_bottom}, style_);
      free_from = right + gap_px;
      lowest = std::min(lowest, text_bottom);
    }
    bottom_ = lowest;
  }

  void AddMarksOutside(const std::vector<ColorBarMark>& marks) {
    for (const ColorBarMark& mark : marks)
      if (!IsInside(mark.value)) AddLine(mark.text + " lies beyond");
  }

  double bottom() const { return bottom_; }

 private:
  bool IsInside(double value) const { return value >= scale_.low && value <= scale_.high; }
  double PlaceOf(double value) const {
    return left_ + width_ * (value - scale_.low) / (scale_.high - scale_.low);
  }

  Eigen::Vector2d TickSize(std::size_t tick) const {
    return canvas_->TextSize(NumberText(scale_.ticks[tick], scale_.decimals), style_);
  }

  Canvas* canvas_;
  const ColorScale& scale_;
  TextStyle style_;
  double left_, width_, bottom_;
};

// Digits behind the point that tell `value`, at most six.
int DecimalsOf(double value) {
  const std::string text = FormatShortest(value);
  const auto point = text.find('.');
  if (point == std::string::npos || text.find('e') != std::string::npos) return 0;
  return std::min(6, static_cast<int>(text.size() - point - 1));
}

}  // namespace

double AddColorBar(Canvas* canvas, const ColorMap& colors, const ColorScale& scale,
                   const std::string& title, const PixelBox& box,
                   const std::vector<ColorBarMark>& marks) {
  Bar bar(canvas, scale, box);
  bar.AddLine(scale.clipped ? title + ", some beyond" : title);
  bar.AddMarks(marks);
  bar.AddColors(colors);
  bar.AddTicks();
  bar.AddMarksOutside(marks);
  return bar.bottom();
}

std::vector<ColorBarMark> LimitMarks(const std::optional<double>& limit, const std::string& unit,
                                     const ColorScale& scale) {
  if (!limit) return {};
  const std::string text = FormatShortest(*limit) + " " + unit;
  if (scale.low >= 0) return {{*limit, "limit " + text}};
  if (*limit > scale.high) return {{*limit, "limit \u00b1" + text}};
  return {{-*limit, "limit \u2212" + text}, {*limit, "limit " + text}};
}

ColorScale ScaleOfRange(const std::array<double, 2>& range, const std::vector<double>& values) {
  const auto [low, high] = range;
  const ColorScale round = ScaleFor({low, high}, 0);
  ColorScale scale = round;
  scale.low = low;
  scale.high = high;
  scale.clipped = std::any_of(values.begin(), values.end(),
                              [&](double value) { return value < low || value > high; });
  const double step = round.ticks[1] - round.ticks[0];
  scale.ticks = {low};
  for (const double tick : round.ticks)
    if (tick > low + 0.3 * step && tick < high - 0.3 * step) scale.ticks.push_back(tick);
  scale.ticks.push_back(high);
  scale.decimals = std::max({round.decimals, DecimalsOf(low), DecimalsOf(high)});
  return scale;
}

}  // namespace telestrain::viz
