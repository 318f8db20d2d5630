#pragma once

#include <Eigen/Core>
#include <vector>

#include "correlation/correlation_field.h"
#include "correlation/point_propagation.h"

namespace telestrain::correlation {

// The reference's grey levels; `origin_px` is where its first pixel lies in the whole image.
struct SeedReference {
  const GrayImage& gray;
  Eigen::Vector2i origin_px;
};

// Whole-pixel starts where nothing is known: textured blocks around some of the points are searched
// in the image reduced to about 768 px, anywhere within options.max_shift_share, unturned first
// and turned by up to options.max_rotation_deg when too few blocks agree; then at full resolution
// around what was found. Candidates that no other one supports are left out when there are four or
// more. The rest are starts, not results: they are still to be matched.
std::vector<KnownMatch> SearchSeeds(const SeedReference& reference, const GrayImage& image,
                                    const std::vector<Eigen::Vector2i>& centers_px,
                                    const FieldOptions& options);

}  // namespace telestrain::correlation
