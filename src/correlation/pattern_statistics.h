#pragma once

#include "base/gray_image.h"
#include "correlation/pixel_mask.h"
#include "session/session.h"

namespace telestrain::correlation {

struct PatternStatistics {
  double speckle_px = 0;  // full width at half maximum of the autocorrelation, mean of x and y
  double contrast_gray = 0;
  double noise_gray = 0;
  double saturated_share = 0;
  double gradient_gray_per_px = 0;  // rms of one component, before the blur
  // m / g^2 with the mean squares g of the gradient of the image blurred as the correlation blurs
  // it and m of that gradient blurred once more. A displacement of a subset of N pixels has the
  // variance 2 sigma^2 (m / g^2) / N; without blur m = g.
  double noise_gain = 0;
};

// Of the pixels of the region that are inside the mask, in tiles of 96 px whose means are taken
// off: slow changes of the light are not contrast. What the noise adds to every figure is removed.
PatternStatistics MeasurePattern(const GrayImage& image, const PixelRegion& region,
                                 const PixelMask* mask, double prefilter_sigma_px);

// Variance of a displacement against that with shape functions of order 0 and 1, which is 1; for
// order 2 the mean square of 1 - 5/2 P2(x) - 5/2 P2(y): 7/2.
double OrderVariance(int shape_order);

}  // namespace telestrain::correlation
