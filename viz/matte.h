#pragma once

#include "viz/pictures.h"

namespace telestrain::viz {

// The picture with transparency whose drawing on white paper gives `on_white` and, as far as it was
// mixed linearly, on black paper `on_black`: alpha = 1 - (white - black) per pixel. This holds
// whatever the renderer did to its own alpha channel; edge smoothing, which looks at the paper as
// well, is exact on white. Both have the same size.
RgbImage Matte(RgbImage on_white, const RgbImage& on_black);

}  // namespace telestrain::viz
