#pragma once

#include <string>

#include "viz/scene/scene.h"

class vtkRenderWindow;

namespace telestrain::bench {

// What drawing the array of a results folder on A4 at 300 dpi costs.
struct FrameCost {
  double first_ms = 0;     // with shaders to compile and data to load
  double best_ms = 0;      // of the frames after it, pixels read back: least disturbed by others
  double best_cpu_ms = 0;  // the same in processor time of all threads
  double peak_mib = 0;     // resident memory of the process
  bool ok = false;
};

// The parts of the array picture with depth peeling and FXAA, in a window without renderers. Does
// not take the right to use VTK.
FrameCost DrawFrames(vtkRenderWindow* window, const viz::Scene& scene);

std::string ToLine(const FrameCost& cost);
FrameCost FromLine(const std::string& line);

}  // namespace telestrain::bench
