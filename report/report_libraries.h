#pragma once

#include <vector>

#include "base/library_version.h"

namespace telestrain {

// libharu, libpng, libxml2, OpenSSL, qpdf and zlib.
std::vector<LibraryVersion> ReportLibraries();

}  // namespace telestrain
