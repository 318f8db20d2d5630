#pragma once

#include <vector>

#include "correlation/point_chain.h"

namespace telestrain::correlation {

// The points of a grid on the image of `matches`, which becomes the reference. One that was not
// matched is put at the mean of what its matched neighbours within two grid points say, three at
// least, with the neighbours' covariance and their scatter; without such neighbours it is unknown.
std::vector<ChainedPoint> NextLinks(const std::vector<ChainedPoint>& points,
                                    const std::vector<SubsetMatch>& matches, int columns,
                                    int subset_px);

}  // namespace telestrain::correlation
