#include "viz/osmesa_context.h"

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>

extern "C" {

using GlFunction = void (*)();

// GLEW's GLX flavour loads its entry points through this name. The executable's definition comes
// ahead of libGLX's in the lookup order. Names in "glX" must not reach Mesa, which answers with a
// stub for anything that begins with "gl".
__attribute__((visibility("default"), used)) GlFunction glXGetProcAddressARB(
    const unsigned char* name) {
  const char* text = reinterpret_cast<const char*>(name);
  if (std::strncmp(text, "glX", 3) != 0) return OSMesaGetProcAddress(text);
  using Lookup = GlFunction (*)(const unsigned char*);
  static const auto real = reinterpret_cast<Lookup>(dlsym(RTLD_NEXT, "glXGetProcAddressARB"));
  return real != nullptr ? real(name) : nullptr;
}

}  // extern "C"

namespace telestrain::viz {
namespace {

// The file of the library that a symbol resolves to in this process.
std::string LibraryOf(const char* symbol) {
  Dl_info info{};
  void* address = dlsym(RTLD_DEFAULT, symbol);
  if (address == nullptr || dladdr(address, &info) == 0 || info.dli_fname == nullptr)
    return "nothing";
  return info.dli_fname;
}

Status CheckSymbols() {
  const std::string library = LibraryOf("glClear");
  if (library.find("libOSMesa") == std::string::npos)
    return OutputFailed("off-screen rendering: glClear must resolve into libOSMesa, found '" +
                        library + "'; link the executable with telestrain::viz's link options");
  if (dlsym(RTLD_DEFAULT, "glXGetProcAddressARB") != reinterpret_cast<void*>(&glXGetProcAddressARB))
    return OutputFailed(
        "off-screen rendering: glXGetProcAddressARB must be the executable's own, "
        "found '" +
        LibraryOf("glXGetProcAddressARB") +
        "'; link the executable with telestrain::viz's link options");
  return {};
}

void SetMesaEnvironmentOnce() {
  static std::once_flag once;
  std::call_once(once, [] {
    setenv("LP_NUM_THREADS", "2", 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  });
}

}  // namespace

struct OsMesaContext::State {
  OSMesaContext context = nullptr;
  // VTK draws into framebuffer objects of its own and reads back from them: OSMesa's buffer is
  // never drawn to and stays tiny whatever the size of the picture.
  static constexpr int kSide_px = 16;
  alignas(64) unsigned char buffer[kSide_px * kSide_px * 4] = {};
};

OsMesaContext::OsMesaContext(std::unique_ptr<State> state) : state_(std::move(state)) {}

OsMesaContext::~OsMesaContext() {
  if (IsCurrent()) Release();
  OSMesaDestroyContext(state_->context);
}

Result<std::unique_ptr<OsMesaContext>> OsMesaContext::Create() {
  TELESTRAIN_RETURN_IF_ERROR(CheckSymbols());
  SetMesaEnvironmentOnce();
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            24,
                            OSMESA_STENCIL_BITS,
                            0,
                            OSMESA_ACCUM_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  auto state = std::make_unique<State>();
  state->context = OSMesaCreateContextAttribs(attributes, nullptr);
  if (state->context == nullptr)
    return OutputFailed(
        "off-screen rendering: OSMesa gives no OpenGL 3.3 core context; "
        "libOSMesa 22 with llvmpipe is wanted (Debian package libosmesa6)");
  std::unique_ptr<OsMesaContext> made(new OsMesaContext(std::move(state)));
  if (!made->MakeCurrent())
    return OutputFailed("off-screen rendering: the OpenGL context cannot be made current");
  return made;
}

bool OsMesaContext::IsCurrent() const { return OSMesaGetCurrentContext() == state_->context; }

bool OsMesaContext::MakeCurrent() {
  return OSMesaMakeCurrent(state_->context, state_->buffer, GL_UNSIGNED_BYTE, State::kSide_px,
                           State::kSide_px) != GL_FALSE;
}

void OsMesaContext::Release() { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

void* OsMesaContext::Handle() const { return state_->context; }

}  // namespace telestrain::viz
