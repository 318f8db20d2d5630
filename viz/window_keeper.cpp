#include "viz/window_keeper.h"

#include <map>

#include "viz/vtk_messages.h"

namespace telestrain::viz {
namespace {

// Guarded by the right to use VTK.
struct KeptWindows {
  int keepers = 0;
  std::map<GlBackend, vtkSmartPointer<OffscreenWindow>> windows;
};

KeptWindows& Kept() {
  static KeptWindows kept;
  return kept;
}

}  // namespace

WindowKeeper::WindowKeeper() {
  const VtkMessages lock;
  ++Kept().keepers;
}

WindowKeeper::~WindowKeeper() {
  const VtkMessages lock;
  if (--Kept().keepers == 0) Kept().windows.clear();
}

Result<vtkSmartPointer<OffscreenWindow>> TakeWindow(GlBackend backend) {
  const auto found = Kept().windows.find(backend);
  if (found != Kept().windows.end()) {
    found->second->MakeCurrent();
    return found->second;
  }
  OffscreenWindow::RegisterFactory();
  auto window = vtkSmartPointer<OffscreenWindow>::New();
  TELESTRAIN_RETURN_IF_ERROR(window->Open(backend));
  if (Kept().keepers > 0) Kept().windows[backend] = window;
  return window;
}

}  // namespace telestrain::viz
