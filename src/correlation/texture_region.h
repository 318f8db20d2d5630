#pragma once

#include "base/gray_image.h"
#include "correlation/pixel_mask.h"

namespace telestrain {

// Where an image can be correlated with subsets of `subset_px`: the largest connected region with
// enough gradient energy in both directions, without uniform background and saturated areas; holes
// smaller than a subset are filled. Known to an eighth of the subset. Empty (no pixel inside) when
// there is no texture.
//
// The energy of windows of half a subset is compared with half the level of the textured ones, so
// that the region ends where half a window is textured. That level is the median of the windows
// above a threshold: between the two classes of windows (Otsu, on the logarithm) when they are ten
// times apart, and never below three times what the image's own noise has.
PixelMask TextureRegion(const GrayImage& image, int subset_px);

}  // namespace telestrain
