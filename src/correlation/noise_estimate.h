#pragma once

#include "base/gray_image.h"
#include "correlation/pixel_mask.h"
#include "session/session.h"

namespace telestrain::correlation {

// Standard deviation of the white noise of a textured image, quantisation included, from the image
// itself. In tiles of 32 px the variance of fourth differences along both directions (the corner of
// the spectrum where a pattern has least) is compared with that of second differences; what the
// pattern still leaves in the first grows in proportion with what it leaves in the second, so a
// line through the tiles gives the noise where the pattern is gone. Tiles with saturated or masked
// pixels are left out. Zero when no tile is left.
double EstimateNoise_gray(const GrayImage& image, const PixelRegion& region,
                          const PixelMask* mask = nullptr);

}  // namespace telestrain::correlation
