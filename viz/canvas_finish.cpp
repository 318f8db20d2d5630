#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <numbers>

#include "viz/canvas.h"
#include "viz/label_layout.h"
#include "viz/matte.h"
#include "viz/offscreen_window.h"

namespace telestrain::viz {
namespace {

// 1 where the picture is not white, rows from the bottom.
std::vector<std::uint8_t> TakenPixels(const RgbImage& image) {
  std::vector<std::uint8_t> taken(image.rgb.size() / 3);
  const auto width = static_cast<std::size_t>(image.width_px);
  const auto height = static_cast<std::size_t>(image.height_px);
  constexpr int kWhite = 3 * 252;  // fainter than this nobody sees
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint8_t* rgb = &image.rgb[3 * ((height - 1 - y) * width + x)];
      taken[y * width + x] = rgb[0] + rgb[1] + rgb[2] < kWhite ? 1 : 0;
    }
  return taken;
}

}  // namespace

void Canvas::AddLeader(const Eigen::Vector2d& anchor_px, const PixelBox& text) {
  const double gap_px = Px(1.5);
  const PixelBox near = text.Grown(gap_px);
  const Eigen::Vector2d end(std::clamp(anchor_px.x(), near.left, near.Right()),
                            std::clamp(anchor_px.y(), near.bottom, near.Top()));
  if ((end - anchor_px).norm() < Px(3)) return;
  leaders_->AddLine(anchor_px, end, {0.35, 0.38, 0.42}, Px(0.5));
}

void Canvas::AddLabel(const std::string& panel, const Label& label) {
  labels_.emplace_back(panel, label);
}

Status Canvas::PlaceLabels(const RgbImage& image) {
  const Occupancy occupancy(image.width_px, image.height_px, TakenPixels(image));
  std::vector<PixelBox> placed;
  for (const auto& [panel, label] : labels_) {
    LabelRequest request;
    request.anchor_px = DisplayOf(panel, label.anchor_in_array_mm);
    request.size_px = TextSize(label.text, label.style);
    request.preferred_rad = label.preferred_deg * std::numbers::pi / 180;
    request.clearance_px = Px(1.5);
    request.leader = label.leader;
    request.straight_px = (label.leader ? 3.0 : 2.0) * request.size_px.y();
    const auto box = PlaceLabel(request, Find(panel).box, occupancy, placed);
    if (!box)
      return OutputFailed("pictures: no room for the label '" + label.text +
                          "'; render a larger picture");
    placed.push_back(box->Grown(request.clearance_px));
    AddText(label.text, {box->left, box->bottom}, label.style, label_layer_);
    if (!label.leader) continue;
    AddLeader(request.anchor_px, *box);
    for (const PixelBox& part : LeaderBoxes(request.anchor_px, *box, request.clearance_px))
      placed.push_back(part);
  }
  return {};
}

Result<RgbImage> Canvas::Grab() {
  window_->Render();
  RgbImage image{options_.width_px, options_.height_px, dots_per_inch_, {}, {}};
  vtkNew<vtkUnsignedCharArray> pixels;
  window_->GetPixelData(0, 0, image.width_px - 1, image.height_px - 1, 0, pixels, 0);
  if (const std::string problem = messages_.FirstError(); !problem.empty())
    return OutputFailed("pictures: rendering failed: " + problem);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(image.width_px);
  const std::size_t bytes = row_bytes * static_cast<std::size_t>(image.height_px);
  if (static_cast<std::size_t>(pixels->GetNumberOfValues()) != bytes)
    return OutputFailed("pictures: rendering gave no pixels; is there enough memory?");
  image.rgb.resize(bytes);
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height_px); ++y)
    std::copy_n(pixels->GetPointer(0) + bytes - (y + 1) * row_bytes, row_bytes,
                image.rgb.begin() + static_cast<std::ptrdiff_t>(y * row_bytes));
  return image;
}

// What is drawn already stays, the labels come on top.
Result<RgbImage> Canvas::GrabWithLabels() {
  std::vector<vtkRenderer*> drawn{paper_, flat_};
  for (const PanelState& state : panels_) drawn.push_back(state.renderer);
  for (vtkRenderer* renderer : drawn) renderer->DrawOff();
  auto image = Grab();
  for (vtkRenderer* renderer : drawn) renderer->DrawOn();
  return image;
}

Result<RgbImage> Canvas::GrabOnBlack() {
  std::vector<vtkRenderer*> backgrounds{paper_};
  for (const PanelState& state : panels_) backgrounds.push_back(state.renderer);
  for (vtkRenderer* renderer : backgrounds) renderer->SetBackground(0, 0, 0);
  auto image = Grab();
  for (vtkRenderer* renderer : backgrounds) renderer->SetBackground(1, 1, 1);
  return image;
}

Result<Picture> Canvas::Finish() {
  Picture picture;
  TELESTRAIN_ASSIGN_OR_RETURN(picture.image, Grab());
  if (!labels_.empty()) {
    TELESTRAIN_RETURN_IF_ERROR(PlaceLabels(picture.image));
    TELESTRAIN_ASSIGN_OR_RETURN(picture.image, GrabWithLabels());
    labels_.clear();
  }
  if (options_.transparent) {
    TELESTRAIN_ASSIGN_OR_RETURN(const RgbImage on_black, GrabOnBlack());
    picture.image = Matte(std::move(picture.image), on_black);
  }
  for (const PanelState& state : panels_) {
    Panel panel = state.panel;
    // From VTK's display (edges between pixels, y up) to pixels (centres, y down).
    panel.pixel_from_array.row(1) *= -1;
    panel.pixel_from_array.col(3) += Eigen::Vector2d(-0.5, Height() - 0.5);
    picture.panels.push_back(panel);
  }
  picture.texts = texts_;
  return picture;
}

}  // namespace telestrain::viz
