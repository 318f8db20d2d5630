#pragma once

#include <memory>

#include "base/result.h"
#include "viz/render.h"

namespace telestrain::viz {

// An OpenGL 3.3 core context of Mesa's software rasteriser: no X server, no GPU, no socket.
// Belongs to one thread at a time; Release() before another one takes it.
class GlContext {
 public:
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  virtual bool IsCurrent() const = 0;
  virtual bool MakeCurrent() = 0;
  virtual void Release() = 0;
  virtual void* Handle() const = 0;

 protected:
  GlContext() = default;
};

// The one place that knows the backends. The context is current when it returns. Fails
// (kOutputFailed) with the reason: the executable is linked wrongly or Mesa gives no context. The
// first call fixes VTK's threads and the process's environment for Mesa: two rasteriser threads, or
// none beside the caller's when DefaultThreads() is 1, unless LP_NUM_THREADS says otherwise (more
// do not help); no shader cache on disk.
Result<std::unique_ptr<GlContext>> MakeGlContext(GlBackend backend);

}  // namespace telestrain::viz
