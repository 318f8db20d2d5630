#pragma once

#include "base/gray_image.h"
#include "correlation/pixel_mask.h"

namespace telestrain {

// Where an image can be correlated with subsets of `subset_px`: the largest connected region whose
// windows of that size hold enough gradient energy in both directions, without uniform background
// and saturated areas, holes smaller than a subset filled. Empty (no pixel inside) when there is
// no texture. The threshold is found between the two levels of the image's own gradient energy
// (Otsu), never below what noise alone would show.
PixelMask TextureRegion(const GrayImage& image, int subset_px);

}  // namespace telestrain
