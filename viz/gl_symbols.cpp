#include "viz/gl_symbols.h"

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <cstring>
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

}  // namespace

Status CheckGlSymbols() {
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

}  // namespace telestrain::viz
