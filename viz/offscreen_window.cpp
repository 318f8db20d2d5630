#include "viz/offscreen_window.h"

#include <vtkGenericRenderWindowInteractor.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkVersion.h>
#include <vtk_glew.h>

#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>

#include "viz/osmesa_context.h"

namespace telestrain::viz {
namespace {

// Mesa's llvmpipe takes pictures up to this side; beyond it they turn black without an error.
constexpr int kLargestSide_px = 16384;

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

}  // namespace

vtkStandardNewMacro(OffscreenWindow);

OffscreenWindow::OffscreenWindow() {
  SetShowWindow(false);
  SetUseOffScreenBuffers(true);
  SetFrameBlitModeToNoBlit();  // there is no default framebuffer to copy to
  SetScreenSize(kLargestSide_px, kLargestSide_px);
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

Status OffscreenWindow::Open() {
  if (Initialized) return {};
  TELESTRAIN_ASSIGN_OR_RETURN(context_, OsMesaContext::Create());
  OpenGLInit();
  if (!Initialized)
    return OutputFailed("off-screen rendering: OpenGL 3.2 or newer could not be initialised");
  const char* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  if (renderer == nullptr || std::strstr(renderer, "llvmpipe") == nullptr)
    return OutputFailed("off-screen rendering: Mesa's llvmpipe is wanted, found '" +
                        std::string(renderer != nullptr ? renderer : "nothing") +
                        "'; unset GALLIUM_DRIVER");
  return {};
}

void OffscreenWindow::Initialize() {
  if (const Status opened = Open(); !opened) throw std::runtime_error(opened.error().message);
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
