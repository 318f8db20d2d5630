#pragma once

#include <vtkSmartPointer.h>

class vtkRenderWindowInteractor;

namespace telestrain::viz {

class DeskControl;
class DeskWindow;

// The window's interactor with VTK's trackball for the scene and the control for all else: keys,
// clicks, the panel. Not yet started; Start() returns when the user quits. The control must outlive
// it.
vtkSmartPointer<vtkRenderWindowInteractor> MakeInteractor(DeskWindow* window, DeskControl* control);

}  // namespace telestrain::viz
