#include <vtkNew.h>
#include <vtkXOpenGLRenderWindow.h>

#include <iostream>

#include "bench/render_frames.h"

// The same frames in VTK's own window, on the X server of $DISPLAY. render_bench starts it.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  vtkNew<vtkXOpenGLRenderWindow> window;
  window->SetOffScreenRendering(1);
  const auto cost = telestrain::bench::DrawFrames(window, argv[1]);
  std::cout << telestrain::bench::ToLine(cost) << '\n';
  return cost.ok ? 0 : 1;
}
