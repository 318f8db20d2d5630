#pragma once

#include <memory>

#include "base/result.h"

namespace telestrain::viz {

// An OpenGL 3.3 core context of Mesa's software rasteriser: no X server, no GPU, no socket.
//
// Debian's VTK and GLEW are built for GLX. They run on OSMesa when two conditions hold in the final
// executable; telestrain::viz's link options and this file's object see to both:
//  1. libOSMesa is the first library on the link line, so that every gl* call of VTK binds to it
//     and not to libOpenGL's stubs, which do nothing and report nothing;
//  2. the executable exports glXGetProcAddressARB (defined beside this class), through which GLEW
//     looks up all newer entry points.
// Create() verifies both and refuses otherwise: the alternative is a wrong picture and exit code 0.
//
// A context belongs to one thread at a time.
class OsMesaContext {
 public:
  // Fails (kOutputFailed) with the violated condition. The first call fixes the process's
  // environment for Mesa: two rasteriser threads (more do not help), no shader cache on disk.
  static Result<std::unique_ptr<OsMesaContext>> Create();
  ~OsMesaContext();
  OsMesaContext(const OsMesaContext&) = delete;
  OsMesaContext& operator=(const OsMesaContext&) = delete;

  bool IsCurrent() const;
  bool MakeCurrent();
  void Release();
  void* Handle() const;

 private:
  struct State;
  explicit OsMesaContext(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace telestrain::viz
