#include "viz/desk/flat_sheet.h"

#include <vtkActor2D.h>
#include <vtkRenderer.h>
#include <vtkStdString.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <cmath>

namespace telestrain::viz {

FlatSheet::FlatSheet(vtkRenderer* renderer, FontFiles fonts, int dots_per_inch)
    : renderer_(renderer),
      fonts_(std::move(fonts)),
      dots_per_inch_(dots_per_inch),
      shapes_(std::make_unique<Overlay>()) {}

void FlatSheet::Clear() {
  renderer_->RemoveActor2D(shapes_->Actor());
  for (const auto& actor : text_actors_) renderer_->RemoveActor2D(actor);
  shapes_ = std::make_unique<Overlay>();
  text_actors_.clear();
  texts_.clear();
}

void FlatSheet::Show() {
  renderer_->AddActor2D(shapes_->Actor());
  for (const auto& actor : text_actors_) renderer_->AddActor2D(actor);
}

vtkSmartPointer<vtkTextProperty> FlatSheet::PropertyOf(const FlatText& style) const {
  auto property = vtkSmartPointer<vtkTextProperty>::New();
  property->SetFontFamily(VTK_FONT_FILE);
  property->SetFontFile((style.bold ? fonts_.bold : fonts_.regular).c_str());
  property->SetFontSize(static_cast<int>(std::lround(style.size_pt)));
  property->SetColor(style.color.r, style.color.g, style.color.b);
  property->SetJustificationToLeft();
  property->SetVerticalJustificationToBottom();
  return property;
}

Eigen::Vector2d FlatSheet::TextSize(const std::string& text, const FlatText& style) const {
  int box[4] = {0, 0, 0, 0};
  vtkTextRenderer::GetInstance()->GetBoundingBox(PropertyOf(style), text, box, dots_per_inch_);
  return {box[1] - box[0] + 1.0, box[3] - box[2] + 1.0};
}

double FlatSheet::LineHeight(const FlatText& style) const {
  return std::ceil(Px(1.4 * style.size_pt));
}

void FlatSheet::AddText(const std::string& text, const Eigen::Vector2d& lower_left,
                        const FlatText& style) {
  if (text.empty()) return;
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(text.c_str());
  actor->GetTextProperty()->ShallowCopy(PropertyOf(style));
  actor->SetTextScaleModeToNone();
  actor->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  const double left = std::round(lower_left.x()), bottom = std::round(lower_left.y());
  actor->SetPosition(left, bottom);
  text_actors_.push_back(actor);
  const Eigen::Vector2d size = TextSize(text, style);
  texts_.push_back({text, style.size_pt, {left, bottom, size.x(), size.y()}});
}

std::string FlatSheet::Fitted(const std::string& text, const FlatText& style,
                              double width_px) const {
  if (TextSize(text, style).x() <= width_px) return text;
  std::string shorter = text;
  while (!shorter.empty()) {
    // Whole characters of UTF-8: continuation bytes are 10xxxxxx.
    while (!shorter.empty() && (static_cast<unsigned char>(shorter.back()) & 0xC0) == 0x80)
      shorter.pop_back();
    if (!shorter.empty()) shorter.pop_back();
    if (TextSize(shorter + "\u2026", style).x() <= width_px) break;
  }
  return shorter + "\u2026";
}

}  // namespace telestrain::viz
