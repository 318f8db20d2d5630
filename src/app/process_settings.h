#pragma once

#include <string>

#include "app/command.h"
#include "base/result.h"

namespace telestrain {

// How the process works. No option of results: neither changes an entry of the audit trail, and
// the number of threads no byte.
struct ProcessSettings {
  int threads = 0;           // 0: one per core
  std::string vector_level;  // of the correlation's passes; empty: the best of this machine

  void AddTo(CLI::App& app);
  // Tells everything that threads: our pool and OpenMP; VTK and Mesa ask the pool when they start.
  // Ceres, OpenCV and a BLAS with threads of its own always work on one, the first and the last for
  // sums in a fixed order. Fails (kUsage) when this machine lacks the vector level. Before any
  // other thread works.
  Status Apply() const;
};

}  // namespace telestrain
