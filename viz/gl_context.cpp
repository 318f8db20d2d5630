#include "viz/gl_context.h"

#include <sys/mman.h>
#include <sys/resource.h>

#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <string>

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

// Where the process's address space is limited (ulimit -v), whether there is room to draw: Mesa and
// VTK's C parts crash or wait for ever when a thread or a buffer cannot be had. `telestrain render`
// of the small session grows by 178 MiB on one thread and by 68 MiB for every further one, of which
// the C library reserves 64 MiB for the heap and 8 MiB, or what `ulimit -s` says, for the stack.
Status RequireRoom() {
  constexpr std::size_t kMebibyte = 1 << 20, kAlone = 192 * kMebibyte, kOfThread = 72 * kMebibyte;
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
  const int threads = DefaultThreads();  // of ours, of VTK; two rasterisers
  const std::size_t wanted =
      kAlone + (threads > 1 ? static_cast<std::size_t>(2 * threads + 2) * kOfThread : 0);
  void* const room =
      ::mmap(nullptr, wanted, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED)
    return OutputFailed("there is not enough memory to draw, which takes " +
                        std::to_string(wanted / kMebibyte) +
                        " MiB of address space; allow more (ulimit -v), or use --threads 1");
  ::munmap(room, wanted);
  return {};
}

}  // namespace

Result<std::unique_ptr<GlContext>> MakeGlContext(GlBackend backend) {
  TELESTRAIN_RETURN_IF_ERROR(CheckGlSymbols());
  static const Status has_room = RequireRoom();
  if (!has_room) return has_room.error();
  SetMesaEnvironmentOnce();
  return backend == GlBackend::kEgl ? MakeEglContext() : MakeOsMesaContext();
}

}  // namespace telestrain::viz
