#pragma once

#include "viz/pictures.h"

namespace telestrain::viz {

// The picture at another size, not larger, on white paper: every new pixel is the mean of the area
// that it covers.
RgbImage Reduced(const RgbImage& image, int width_px, int height_px);

}  // namespace telestrain::viz
