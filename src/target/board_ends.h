#pragma once

#include <array>

#include "target/corner_grid.h"

namespace telestrain {

// What lies one square beyond an end line of a grid.
enum class BeyondEnd {
  kUnknown,    // the view's edge, a cover, a shadow, dirt, too few places to judge
  kBorder,     // the board's outer border
  kContinues,  // more squares
};

// The ends of a grid: [axis][0] before the first line, [axis][1] behind the last.
using BoardEnds = std::array<std::array<BeyondEnd, 2>, 2>;

// Looks for the board's border where the squares behind the end lines must end. The plate about
// the board is as bright as its bright squares or as dark as its dark ones. A place along the
// border passes when a square of the other tone ends there, straight and within 0.02 squares of
// the line that the grid predicts, or when a square of the plate's tone passes into the plate
// without a step; behind it the plate goes on for 0.9 squares or to the view's edge. A border has
// five passed places, two of each kind, 70 % of each kind's places pass, and for every place where
// the squares go on five pass into the plate. Levels are compared with those at the nearest
// corners, so uneven light does not matter.
BoardEnds FindBoardEnds(const GrayImage& image, const PixelRegion& region, const CornerGrid& grid);

}  // namespace telestrain
