#pragma once

#include "base/library_version.h"

namespace telestrain {

LibraryVersion OpenCvVersion();

}  // namespace telestrain
