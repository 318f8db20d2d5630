#include "viz/offscreen_window.h"

#include <vtkGenericRenderWindowInteractor.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkVersion.h>
#include <vtk_glew.h>

#include <array>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>

#include "viz/gl_context.h"

namespace telestrain::viz {
namespace {

vtkObject* MakeWindow() { return OffscreenWindow::New(); }
vtkObject* MakeInteractor() { return vtkGenericRenderWindowInteractor::New(); }

class OffscreenFactory : public vtkObjectFactory {
 public:
  static OffscreenFactory* New();
  vtkTypeMacro(OffscreenFactory, vtkObjectFactory) const char* GetVTKSourceVersion() override {
    return VTK_SOURCE_VERSION;
  }
  const char* GetDescription() override { return "windows without a screen"; }

 protected:
  OffscreenFactory() {
    RegisterOverride("vtkRenderWindow", "OffscreenWindow", "off-screen", 1, MakeWindow);
    RegisterOverride("vtkRenderWindowInteractor", "vtkGenericRenderWindowInteractor", "off-screen",
                     1, MakeInteractor);
  }
};
vtkStandardNewMacro(OffscreenFactory);

bool IsUsable(GLenum glew_code) {
  return glew_code == GLEW_OK || glew_code == GLEW_ERROR_NO_GLX_DISPLAY ||
         glew_code == GLEW_ERROR_GLX_VERSION_11_ONLY;
}

// Draws one colour into a small buffer with the gl* names that VTK uses and reads it back. Fails
// when they do not reach the context that is current.
Status CheckGlReachesContext() {
  constexpr std::array<unsigned char, 4> kWanted{51, 102, 153, 255};
  GLuint buffer = 0, framebuffer = 0;
  glGenRenderbuffers(1, &buffer);
  glBindRenderbuffer(GL_RENDERBUFFER, buffer);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 1, 1);
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer);
  glClearColor(0.2F, 0.4F, 0.6F, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  std::array<unsigned char, 4> found{};
  glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, found.data());
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteRenderbuffers(1, &buffer);
  if (found == kWanted && glGetError() == GL_NO_ERROR) return {};
  return OutputFailed(
      "off-screen rendering: OpenGL calls do not reach the context; libOSMesa and libEGL_mesa must "
      "come from the same Mesa (Debian packages libosmesa6, libegl-mesa0)");
}

}  // namespace

vtkStandardNewMacro(OffscreenWindow);

OffscreenWindow::OffscreenWindow() {
  SetShowWindow(false);
  SetUseOffScreenBuffers(true);
  SetFrameBlitModeToNoBlit();  // there is no default framebuffer to copy to
  SetScreenSize(kMostSide_px, kMostSide_px);
}

OffscreenWindow::~OffscreenWindow() { OffscreenWindow::Finalize(); }

void OffscreenWindow::RegisterFactory() {
  static std::once_flag once;
  std::call_once(once, [] {
    vtkObjectFactory::SetAllEnableFlags(0, "vtkRenderWindow", "vtkXOpenGLRenderWindow");
    vtkObjectFactory::SetAllEnableFlags(0, "vtkRenderWindowInteractor",
                                        "vtkXRenderWindowInteractor");
    vtkNew<OffscreenFactory> factory;
    vtkObjectFactory::RegisterFactory(factory);
  });
}

Status OffscreenWindow::Open(GlBackend backend) {
  if (Initialized) return {};
  TELESTRAIN_ASSIGN_OR_RETURN(context_, MakeGlContext(backend));
  OpenGLInit();
  if (!Initialized)
    return OutputFailed("off-screen rendering: OpenGL 3.2 or newer could not be initialised");
  const char* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  if (renderer == nullptr || std::strstr(renderer, "llvmpipe") == nullptr)
    return OutputFailed("off-screen rendering: Mesa's llvmpipe is wanted, found '" +
                        std::string(renderer != nullptr ? renderer : "nothing") +
                        "'; unset GALLIUM_DRIVER");
  return CheckGlReachesContext();
}

void OffscreenWindow::Release() {
  if (IsCurrent()) context_->Release();
}

// VTK's way in, for windows that it made itself through the factory.
void OffscreenWindow::Initialize() {
  if (const Status opened = Open(GlBackend::kOsMesa); !opened)
    throw std::runtime_error(opened.error().message);
}

void OffscreenWindow::OpenGLInit() { vtkOpenGLRenderWindow::OpenGLInit(); }

void OffscreenWindow::OpenGLInitContext() {
  ContextCreationTime.Modified();
  if (Initialized) return;
  GlewInitValid = IsUsable(glewInit());
  if (!GlewInitValid || !GLEW_VERSION_3_2) return;
  Initialized = true;
  GLfloat range[2] = {1, 1};
  glGetFloatv(LineSmoothing ? GL_SMOOTH_LINE_WIDTH_RANGE : GL_ALIASED_LINE_WIDTH_RANGE, range);
  MaximumHardwareLineWidth = glGetError() == GL_NO_ERROR ? range[1] : 1.0F;
}

void OffscreenWindow::Render() {
  Initialize();
  vtkOpenGLRenderWindow::Render();
}

void OffscreenWindow::MakeCurrent() {
  if (context_ && !context_->IsCurrent() && !context_->MakeCurrent())
    throw std::runtime_error("off-screen rendering: the context cannot be made current");
}

bool OffscreenWindow::IsCurrent() { return context_ && context_->IsCurrent(); }

void* OffscreenWindow::GetGenericContext() { return context_ ? context_->Handle() : nullptr; }

void OffscreenWindow::Finalize() {
  if (!context_) return;
  if (context_->MakeCurrent()) ReleaseGraphicsResources(this);
  context_.reset();
  Initialized = false;
}

}  // namespace telestrain::viz
