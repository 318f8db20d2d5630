#pragma once

#include <filesystem>

#include "base/result.h"
#include "viz/scene/scene.h"

namespace telestrain::viz {

// Reads a pipe_NNN.vtp: points, quads, displacement_mm, group and every scalar of the point data
// but the group as a quantity, the axial strain first, the others in the file's order; sigma_um is
// a quantity too. Points, displacements, axial strain and group must be there and finite, the group
// a whole number below `group_count`. Of the other scalars what is not finite becomes NaN: that
// point has no value. Without sigma_um in the file Surface::sigma_um is empty. Fails (kBadInput)
// when the file is missing or malformed, has no quads or holds other cells, or lacks one of those
// arrays.
Result<Surface> ReadSurface(const std::filesystem::path& path, int group_count);

}  // namespace telestrain::viz
