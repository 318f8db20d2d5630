// What a DeskWindow draws flat: the panel, and names, scale bar, help and the picked point above
// the scene.
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/numbers.h"
#include "viz/desk/desk_window.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene/scene_parts.h"

namespace telestrain::viz {
namespace {

constexpr Rgb kPaper{1, 1, 1}, kFaint{0.38, 0.41, 0.45}, kMark{0.85, 0.10, 0.10};
const FlatText kText{9}, kHint{9, false, kFaint}, kNameText{10, true};

constexpr std::array<std::array<const char*, 2>, 11> kHelp = {{
    {"drag", "turn; with Shift or the middle button: move; wheel or right button: zoom"},
    {"click", "keep what the panel tells; click on nothing: let it go"},
    {"1 2 3 4", "the array, from the side, from the top, the pipe without the views"},
    {"\u2190 \u2192", "the state before, the next state"},
    {"\u2191 \u2193", "the quantity before, the next quantity"},
    {"C", "colours over all states, or over this state alone"},
    {"V O B R P", "views, optics, boards, rulers, nominal pipe"},
    {"M D G U F", "measured surface, displacements, gauges, uncertainty, frame"},
    {"S", "save the window as PNG in the working folder"},
    {"H", "this help"},
    {"Q", "quit"},
}};

bool Overlap(const PixelBox& a, const PixelBox& b) {
  return a.left < b.Right() && b.left < a.Right() && a.bottom < b.Top() && b.bottom < a.Top();
}

// A line on a paper-coloured strip, so that it can be read above anything.
void AddStrip(const std::string& text, const Eigen::Vector2d& at, const FlatText& style,
              FlatSheet* sheet) {
  const double width = sheet->TextSize(text, style).x();
  sheet->Shapes().AddBox({at.x() - sheet->Px(2), at.y() - sheet->Px(1), width + sheet->Px(4),
                          sheet->LineHeight(style)},
                         kPaper, 0.8);
  sheet->AddText(text, at, style);
}

}  // namespace

void DeskWindow::DrawFlat() {
  const PixelBox scene = SceneBox(), panel = PanelBox();
  scene_->SetViewport(0, 0, scene.width / (scene.width + panel.width), 1);
  scene_->ResetCameraClippingRange();
  const DeskCamera camera = Camera();
  scene_sheet_->Clear();
  if (!help_) DrawNames(camera);  // it would stand among them
  DrawScaleBar(camera);
  DrawPick(camera);
  DrawHelp();
  scene_sheet_->Show();
  PanelContent content;
  if (pick_) {
    content.picked_title = model_->parts()[pick_->part].name + (kept_ ? " (kept)" : "");
    content.facts = FactsOf(*model_, *pick_);
  }
  panel_sheet_->Clear();
  hot_areas_ = DrawPanel(*model_, content, panel, panel_sheet_.get());
  panel_sheet_->Show();
}

void DeskWindow::DrawNames(const DeskCamera& camera) {
  std::vector<PixelBox> taken;
  const auto add = [&](const std::string& name, const Eigen::Vector3d& at, const Rgb& color) {
    FlatText style = kNameText;
    style.color = color;
    const Eigen::Vector2d size = scene_sheet_->TextSize(name, style);
    const Eigen::Vector2d left = camera.PixelOf(at) - 0.5 * size;
    if (left.x() < 0 || left.x() + size.x() > camera.box.width) return;
    PixelBox box = PixelBox{left.x(), left.y(), size.x(), size.y()}.Grown(Px(2));
    // What stands behind another name moves up until both can be read.
    const auto hidden = [&] {
      return std::find_if(taken.begin(), taken.end(),
                          [&](const PixelBox& other) { return Overlap(box, other); });
    };
    for (auto other = hidden(); other != taken.end(); other = hidden())
      box.bottom = other->Top() + 1;
    taken.push_back(box);
    AddStrip(name, {left.x(), box.bottom + Px(2)}, style, scene_sheet_.get());
  };
  const Scene& scene = model_->scene();
  if (model_->Shows(Layer::kViews))
    for (std::size_t i = 0; i < scene.views.size(); ++i)
      add(scene.views[i].name, TopOf(scene, scene.views[i]), ColorOfView(scene, i));
  if (model_->Shows(Layer::kGauges) && scene.pipe)
    for (const Gauge& gauge : scene.pipe->gauges)
      add(gauge.name,
          gauge.center_in_array_mm + 0.35 * scene.pipe->radius_mm * gauge.outward_in_array,
          kGaugeColor);
  if (!model_->Shows(Layer::kFrame)) return;
  for (const Part& part : model_->parts())
    if (part.name.starts_with("array axis ") && !part.mesh.points_in_array_mm.empty()) {
      const Eigen::Vector3d& tip = part.mesh.points_in_array_mm.back();
      add(part.name.substr(part.name.size() - 1), 1.12 * tip, part.color);
    }
}

// A round length of about a sixth of the scene's width, at its lower left.
void DeskWindow::DrawScaleBar(const DeskCamera& camera) {
  const double length_mm = RoundDown(camera.box.width / 6 / camera.PixelsPerMm());
  const double length_px = length_mm * camera.PixelsPerMm(), left = Px(12), bottom = Px(24);
  Overlay& shapes = scene_sheet_->Shapes();
  shapes.AddBox({left, bottom, length_px, Px(1.5)}, kInk);
  for (const double x : {left, left + length_px - 1})
    shapes.AddBox({x, bottom - Px(2), 1, Px(5.5)}, kInk);
  AddStrip(FormatShortest(length_mm) + " mm", {left, bottom + Px(4)}, kText, scene_sheet_.get());
  if (model_->Shows(Layer::kDisplacements) && model_->States() > 0 &&
      model_->Has(Layer::kDisplacements))
    AddStrip("arrows: displacement \u00d7 " + FormatShortest(model_->displacement_factor()),
             {left + length_px + Px(10), bottom - Px(2)}, kText, scene_sheet_.get());
}

void DeskWindow::DrawPick(const DeskCamera& camera) {
  if (!pick_) return;
  const Eigen::Vector2d at = camera.PixelOf(pick_->point_in_array_mm);
  if (at.x() > camera.box.Right()) return;
  Overlay& shapes = scene_sheet_->Shapes();
  const double arm = Px(kept_ ? 6 : 4.5), gap = Px(1.5);
  for (const auto& [color, width] : {std::pair{kPaper, Px(2.2)}, std::pair{kMark, Px(1)}})
    for (const Eigen::Vector2d& way : {Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0),
                                       Eigen::Vector2d(0, 1), Eigen::Vector2d(0, -1)})
      shapes.AddLine(at + gap * way, at + arm * way, color, width);
}

