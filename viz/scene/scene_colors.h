#pragma once

#include <string>

#include "viz/scene/color_map.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

// The colours of a scene, the same in every picture, page and file.

// One colour per group of views, a lighter one for every second view of the group. The colours are
// those of M. Okabe and K. Ito (2008), told apart with any colour vision.
Rgb ColorOfGroup(const Scene& scene, const std::string& group);
Rgb ColorOfView(const Scene& scene, std::size_t view);
inline constexpr Rgb kImageXColor{0.80, 0.10, 0.12};
inline constexpr Rgb kImageYColor{0.10, 0.52, 0.20};
inline constexpr Rgb kAxisColors[3] = {{0.75, 0.15, 0.15}, {0.15, 0.50, 0.20}, {0.15, 0.30, 0.70}};
inline constexpr Rgb kPipeColor{0.55, 0.60, 0.66};
inline constexpr Rgb kInk{0.13, 0.15, 0.18};
// Of what is outside its limit; dark, so that it is told from others in grey too.
inline constexpr Rgb kFailColor{0.70, 0.00, 0.16};
inline constexpr Rgb kRejectedColor{0.55, 0.55, 0.55};
inline constexpr Rgb kGaugeColor{0.78, 0.55, 0.10};
inline constexpr Rgb kArrowColor{0.25, 0.27, 0.30};
// Where a point has no value of the quantity that colours its part.
inline constexpr Rgb kNoValueColor{0.80, 0.80, 0.80};
inline constexpr Rgb kMirrorColor{0.62, 0.68, 0.74};
inline constexpr Rgb kSensorColor{0.30, 0.33, 0.37};

// Ranges and colour maps of what is coloured by a number.
ColorScale ResidualScale(const std::vector<Board>& boards);  // px, from 0
ColorMap ResidualColors(const std::vector<Board>& boards);
ColorScale RulerScale(const std::vector<RulerPosition>& rulers);  // um, both signs alike
ColorMap RulerColors(const std::vector<RulerPosition>& rulers);

// Over these surfaces together; a hundredth of the points at either end may be noise of single
// subsets and lies beyond the ends. A surface without the quantity does not count.
ColorScale ValueScale(const std::vector<const Surface*>& surfaces, const std::string& quantity);
// Over all states of the pipe, so that their pictures compare.
ColorScale ValueScale(const Pipe& pipe, const std::string& quantity);
ColorMap ValueColorMap(const ColorScale& scale);

}  // namespace telestrain::viz
