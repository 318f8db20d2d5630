#pragma once

#include <vector>

#include "base/library_version.h"

namespace telestrain {

// OpenCV and libjpeg-turbo, which does not say what is loaded. libpng is among the report's.
std::vector<LibraryVersion> ImageLibraries();

}  // namespace telestrain
