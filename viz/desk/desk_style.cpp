#include "viz/desk/desk_style.h"

#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include "viz/desk/desk_control.h"

namespace telestrain::viz {
namespace {

class DeskStyle : public vtkInteractorStyleTrackballCamera {
 public:
  static DeskStyle* New();
  vtkTypeMacro(DeskStyle, vtkInteractorStyleTrackballCamera)

      void OnChar() override {}  // VTK's own keys would do other things
  void OnKeyPress() override {
    const char* symbol = GetInteractor()->GetKeySym();
    const std::string key = symbol == nullptr ? "" : symbol;
    if (key == "q" || key == "Q" || key == "Escape")
      GetInteractor()->TerminateApp();
    else
      control_->Key(key);
  }
  void OnLeftButtonDown() override {
    pressed_ = true;
    if (!control_->Press(Pixel())) vtkInteractorStyleTrackballCamera::OnLeftButtonDown();
  }
  void OnLeftButtonUp() override {
    pressed_ = false;
    vtkInteractorStyleTrackballCamera::OnLeftButtonUp();
    control_->Release(Pixel());
  }
  void OnMouseMove() override {
    vtkInteractorStyleTrackballCamera::OnMouseMove();
    control_->Move(Pixel(), pressed_ || GetState() != VTKIS_NONE);
  }

  DeskControl* control_ = nullptr;

 private:
  Eigen::Vector2d Pixel() {
    const int* position = GetInteractor()->GetEventPosition();
    return {double(position[0]), double(position[1])};
  }
  bool pressed_ = false;
};
vtkStandardNewMacro(DeskStyle);

}  // namespace

vtkSmartPointer<vtkRenderWindowInteractor> MakeInteractor(DeskWindow* window,
                                                          DeskControl* control) {
  auto interactor = vtkSmartPointer<vtkRenderWindowInteractor>::New();
  vtkNew<DeskStyle> style;
  style->control_ = control;
  interactor->SetInteractorStyle(style);
  interactor->SetRenderWindow(window->window());
  interactor->Initialize();
  return interactor;
}

}  // namespace telestrain::viz
