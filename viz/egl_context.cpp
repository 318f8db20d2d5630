#include "viz/egl_context.h"

#define EGL_NO_X11  // X11's macros clash with everything
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <cstring>
#include <string>

namespace telestrain::viz {
namespace {

constexpr const char* kPackages = " (Debian packages libegl1, libegl-mesa0, libgl1-mesa-dri)";

// The functions of libEGL that are used; null when it is not installed or too old.
struct Egl {
  PFNEGLGETPROCADDRESSPROC get_address = nullptr;
  PFNEGLINITIALIZEPROC initialize = nullptr;
  PFNEGLBINDAPIPROC bind_api = nullptr;
  PFNEGLCREATECONTEXTPROC create_context = nullptr;
  PFNEGLDESTROYCONTEXTPROC destroy_context = nullptr;
  PFNEGLMAKECURRENTPROC make_current = nullptr;
  PFNEGLGETCURRENTCONTEXTPROC current_context = nullptr;
  PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;
  PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;

  Egl() {
    void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return;
    get_address = reinterpret_cast<PFNEGLGETPROCADDRESSPROC>(dlsym(library, "eglGetProcAddress"));
    if (get_address == nullptr) return;
    Find("eglInitialize", initialize);
    Find("eglBindAPI", bind_api);
    Find("eglCreateContext", create_context);
    Find("eglDestroyContext", destroy_context);
    Find("eglMakeCurrent", make_current);
    Find("eglGetCurrentContext", current_context);
    Find("eglQueryDevicesEXT", query_devices);
    Find("eglQueryDeviceStringEXT", query_device_string);
    Find("eglGetPlatformDisplayEXT", get_platform_display);
  }
  bool IsComplete() const {
    return initialize && bind_api && create_context && destroy_context && make_current &&
           current_context && query_devices && query_device_string && get_platform_display;
  }

 private:
  template <typename Function>
  void Find(const char* name, Function& function) {
    function = reinterpret_cast<Function>(get_address(name));
  }
};

const Egl& TheEgl() {
  static const Egl egl;
  return egl;
}

EGLDisplay OpenSoftwareDisplay() {
  const Egl& egl = TheEgl();
  std::array<EGLDeviceEXT, 32> devices{};
  EGLint count = 0;
  if (!egl.query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count))
    return EGL_NO_DISPLAY;
  for (EGLint i = 0; i < count; ++i) {
    EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
    const char* extensions = egl.query_device_string(device, EGL_EXTENSIONS);
    if (extensions == nullptr || std::strstr(extensions, "EGL_MESA_device_software") == nullptr)
      continue;
    const EGLDisplay display = egl.get_platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    if (display != EGL_NO_DISPLAY && egl.initialize(display, nullptr, nullptr)) return display;
  }
  return EGL_NO_DISPLAY;
}

// One for the process; a display is never closed.
EGLDisplay SoftwareDisplay() {
  static const EGLDisplay display = OpenSoftwareDisplay();
  return display;
}

class EglContext : public GlContext {
 public:
  explicit EglContext(EGLContext context) : context_(context) {}
  ~EglContext() override {
    if (EglContext::IsCurrent()) EglContext::Release();
    TheEgl().destroy_context(SoftwareDisplay(), context_);
  }

  bool IsCurrent() const override { return TheEgl().current_context() == context_; }
  bool MakeCurrent() override { return Make(context_); }
  void Release() override { Make(EGL_NO_CONTEXT); }
  void* Handle() const override { return context_; }

 private:
  static bool Make(EGLContext context) {
    return TheEgl().make_current(SoftwareDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, context) ==
           EGL_TRUE;
  }
  EGLContext context_;
};

}  // namespace

bool HasEgl() { return TheEgl().IsComplete(); }

Result<std::unique_ptr<GlContext>> MakeEglContext() {
  if (!HasEgl())
    return OutputFailed(std::string("off-screen rendering: libEGL.so.1 with EGL 1.5 is wanted and "
                                    "was not found") +
                        kPackages + "; or use the backend osmesa");
  if (SoftwareDisplay() == EGL_NO_DISPLAY || !TheEgl().bind_api(EGL_OPENGL_API))
    return OutputFailed(
        std::string("off-screen rendering: EGL lists no device EGL_MESA_device_software") +
        kPackages + "; or use the backend osmesa");
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               3,
                               EGL_CONTEXT_MINOR_VERSION,
                               3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  const EGLContext context =
      TheEgl().create_context(SoftwareDisplay(), EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT)
    return OutputFailed("off-screen rendering: EGL gives no OpenGL 3.3 core context");
  std::unique_ptr<GlContext> made = std::make_unique<EglContext>(context);
  if (!made->MakeCurrent())
    return OutputFailed("off-screen rendering: the OpenGL context cannot be made current");
  return made;
}

}  // namespace telestrain::viz
