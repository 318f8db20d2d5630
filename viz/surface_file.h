#pragma once

#include <filesystem>

#include "base/result.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

// Reads points, quads and the point data axial_microstrain and group of a pipe_NNN.vtp. Fails
// (kBadInput) when the file is missing or malformed, has no quads or holds other cells, or lacks
// one of the arrays or a finite value in it.
Result<Surface> ReadSurface(const std::filesystem::path& path);

}  // namespace telestrain::viz
