#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace telestrain::viz {

// sRGB, each in [0, 1].
struct Rgb {
  double r = 0, g = 0, b = 0;
};
std::array<std::uint8_t, 3> BytesOf(const Rgb& color);

// A perceptual colour table of 256 entries over [low, high]; values outside take the end colours.
class ColorMap {
 public:
  static constexpr int kEntries = 256;

  // For strain: dark blue - green - yellow.
  static ColorMap Viridis(double low, double high);
  // Its darker four fifths, for lines on white paper.
  static ColorMap DarkViridis(double low, double high);
  // For residuals: dark blue - magenta - orange, without plasma's yellow, which white paper hides.
  static ColorMap Plasma(double low, double high);

  double low() const { return low_; }
  double high() const { return high_; }
  const std::array<Rgb, kEntries>& table() const { return table_; }
  Rgb At(double value) const;

 private:
  ColorMap(const std::vector<Rgb>& control_points, double low, double high);
  std::array<Rgb, kEntries> table_;
  double low_, high_;
};

// A range with round ends around `values` and the labelled positions within it.
struct ColorScale {
  double low = 0, high = 1;
  std::vector<double> ticks;  // the first is low, the last is high
  int decimals = 0;           // that the tick labels need
  bool clipped = false;       // some values lie outside
};

// Covers the values but for a share `tail` at either end, so that a single outlier does not take
// the contrast from all others. A constant field gets a range of its own around the value.
ColorScale ScaleFor(std::vector<double> values, double tail);

// 1, 2 or 5 times a power of ten, the largest not above `value` (> 0).
double RoundDown(double value);

// "−12.5": fixed notation with a typographic minus sign.
std::string NumberText(double value, int decimals);

}  // namespace telestrain::viz
