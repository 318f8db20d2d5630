#pragma once

#include <vtkSmartPointer.h>

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "viz/desk/desk_camera.h"
#include "viz/desk/desk_panel.h"
#include "viz/desk/pick.h"
#include "viz/part_actors.h"

class vtkCallbackCommand;
class vtkRenderWindow;

namespace telestrain::viz {

// A window on the screen: the scene, the panel beside it, names, scale bar and help above it.
// Everything flat is drawn anew for every frame, so that it follows the camera and the size.
class DeskWindow {
 public:
  // Fails (kOutputFailed) without an X server with OpenGL or without the fonts. `model` must
  // outlive the window.
  static Result<std::unique_ptr<DeskWindow>> Open(const DeskModel* model, int width_px,
                                                  int height_px);
  ~DeskWindow();
  DeskWindow(const DeskWindow&) = delete;
  DeskWindow& operator=(const DeskWindow&) = delete;

  void Update();  // after a change of the model; does not draw
  void LookFrom(StandardView view);
  void Render();
  // What was drawn last, the first row on top. Fails (kOutputFailed) with VTK's message.
  Result<RgbImage> Grab();

  DeskCamera Camera() const;
  PixelBox SceneBox() const;
  PixelBox PanelBox() const;
  const std::vector<HotArea>& hot_areas() const { return hot_areas_; }
  std::vector<PlacedText> Texts() const;  // of the last frame
  double Px(double points) const { return panel_sheet_->Px(points); }

  // What the panel tells of; drawn with the next frame.
  void Tell(const std::optional<Pick>& pick, bool kept);
  void Say(const std::string& message) { message_ = message; }  // below the scene
  void ToggleHelp() { help_ = !help_; }

  vtkRenderWindow* window() const;

 private:
  explicit DeskWindow(const DeskModel* model);
  Status Make(int width_px, int height_px);
  void DrawFlat();
  void DrawNames(const DeskCamera& camera);
  void DrawScaleBar(const DeskCamera& camera);
  void DrawPick(const DeskCamera& camera);
  void DrawHelp();

  const DeskModel* model_;
  std::shared_ptr<void> display_;
  vtkSmartPointer<vtkRenderWindow> window_;
  vtkSmartPointer<vtkRenderer> scene_, flat_;
  vtkSmartPointer<vtkCallbackCommand> before_frame_;
  std::unique_ptr<FlatSheet> panel_sheet_, scene_sheet_;
  std::vector<std::vector<vtkSmartPointer<vtkActor>>> actors_;  // by part
  std::string colored_by_;                                      // quantity and range of `actors_`
  std::vector<HotArea> hot_areas_;
  std::optional<Pick> pick_;
  bool kept_ = false, help_ = false;
  std::string message_;
};

}  // namespace telestrain::viz
