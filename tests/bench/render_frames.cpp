#include "bench/render_frames.h"

#include <sys/resource.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <chrono>
#include <sstream>

#include "viz/part_actors.h"
#include "viz/scene/camera.h"
#include "viz/scene_from_results.h"

namespace telestrain::bench {
namespace {

constexpr int kWidth_px = 3508, kHeight_px = 2480, kFrames = 7;

double DrawOne(vtkRenderWindow* window) {
  const auto begin = std::chrono::steady_clock::now();
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, kWidth_px - 1, kHeight_px - 1, 0, pixels, 0);
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

double PeakMib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace

FrameCost DrawFrames(vtkRenderWindow* window, const std::string& results) {
  const auto scene = viz::SceneFromResults(results);
  if (!scene) return {};
  const viz::PartList list = viz::PartsOf(*scene);
  const viz::ParallelCamera camera = viz::FitCamera(viz::PointsOf(list.parts), viz::AxesOf(*scene),
                                                    {26, 13}, {0, 0, kWidth_px, kHeight_px}, 50);
  window->SetSize(kWidth_px, kHeight_px);
  window->SetMultiSamples(0);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->SetUseDepthPeeling(1);
  renderer->SetMaximumNumberOfPeels(40);
  renderer->SetOcclusionRatio(0);
  renderer->UseFXAAOn();
  viz::AddParts(renderer, list.parts, nullptr, 300 / 72.0);
  const Eigen::Vector3d position =
      camera.focal_in_array_mm + 2 * camera.depth_mm * camera.towards_viewer;
  vtkCamera* vtk_camera = renderer->GetActiveCamera();
  vtk_camera->ParallelProjectionOn();
  vtk_camera->SetFocalPoint(camera.focal_in_array_mm.data());
  vtk_camera->SetPosition(position.data());
  vtk_camera->SetViewUp(camera.up.data());
  vtk_camera->SetParallelScale(camera.half_height_mm);
  vtk_camera->SetClippingRange(camera.depth_mm, 3 * camera.depth_mm);
  window->AddRenderer(renderer);
  FrameCost cost{DrawOne(window), 0, 0, true};
  std::vector<double> times_ms;
  for (int i = 0; i < kFrames; ++i) times_ms.push_back(DrawOne(window));
  std::sort(times_ms.begin(), times_ms.end());
  cost.median_ms = times_ms[kFrames / 2];
  cost.peak_mib = PeakMib();
  return cost;
}

std::string ToLine(const FrameCost& cost) {
  std::ostringstream line;
  line << "cost " << cost.first_ms << ' ' << cost.median_ms << ' ' << cost.peak_mib;
  return line.str();
}

FrameCost FromLine(const std::string& line) {
  FrameCost cost;
  std::string word;
  std::istringstream in(line);
  cost.ok = static_cast<bool>(in >> word >> cost.first_ms >> cost.median_ms >> cost.peak_mib) &&
            word == "cost";
  return cost;
}

}  // namespace telestrain::bench
