#include "viz/scene/color_map.h"

#include <algorithm>
#include <cmath>

#include "base/numbers.h"

namespace telestrain::viz {
namespace {

constexpr Rgb FromHex(unsigned code) {
  return {(code >> 16 & 255) / 255.0, (code >> 8 & 255) / 255.0, (code & 255) / 255.0};
}

Rgb Mix(const Rgb& a, const Rgb& b, double share_b) {
  const auto mix = [share_b](double x, double y) { return x + share_b * (y - x); };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

// 1, 2 or 5 times a power of ten: the smallest such step that is at least `step`.
double RoundStep(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= step * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

}  // namespace

std::array<std::uint8_t, 3> BytesOf(const Rgb& color) {
  const auto byte = [](double x) { return static_cast<std::uint8_t>(std::lround(255 * x)); };
  return {byte(color.r), byte(color.g), byte(color.b)};
}

ColorMap::ColorMap(const std::vector<Rgb>& control_points, double low, double high)
    : low_(low), high_(high) {
  const double intervals = static_cast<double>(control_points.size() - 1);
  for (int i = 0; i < kEntries; ++i) {
    const double position = intervals * i / (kEntries - 1);
    const auto left = std::min(static_cast<std::size_t>(position), control_points.size() - 2);
    table_[i] =
        Mix(control_points[left], control_points[left + 1], position - static_cast<double>(left));
  }
}

// Control points: the maps "viridis" and "plasma" of N. Smith and S. van der Walt (Matplotlib 1.5,
// released under CC0) at ninths of their range.
ColorMap ColorMap::Viridis(double low, double high) {
  return ColorMap({FromHex(0x440154), FromHex(0x482878), FromHex(0x3e4989), FromHex(0x31688e),
                   FromHex(0x26828e), FromHex(0x1f9e89), FromHex(0x35b779), FromHex(0x6ece58),
                   FromHex(0xb5de2b), FromHex(0xfde725)},
                  low, high);
}

ColorMap ColorMap::DarkViridis(double low, double high) {
  return ColorMap({FromHex(0x440154), FromHex(0x482878), FromHex(0x3e4989), FromHex(0x31688e),
                   FromHex(0x26828e), FromHex(0x1f9e89), FromHex(0x35b779), FromHex(0x6ece58)},
                  low, high);
}

ColorMap ColorMap::Plasma(double low, double high) {
  return ColorMap({FromHex(0x0d0887), FromHex(0x46039f), FromHex(0x7201a8), FromHex(0x9c179e),
                   FromHex(0xbd3786), FromHex(0xd8576b), FromHex(0xed7953), FromHex(0xfb9f3a)},
                  low, high);
}

Rgb ColorMap::At(double value) const {
  if (std::isnan(value)) return table_.front();
  const double share = std::clamp((value - low_) / (high_ - low_), 0.0, 1.0);
  return table_[static_cast<std::size_t>(std::min<double>(share * kEntries, kEntries - 1))];
}

ColorScale ScaleFor(std::vector<double> values, double tail) {
  ColorScale scale;
  if (values.empty()) values = {0, 1};
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  double low = values[static_cast<std::size_t>(std::lround(tail * last))];
  double high = values[static_cast<std::size_t>(std::lround((1 - tail) * last))];
  const double least_span = std::max(1e-9, 1e-6 * std::max(std::abs(low), std::abs(high)));
  if (high - low < least_span) {
    const double half = std::max(0.05 * std::abs(low), least_span);
    low -= half;
    high += half;
  }
  constexpr int kMostIntervals = 6;
  double step = RoundStep((high - low) / kMostIntervals);
  if (std::ceil(high / step) - std::floor(low / step) > kMostIntervals + 1)
    step = RoundStep(2 * step);
  // Where values may lie beyond the ends, a little more of them does not cost a whole step.
  const double over = tail > 0 ? 0.05 : 1e-9;
  const double first = std::floor(low / step + over), end = std::ceil(high / step - over);
  for (double i = first; i <= end; ++i) scale.ticks.push_back(i * step);
  scale.low = scale.ticks.front();
  scale.high = scale.ticks.back();
  scale.decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  scale.clipped = values.front() < scale.low || values.back() > scale.high;
  return scale;
}

double RoundDown(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {10.0, 5.0, 2.0})
    if (factor * power <= value * (1 + 1e-9)) return factor * power;
  return power;
}

std::string NumberText(double value, int decimals) {
  const std::string text = FormatFixed(value, decimals);
  return text.front() == '-' ? "\u2212" + text.substr(1) : text;
}

}  // namespace telestrain::viz
