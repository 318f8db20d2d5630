#pragma once

#include <vtkSmartPointer.h>

#include <memory>
#include <string>
#include <vector>

#include "viz/font_files.h"
#include "viz/overlay.h"
#include "viz/pictures.h"

class vtkRenderer;
class vtkTextActor;
class vtkTextProperty;

namespace telestrain::viz {

struct FlatText {
  double size_pt = 9;
  bool bold = false;
  Rgb color{0.13, 0.15, 0.18};
};

// Shapes and, above them, texts in a window, px from its lower left corner.
class FlatSheet {
 public:
  // `dots_per_inch` of the window makes points of text into px.
  FlatSheet(vtkRenderer* renderer, FontFiles fonts, int dots_per_inch);

  void Clear();
  void Show();  // what was added since Clear
  Overlay& Shapes() { return *shapes_; }
  Eigen::Vector2d TextSize(const std::string& text, const FlatText& style) const;
  // From the ascent of a capital to the descent of a g, the same for every text.
  double LineHeight(const FlatText& style) const;
  void AddText(const std::string& text, const Eigen::Vector2d& lower_left, const FlatText& style);
  // Shortened to the width with an ellipsis where it does not fit.
  std::string Fitted(const std::string& text, const FlatText& style, double width_px) const;

  // `points` of 1/72 inch in px.
  double Px(double points) const { return points * dots_per_inch_ / 72; }
  const std::vector<PlacedText>& texts() const { return texts_; }

 private:
  vtkSmartPointer<vtkTextProperty> PropertyOf(const FlatText& style) const;

  vtkRenderer* renderer_;
  FontFiles fonts_;
  int dots_per_inch_;
  std::unique_ptr<Overlay> shapes_;
  std::vector<vtkSmartPointer<vtkTextActor>> text_actors_;
  std::vector<PlacedText> texts_;
};

}  // namespace telestrain::viz
