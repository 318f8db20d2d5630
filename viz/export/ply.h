#pragma once

#include <string>

#include "viz/scene/scene.h"

namespace telestrain::viz {

// The points of one state's measured surface as a binary little-endian PLY file: x y z (mm, array
// frame, where they are in that state), displacement_{x,y,z}_mm from the reference, sigma_um and
// every quantity under its key, all double; group as int. Comments name state and units.
std::string PlyBytes(const Pipe& pipe, std::size_t state);

}  // namespace telestrain::viz
