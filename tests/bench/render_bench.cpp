#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>

#include "bench/render_frames.h"
#include "viz/offscreen_window.h"
#include "viz/scene_from_results.h"
#include "viz/vtk_messages.h"
#include "viz/window_keeper.h"

// render_bench RESULTS
// The array of a results folder on A4 at 300 dpi with depth peeling and FXAA: without a screen, and
// in the same run by VTK's own window under Xvfb and GLX. Exits with 1 when the ratio is above 1.2
// or memory reaches 1 GiB.

namespace {

using telestrain::bench::FrameCost;

constexpr double kMostRatio = 1.2, kMost_mib = 1024;

FrameCost UnderXvfb(const std::string& results) {
  const std::string command =
      "xvfb-run -a -s '-screen 0 64x64x24' '" TELESTRAIN_GLX_BENCH "' '" + results + "'";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  std::array<char, 256> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) text += part.data();
  return pclose(pipe) == 0 ? telestrain::bench::FromLine(text) : FrameCost{};
}

void Say(const char* name, const FrameCost& cost) {
  std::printf(
      "%-10s first frame %.0f ms, best of others %.0f ms (%.0f ms of processors), "
      "peak memory %.0f MiB\n",
      name, cost.first_ms, cost.best_ms, cost.best_cpu_ms, cost.peak_mib);
}

FrameCost OffScreen(const std::string& results) {
  const auto scene = telestrain::viz::SceneFromResults(results);
  if (!scene) {
    std::cerr << scene.error().message << '\n';
    return {};
  }
  const telestrain::viz::VtkMessages messages;
  const auto window = telestrain::viz::TakeWindow(telestrain::GlBackend::kOsMesa);
  if (!window) {
    std::cerr << window.error().message << '\n';
    return {};
  }
  return telestrain::bench::DrawFrames(*window, *scene);
}

FrameCost Better(const FrameCost& a, const FrameCost& b) {
  if (!a.ok || !b.ok) return {};
  return {std::min(a.first_ms, b.first_ms), std::min(a.best_ms, b.best_ms),
          std::min(a.best_cpu_ms, b.best_cpu_ms), std::max(a.peak_mib, b.peak_mib), true};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: render_bench RESULTS\n";
    return 2;
  }
  setenv("LP_NUM_THREADS", "2", 1);  // the same for both
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  FrameCost off_screen = OffScreen(argv[1]), glx = UnderXvfb(argv[1]);
  // Once more each, in turn: what else the machine does changes slowly.
  off_screen = Better(off_screen, OffScreen(argv[1]));
  glx = Better(glx, UnderXvfb(argv[1]));
  if (!off_screen.ok || !glx.ok) {
    std::cerr << "render_bench: " << (off_screen.ok ? "xvfb-run with GLX" : "off-screen drawing")
              << " failed\n";
    return 1;
  }
  Say("off-screen", off_screen);
  Say("Xvfb + GLX", glx);
  const double ratio = off_screen.best_ms / glx.best_ms;
  std::printf("ratio      %.2f (%.2f of processor time), bar %.1f; memory bar %.0f MiB\n", ratio,
              off_screen.best_cpu_ms / glx.best_cpu_ms, kMostRatio, kMost_mib);
  return ratio <= kMostRatio && off_screen.peak_mib < kMost_mib ? 0 : 1;
}
