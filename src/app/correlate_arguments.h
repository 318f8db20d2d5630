#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace CLI {
class App;
}

namespace telestrain {

inline constexpr int kLeastSubset_px = 11, kMostSubset_px = 601;

// What `telestrain correlate` was asked for.
struct CorrelateArguments {
  std::string reference, out;
  std::vector<std::string> images;
  std::optional<int> subset_px, step_px;  // none: as the pattern assessment recommends
  int order = 1;
  std::string region;  // "x,y,w,h", "auto" or a mask's file; empty: the whole image
  bool cubic = false;
  int strain_window_points = 5;
  std::string incremental = "on";
  std::string show = "magnitude";
  bool assess_only = false;
  int threads = 0;

  void AddTo(CLI::App& app);
  // Fails (kUsage) on a number that no image can have.
  Status Check() const;
};

inline Error WrongUsage(std::string message) { return {ErrorKind::kUsage, std::move(message)}; }

}  // namespace telestrain
