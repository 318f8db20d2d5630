#pragma once

#include <string>
#include <vector>

#include "report/reading/page_drawing.h"

namespace telestrain {

// A row of a table with a SHA-256.
struct PrintedHash {
  std::string row;     // the text that the row begins with
  std::string sha256;  // 64 hexadecimal digits
};

// The rows of a page with a SHA-256 that a person can read, from top to bottom: upright, at least 4
// points high, in contrast to what lies below, with nothing over it, inside the page and the clip.
// Throws std::runtime_error when there are too many.
std::vector<PrintedHash> PrintedHashes(const PageDrawing& drawing);

}  // namespace telestrain
