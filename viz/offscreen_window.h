#pragma once

#include <vtkGenericOpenGLRenderWindow.h>

#include <memory>

#include "base/result.h"
#include "viz/render.h"

namespace telestrain::viz {

class GlContext;

// A VTK render window without a screen, on Mesa's software rasteriser. Call Open() before anything
// else; VTK's own way into Initialize() cannot report a failure and throws std::runtime_error.
// Not thread-safe, and FreeType forbids two windows at work at once: hold a VtkMessages. A thread
// that is done with it calls Release(), so that another one may go on.
class OffscreenWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static OffscreenWindow* New();
  vtkTypeMacro(OffscreenWindow, vtkGenericOpenGLRenderWindow)
      OffscreenWindow(const OffscreenWindow&) = delete;
  OffscreenWindow& operator=(const OffscreenWindow&) = delete;

  // Makes vtkRenderWindow::New() yield this class and vtkRenderWindowInteractor::New() one without
  // a window, so that nothing inside VTK can reach for X. Repeated calls do nothing.
  static void RegisterFactory();

  // Makes the context and loads OpenGL; fails (kOutputFailed) with the reason.
  Status Open(GlBackend backend);
  // Leaves the context without a thread.
  void Release();

  void Initialize() override;
  void Finalize() override;
  void MakeCurrent() override;
  bool IsCurrent() override;
  int SupportsOpenGL() override { return 1; }
  vtkTypeBool IsDirect() override { return 0; }
  void* GetGenericContext() override;

  // The base class serves a context that someone else owns: it would initialise ahead of
  // MakeCurrent() and save and restore foreign state. This window owns its context.
  void Render() override;
  void OpenGLInit() override;
  // glewInit() fails in its last step, the GLX half, when every gl* entry point is already set;
  // that failure is accepted.
  void OpenGLInitContext() override;

 protected:
  OffscreenWindow();
  ~OffscreenWindow() override;

 private:
  std::unique_ptr<GlContext> context_;
};

}  // namespace telestrain::viz
