#include "viz/viz_libraries.h"

#include <gif_lib.h>
#include <vtkVersion.h>

namespace telestrain::viz {

std::vector<LibraryVersion> Libraries() {
  const std::string giflib = std::to_string(GIFLIB_MAJOR) + "." + std::to_string(GIFLIB_MINOR) +
                             "." + std::to_string(GIFLIB_RELEASE);
  return {{"VTK", VTK_VERSION, vtkVersion::GetVTKVersion()}, {"giflib", giflib, ""}};
}

}  // namespace telestrain::viz
