#pragma once

#include <string>
#include <vector>

#include "viz/canvas.h"

namespace telestrain::viz {

// One line of a legend: a sign and what it stands for.
struct LegendEntry {
  enum class Sign { kNone, kBox, kFrame, kLine, kColors };
  Sign sign = Sign::kNone;
  Rgb color;
  double opacity = 1;  // of a box's fill
  std::string text;
  const ColorMap* colors = nullptr;  // of kColors
};

// Draws the entries from the top of the box downwards, column by column, each column as wide as its
// longest text. Fails when they do not fit.
Status AddLegend(Canvas* canvas, const std::vector<LegendEntry>& entries, const PixelBox& box);

// A name from the session as a picture can show it: on one line, at most 24 characters.
std::string Shortened(const std::string& name);

// "1 board view", "3 board views".
std::string CountOf(int count, const std::string& thing);

// Title and, below it, a line of facts; returns the lower edge of what was drawn.
double AddTitle(Canvas* canvas, const std::string& title, const std::string& facts);

}  // namespace telestrain::viz
