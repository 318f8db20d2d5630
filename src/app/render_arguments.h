#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "viz/render.h"
#include "viz/video.h"

namespace CLI {
class App;
}

namespace telestrain {

// The words of `telestrain render`.
struct RenderArguments {
  std::string view, state = "largest", quantity, size, out;
  std::string backend = "osmesa";
  std::vector<double> range;  // two, or none
  int dpi = 0;
  bool transparent = false;
  bool reported = false;
  std::string turntable, states;  // files of films; at most one is given
  VideoOptions video;

  void AddTo(CLI::App& app);
  // The film to make; empty: pictures.
  const std::string& Film() const { return turntable.empty() ? states : turntable; }

 private:
  void AddFilmsTo(CLI::App& app);
};

// Fails (kUsage) with the option and its limits.
Result<RenderOptions> ReadOptions(const RenderArguments& arguments);

}  // namespace telestrain
