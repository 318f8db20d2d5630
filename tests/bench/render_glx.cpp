#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <iostream>

#include "bench/render_frames.h"
#include "viz/scene_from_results.h"

// The same frames in VTK's own window, on the X server of $DISPLAY. render_bench starts it.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto scene = telestrain::viz::SceneFromResults(argv[1]);
  if (!scene) return 1;
  vtkNew<vtkRenderWindow> window;
  if (!window->IsA("vtkXOpenGLRenderWindow")) return 1;
  window->SetOffScreenRendering(1);
  const auto cost = telestrain::bench::DrawFrames(window, *scene);
  std::cout << telestrain::bench::ToLine(cost) << '\n';
  return cost.ok ? 0 : 1;
}
