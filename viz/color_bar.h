#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "viz/canvas.h"
#include "viz/scene/color_map.h"

namespace telestrain::viz {

// A value that the bar points out: a limit.
struct ColorBarMark {
  double value = 0;
  std::string text;  // "limit 0.1 px"
};

// A horizontal bar with its title above and tick labels below, filling the box's width and hanging
// from its top. Values beyond the ends are drawn in the end colours; `scale.clipped` says so in the
// title. A mark inside the range is a triangle at its place with its text above; of one outside a
// line says that it lies beyond. Returns the lower edge of what was drawn.
double AddColorBar(Canvas* canvas, const ColorMap& colors, const ColorScale& scale,
                   const std::string& title, const PixelBox& box,
                   const std::vector<ColorBarMark>& marks = {});

// The marks of a limit that a session sets, also of its negative where the scale has one; none when
// it sets none.
std::vector<ColorBarMark> LimitMarks(const std::optional<double>& limit, const std::string& unit,
                                     const ColorScale& scale);

// The scale of a range that somebody chose: its ends as they are, round ticks between.
ColorScale ScaleOfRange(const std::array<double, 2>& range, const std::vector<double>& values);

}  // namespace telestrain::viz
