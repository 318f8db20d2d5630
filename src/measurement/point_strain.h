#pragma once

#include "measurement/strain.h"

namespace telestrain {

// Strain tensors of the map: around every used point the patch's own gradient, plus the slopes of
// what its grid neighbours within kGaugeReach_steps do beyond the patch's field, along the pipe and
// around it. The field holds rigid motion exactly, so a turn leaves no strain. NaN with fewer than
// six neighbours or when they lie in a line.
void FillPointStrains(const PipeShape& shape, const PipeGrid& grid,
                      const std::vector<DisplacedPoint>& located,
                      const std::vector<PatchFit>& patches, std::vector<PointResult>& points);

}  // namespace telestrain