void DeskWindow::DrawHelp() {
  const std::string hint = message_.empty() ? "H help   1\u20134 views   \u2190 \u2192 states   "
                                              "\u2191 \u2193 quantities   S save   Q quit"
                                            : message_;
  AddStrip(scene_sheet_->Fitted(hint, kHint, SceneBox().width - Px(24)), {Px(12), Px(5)}, kHint,
           scene_sheet_.get());
  if (!help_) return;
  const double line = 1.15 * scene_sheet_->LineHeight(kText), indent = Px(64);
  double width = 0;
  for (const auto& [keys, what] : kHelp)
    width = std::max(width, indent + scene_sheet_->TextSize(what, kText).x());
  const double height = line * kHelp.size();
  const PixelBox box{Px(12), SceneBox().Top() - Px(20) - height, width + Px(16), height + Px(10)};
  scene_sheet_->Shapes().AddBox(box, kPaper, 0.93);
  scene_sheet_->Shapes().AddFrame(box, kFaint, 1);
  double bottom = box.Top() - Px(5);
  for (const auto& [keys, what] : kHelp) {
    bottom -= line;
    scene_sheet_->AddText(keys, {box.left + Px(8), bottom}, {9, true});
    scene_sheet_->AddText(what, {box.left + Px(8) + indent, bottom}, kText);
  }
}

}  // namespace telestrain::viz
