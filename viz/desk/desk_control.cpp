#include "viz/desk/desk_control.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "base/files.h"
#include "viz/png_bytes.h"

namespace telestrain::viz {
namespace {

constexpr double kClick_pt = 2, kReach_pt = 2;  // how far a click may slip, how near a line is met

bool Contains(const PixelBox& box, const Eigen::Vector2d& pixel) {
  return pixel.x() >= box.left && pixel.x() < box.Right() && pixel.y() >= box.bottom &&
         pixel.y() < box.Top();
}

// Makes an empty file; false when the name is taken.
bool Reserve(const std::filesystem::path& path) {
  std::FILE* file = std::fopen(path.c_str(), "wx");
  if (file == nullptr) return false;
  std::fclose(file);
  return true;
}

}  // namespace

DeskControl::DeskControl(DeskModel* model, DeskWindow* window, std::filesystem::path folder)
    : model_(model), window_(window), folder_(std::move(folder)) {}

bool DeskControl::Key(const std::string& symbol) {
  window_->Say("");
  const char key = symbol.size() == 1 ? static_cast<char>(std::tolower(symbol[0])) : '\0';
  if (key >= '1' && key <= '4') {
    model_->ArrangeFor(static_cast<StandardView>(key - '0'));
    window_->LookFrom(static_cast<StandardView>(key - '0'));
  } else if (symbol == "Left" || symbol == "Right") {
    model_->StepState(symbol == "Left" ? -1 : 1);
  } else if (symbol == "Up" || symbol == "Down") {
    model_->StepQuantity(symbol == "Up" ? -1 : 1);
  } else if (key == 'c') {
    model_->ToggleRange();
  } else if (key == 'h') {
    window_->ToggleHelp();
  } else if (key == 's') {
    Save();
  } else if (!ActOnLayer(key)) {
    return false;
  }
  Changed();
  return true;
}

bool DeskControl::ActOnLayer(char key) {
  for (const Layer layer : kAllLayers)
    if (KeyOf(layer) == key) {
      if (!model_->Has(layer)) window_->Say("the results hold nothing for '" + NameOf(layer) + "'");
      model_->Toggle(layer);
      return true;
    }
  return false;
}

void DeskControl::Changed() {
  // What is no longer to be seen is no longer told of.
  if (pick_ && !model_->IsVisible(model_->parts()[pick_->part])) {
    pick_.reset();
    kept_ = false;
  }
  window_->Update();
  window_->Tell(pick_, kept_);
  window_->Render();
}

void DeskControl::Act(const HotArea& area) {
  if (area.action == DeskAction::kToggleLayer) model_->Toggle(static_cast<Layer>(area.argument));
  if (area.action == DeskAction::kShowState) model_->ShowState(area.argument);
  if (area.action == DeskAction::kStepQuantity) model_->StepQuantity(area.argument);
  on_slider_ = area.action == DeskAction::kShowState;
  Changed();
}

bool DeskControl::Press(const Eigen::Vector2d& pixel) {
  pressed_at_ = pixel;
  window_->Say("");
  in_panel_ = Contains(window_->PanelBox(), pixel);
  if (!in_panel_) return false;
  const auto areas = window_->hot_areas();
  const auto area = std::find_if(areas.begin(), areas.end(),
                                 [&](const HotArea& a) { return Contains(a.box, pixel); });
  if (area != areas.end()) Act(*area);
  return true;
}

void DeskControl::DragSlider(const Eigen::Vector2d& pixel) {
  int nearest = static_cast<int>(model_->shown()->state);
  double nearest_px = std::numeric_limits<double>::infinity();
  for (const HotArea& area : window_->hot_areas()) {
    const double off_px = std::abs(area.box.left + 0.5 * area.box.width - pixel.x());
    if (area.action != DeskAction::kShowState || off_px >= nearest_px) continue;
    nearest_px = off_px;
    nearest = area.argument;
  }
  if (nearest == static_cast<int>(model_->shown()->state)) return;
  model_->ShowState(nearest);
  Changed();
}

void DeskControl::Release(const Eigen::Vector2d& pixel) {
  const bool clicked = (pixel - pressed_at_).norm() <= window_->Px(kClick_pt);
  on_slider_ = false;
  if (in_panel_ || !clicked) return;
  pick_ = PickUnder(pixel);
  kept_ = pick_.has_value();
  Changed();
}

std::optional<Pick> DeskControl::PickUnder(const Eigen::Vector2d& pixel) const {
  const DeskCamera camera = window_->Camera();
  if (!Contains(camera.box, pixel)) return std::nullopt;
  return PickAt(*model_, camera.SightLineAt(pixel), window_->Px(kReach_pt) / camera.PixelsPerMm());
}

void DeskControl::Move(const Eigen::Vector2d& pixel, bool dragging) {
  if (dragging && on_slider_) DragSlider(pixel);
  if (dragging || kept_) return;
  const std::optional<Pick> under = PickUnder(pixel);
  if (under == pick_) return;  // drawing takes longer than looking
  pick_ = under;
  Changed();
}

void DeskControl::Save() {
  const auto image = window_->Grab();
  if (!image) return window_->Say(image.error().message);
  const auto png = PngBytes(*image);
  if (!png) return window_->Say(png.error().message);
  const auto path = WriteNew(folder_, PictureName(*model_), *png);
  window_->Say(path ? "saved " + path->string() : path.error().message);
}

std::string PictureName(const DeskModel& model) {
  if (!model.shown()) return "telestrain_scene.png";
  return "telestrain_state_" + std::to_string(model.shown()->state) + "_" +
         model.shown()->quantity.key + ".png";
}

Result<std::filesystem::path> WriteNew(const std::filesystem::path& folder, const std::string& name,
                                       const std::string& bytes) {
  const std::filesystem::path wanted = folder / name;
  std::filesystem::path path = wanted;
  std::error_code code;
  for (int number = 2; !Reserve(path); ++number) {
    if (!std::filesystem::exists(path, code))  // not taken, but not to be made either
      return OutputFailed(path.string() +
                          ": cannot be written; start the program in a folder "
                          "that can be written to");
    path = folder /
           (wanted.stem().string() + "_" + std::to_string(number) + wanted.extension().string());
  }
  const Status written = WriteFileAtomically(path, bytes);
  if (written) return path;
  std::filesystem::remove(path, code);  // what was reserved
  return written.error();
}

}  // namespace telestrain::viz
