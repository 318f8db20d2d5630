#pragma once

#include <filesystem>
#include <string>

#include "viz/desk/desk_window.h"

namespace telestrain::viz {

// What keys and the mouse do to a DeskModel and its DeskWindow. Pixels from the window's lower left
// corner. Every change draws the window again.
class DeskControl {
 public:
  // Saved pictures go to `folder`. `model` is the window's.
  DeskControl(DeskModel* model, DeskWindow* window, std::filesystem::path folder);

  // A key by its X name: "1", "Left", "v", "V". False for keys without a meaning.
  bool Key(const std::string& symbol);
  // The left button. Press returns true when it is in the panel: then the scene must not turn.
  bool Press(const Eigen::Vector2d& pixel);
  void Release(const Eigen::Vector2d& pixel);
  // The mouse moved; `dragging`: with a button pressed.
  void Move(const Eigen::Vector2d& pixel, bool dragging);

  const std::optional<Pick>& pick() const { return pick_; }

 private:
  bool ActOnLayer(char key);
  void Act(const HotArea& area);
  void Save();
  void Changed();  // of the model
  std::optional<Pick> PickUnder(const Eigen::Vector2d& pixel) const;
  void DragSlider(const Eigen::Vector2d& pixel);

  DeskModel* model_;
  DeskWindow* window_;
  std::filesystem::path folder_;
  std::optional<Pick> pick_;
  bool kept_ = false;
  bool on_slider_ = false, in_panel_ = false;
  Eigen::Vector2d pressed_at_ = Eigen::Vector2d::Zero();
};

// "telestrain_state_3_axial_microstrain.png", or "telestrain_scene.png" without a pipe.
std::string PictureName(const DeskModel& model);
// Writes under that name, or with _2, _3, … before the dot when it is taken: nothing is ever
// overwritten. Returns the path; fails (kOutputFailed) as WriteFileAtomically does.
Result<std::filesystem::path> WriteNew(const std::filesystem::path& folder, const std::string& name,
                                       const std::string& bytes);

}  // namespace telestrain::viz
