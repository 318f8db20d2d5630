#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/gray_image.h"
#include "correlation/pattern_assessment.h"
#include "correlation/pixel_mask.h"

namespace telestrain {

// Standard deviation of the displacement (the worse of u and v) that the noise of the images lets
// one expect of a match around each centre: what the assessment expects, by the local gradient. It
// goes with 1 / sqrt(SSSIG), SSSIG the sum of the squared grey gradient over the subset (Pan et al.
// 2008) less what the noise itself adds to it. NaN where noise hides the gradient. Pixels outside
// the mask do not count. The subsets lie inside the image; `centers_px` come row by row, as
// GridCenters gives them. Holds one row of the image.
std::vector<double> ExpectedSigma_px(const GrayImage& image,
                                     const std::vector<Eigen::Vector2i>& centers_px, int subset_px,
                                     const PatternAssessment& pattern,
                                     const PixelMask* mask = nullptr);

}  // namespace telestrain
