#include "viz/osmesa_context.h"

#include <GL/osmesa.h>

namespace telestrain::viz {
namespace {

class OsMesa : public GlContext {
 public:
  explicit OsMesa(OSMesaContext context) : context_(context) {}
  ~OsMesa() override {
    if (OsMesa::IsCurrent()) OsMesa::Release();
    OSMesaDestroyContext(context_);
  }

  bool IsCurrent() const override { return OSMesaGetCurrentContext() == context_; }
  bool MakeCurrent() override {
    return OSMesaMakeCurrent(context_, buffer_, GL_UNSIGNED_BYTE, kSide_px, kSide_px) != GL_FALSE;
  }
  void Release() override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
  void* Handle() const override { return context_; }

 private:
  // VTK draws into framebuffer objects of its own and reads back from them: OSMesa's buffer is
  // never drawn to and stays tiny whatever the size of the picture.
  static constexpr int kSide_px = 16;
  OSMesaContext context_;
  alignas(64) unsigned char buffer_[kSide_px * kSide_px * 4] = {};
};

}  // namespace

Result<std::unique_ptr<GlContext>> MakeOsMesaContext() {
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
  const OSMesaContext context = OSMesaCreateContextAttribs(attributes, nullptr);
  if (context == nullptr)
    return OutputFailed(
        "off-screen rendering: OSMesa gives no OpenGL 3.3 core context; "
        "libOSMesa 22 with llvmpipe is wanted (Debian package libosmesa6)");
  std::unique_ptr<GlContext> made = std::make_unique<OsMesa>(context);
  if (!made->MakeCurrent())
    return OutputFailed("off-screen rendering: the OpenGL context cannot be made current");
  return made;
}

}  // namespace telestrain::viz
