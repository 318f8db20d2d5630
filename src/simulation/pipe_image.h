#pragma once

#include <string>
#include <vector>

#include "base/gray_image.h"
#include "simulation/deformed_pipe.h"
#include "simulation/speckle_pattern.h"
#include "simulation/virtual_instrument.h"

namespace telestrain {

// The paint under every view of `instrument`, on the pipe in its reference state: one pattern per
// group, discs of 6 to 9 px across.
struct PaintedPipe {
  std::vector<std::string> groups;
  std::vector<SpecklePattern> patterns;  // one per group
  const SpecklePattern& Of(const std::string& group) const;
};
PaintedPipe PaintPipe(const VirtualInstrument& instrument, double radius_mm, std::uint64_t key);

// The noise-free image of the painted pipe in one state, before a dark background.
GrayImage RenderPipe(const VirtualInstrument& instrument, const PaintedPipe& paint,
                     const DeformedPipe& pipe, int threads);

}  // namespace telestrain
