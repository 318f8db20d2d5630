#pragma once

#include <vtkSmartPointer.h>

#include "base/result.h"
#include "viz/offscreen_window.h"

namespace telestrain::viz {

// While one exists, canvases share one window per backend: context and shaders are made once, which
// saves about a second for every picture after the first. The pictures are the same either way.
// Holds no lock; thread-safe.
class WindowKeeper {
 public:
  WindowKeeper();
  ~WindowKeeper();
  WindowKeeper(const WindowKeeper&) = delete;
  WindowKeeper& operator=(const WindowKeeper&) = delete;
};

// The kept window, without renderers and current in this thread, or a new one. The caller holds a
// VtkMessages, and before it lets go of that, it removes its renderers and calls Release(). Fails
// (kOutputFailed) with the reason.
Result<vtkSmartPointer<OffscreenWindow>> TakeWindow(GlBackend backend);

}  // namespace telestrain::viz
