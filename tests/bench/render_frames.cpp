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

namespace telestrain::bench {
namespace {

constexpr int kWidth_px = 3508, kHeight_px = 2480, kFrames = 3;

double CpuMs() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto ms = [](const timeval& time) {
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
  };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

struct Times {
  double wall_ms, cpu_ms;
};

Times DrawOne(vtkRenderWindow* window) {
  const auto begin = std::chrono::steady_clock::now();
  const double begin_cpu_ms = CpuMs();
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, kWidth_px - 1, kHeight_px - 1, 0, pixels, 0);
  const auto wall = std::chrono::steady_clock::now() - begin;
  return {std::chrono::duration<double, std::milli>(wall).count(), CpuMs() - begin_cpu_ms};
}

// What the array picture shows: one state of the pipe, no rulers, arrows or ellipsoids.
std::vector<viz::Part> ArrayParts(const viz::Scene& scene) {
  std::vector<viz::Part> parts = viz::PartsOf(scene).parts;
  const int state = scene.pipe ? static_cast<int>(scene.pipe->largest_state) : viz::kEveryState;
  std::erase_if(parts, [&](const viz::Part& part) {
    using viz::Layer;
    return part.layer == Layer::kOptics || part.layer == Layer::kRulers ||
           part.layer == Layer::kDisplacements || part.layer == Layer::kUncertainty ||
           (part.state != viz::kEveryState && part.state != state);
  });
  return parts;
}

double PeakMib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace

FrameCost DrawFrames(vtkRenderWindow* window, const viz::Scene& scene) {
  const std::vector<viz::Part> parts = ArrayParts(scene);
  const viz::ParallelCamera camera = viz::FitCamera(viz::PointsOf(parts), viz::AxesOf(scene),
                                                    {26, 13}, {0, 0, kWidth_px, kHeight_px}, 50);
  window->SetSize(kWidth_px, kHeight_px);
  window->SetMultiSamples(0);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->SetUseDepthPeeling(1);
  renderer->SetMaximumNumberOfPeels(40);
  renderer->SetOcclusionRatio(0);
  renderer->UseFXAAOn();
  viz::AddParts(renderer, parts, nullptr, 300 / 72.0);
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
  FrameCost cost;
  cost.first_ms = DrawOne(window).wall_ms;
  for (int i = 0; i < kFrames; ++i) {
    const Times times = DrawOne(window);
    cost.best_ms = i == 0 ? times.wall_ms : std::min(cost.best_ms, times.wall_ms);
    cost.best_cpu_ms = i == 0 ? times.cpu_ms : std::min(cost.best_cpu_ms, times.cpu_ms);
  }
  cost.peak_mib = PeakMib();
  cost.ok = true;
  return cost;
}

std::string ToLine(const FrameCost& cost) {
  std::ostringstream line;
  line << "cost " << cost.first_ms << ' ' << cost.best_ms << ' ' << cost.best_cpu_ms << ' '
       << cost.peak_mib;
  return line.str();
}

FrameCost FromLine(const std::string& line) {
  FrameCost cost;
  std::string word;
  std::istringstream in(line);
  cost.ok = static_cast<bool>(in >> word >> cost.first_ms >> cost.best_ms >> cost.best_cpu_ms >>
                              cost.peak_mib) &&
            word == "cost";
  return cost;
}

}  // namespace telestrain::bench
