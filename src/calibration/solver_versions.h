#pragma once

#include <vector>

#include "base/library_version.h"

namespace telestrain {

// Ceres and Eigen. Neither says which version is loaded; Eigen is compiled in.
std::vector<LibraryVersion> SolverVersions();

}  // namespace telestrain
