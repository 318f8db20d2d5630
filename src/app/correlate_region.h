#pragma once

#include <optional>
#include <string>

#include "app/correlate_setup.h"

namespace telestrain {

// Puts --region into setup->options: four numbers as they are, a mask (read, or with "auto" the
// texture that subsets of `subset_px` find) with the region around it. Fails with kUsage for
// numbers outside the image, with kBadInput for an unfit mask.
Status SetRegion(const std::string& region, const GrayImage& reference, int subset_px,
                 CorrelateSetup* setup);

}  // namespace telestrain
