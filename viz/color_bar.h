#pragma once

#include <string>

#include "viz/canvas.h"
#include "viz/scene/color_map.h"

namespace telestrain::viz {

// A horizontal bar with its title above and tick labels below, filling the box's width and hanging
// from its top. Values beyond the ends are drawn in the end colours; `scale.clipped` says so in the
// title.
void AddColorBar(Canvas* canvas, const ColorMap& colors, const ColorScale& scale,
                 const std::string& title, const PixelBox& box);

}  // namespace telestrain::viz
