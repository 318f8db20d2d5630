#pragma once

#include <string>

#include "base/result.h"

namespace telestrain::viz {

// DejaVu Sans, which has all Greek letters and signs that the pictures use; VTK's own font has not.
struct FontFiles {
  std::string regular, bold;
};

// The first of the usual places that holds both; fails (kOutputFailed) naming them.
Result<FontFiles> FindFontFiles();

}  // namespace telestrain::viz
