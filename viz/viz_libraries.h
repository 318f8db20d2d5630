#pragma once

#include <vector>

#include "base/library_version.h"

namespace telestrain::viz {

// VTK and giflib.
std::vector<LibraryVersion> Libraries();

}  // namespace telestrain::viz
