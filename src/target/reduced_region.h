#pragma once

#include "base/gray_image.h"
#include "session/session.h"

namespace telestrain {

// The region of the image, averaged over squares of n x n pixels (n >= 1). Pixel (x, y) of it has
// its middle at the sensor's (region.x, region.y) + n (x, y) + (n - 1) / 2. The last columns and
// rows that fill no square are left out; empty when the region is smaller than one.
GrayImage ReduceRegion(const GrayImage& image, const PixelRegion& region, int n);

}  // namespace telestrain
