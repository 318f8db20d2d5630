#pragma once

#include <filesystem>

#include "base/console.h"
#include "base/result.h"

namespace telestrain {

struct RenderOptions {
  // Width of every picture. The default is 170 mm, a page's text width, at 300 dpi; texts and lines
  // keep their size on paper whatever the width.
  int width_px = 2008;
  // Height of the pictures. The default leaves half a page for the report's text.
  int height_px = 1240;
};

// Writes the pictures of a results folder to <results>/pictures: array.png (the array with target
// and pipe), targets.png (poses and residuals, ruler) and, when a strain was measured,
// pipe_strain.png. Needs no X server and touches nothing outside <results>. The same results give
// the same bytes.
// Fails with kBadInput when a file of the folder is missing or malformed or an option is out of
// range, with kOutputFailed when rendering or writing fails. One call at a time does the work; more
// threads wait for each other. About 4 s on two cores and 0.35 GB.
Status RenderResults(const std::filesystem::path& results, const RenderOptions& options,
                     Console& console);

}  // namespace telestrain
