#pragma once

#include <string>

class vtkRenderWindow;

namespace telestrain::bench {

// What drawing the array of a results folder on A4 at 300 dpi costs.
struct FrameCost {
  double first_ms = 0;   // with shaders to compile and data to load
  double median_ms = 0;  // of the frames after it, pixels read back
  double peak_mib = 0;   // resident memory of the process
  bool ok = false;
};

// Boards, volumes and pipe with depth peeling and FXAA, as the array picture has them, in a window
// without renderers.
FrameCost DrawFrames(vtkRenderWindow* window, const std::string& results);

std::string ToLine(const FrameCost& cost);
FrameCost FromLine(const std::string& line);

}  // namespace telestrain::bench
