#pragma once

#include "viz/review/review_page.h"

namespace telestrain::review_test {

// A made-up instrument: two views, two boards of one image one above the other, a ruler, a pipe
// with a square of measured surface in two states. Every number is chosen, none is drawn.
inline constexpr double kStrain_microstrain[2] = {100, 200};  // all over the surface
inline constexpr double kHoop_microstrain[2] = {-30, -60};
inline constexpr double kSurfaceHeight_mm = 4;
viz::Scene MadeUpScene();

// results.json of one quantity with a limit and a table, the scene above and one picture.
viz::ReviewContent MadeUpContent();

// A picture of one pixel.
std::string SmallPng();

}  // namespace telestrain::review_test
