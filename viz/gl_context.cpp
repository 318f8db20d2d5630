#include "viz/gl_context.h"

#include <cstdlib>
#include <mutex>

#include "base/parallel.h"
#include "viz/egl_context.h"
#include "viz/gl_symbols.h"
#include "viz/osmesa_context.h"
#include "viz/vtk_threads.h"

namespace telestrain::viz {
namespace {

void SetMesaEnvironmentOnce() {
  static std::once_flag once;
  std::call_once(once, [] {
    SetVtkThreads(DefaultThreads());
    setenv("LP_NUM_THREADS", DefaultThreads() > 1 ? "2" : "0", 0);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  });
}

}  // namespace

Result<std::unique_ptr<GlContext>> MakeGlContext(GlBackend backend) {
  TELESTRAIN_RETURN_IF_ERROR(CheckGlSymbols());
  SetMesaEnvironmentOnce();
  return backend == GlBackend::kEgl ? MakeEglContext() : MakeOsMesaContext();
}

}  // namespace telestrain::viz
