#pragma once

#include <array>
#include <vector>

#include "report/reading/page_drawing.h"

namespace telestrain {

// x' = a x + c y + e, y' = b x + d y + f, as the operator cm has them.
struct DrawingMatrix {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

  static DrawingMatrix Of(const std::vector<double>& n) {
    return {n[0], n[1], n[2], n[3], n[4], n[5]};
  }
  // What applies this one first.
  DrawingMatrix Then(const DrawingMatrix& next) const;
  std::array<double, 2> At(double x, double y) const {
    return {a * x + c * y + e, b * x + d * y + f};
  }
  bool IsUpright() const;   // no turn, no mirror
  bool KeepsBoxes() const;  // no turn
};

// The box about points.
DrawnBox BoxAbout(const std::vector<std::array<double, 2>>& points);

// What q keeps and Q brings back.
struct DrawingState {
  DrawingMatrix matrix;
  double fill_luminance = 0;
  double line_width_pt = 1;
  DrawnBox clip;              // nothing drawn outside is seen
  bool clip_is_exact = true;  // false: less is seen than in `clip`
};

// A path under construction.
class DrawnPath {
 public:
  void MoveTo(const std::array<double, 2>& at);
  void LineTo(const std::array<double, 2>& at);
  void Rectangle(const DrawnBox& box, bool keeps_box);

  bool IsOneBox() const { return is_one_box_; }
  const DrawnBox& box() const { return box_; }  // about all of it
  const std::vector<DrawnBox>& lines() const { return lines_; }

 private:
  void Add(const DrawnBox& box);

  std::array<double, 2> at_{};
  DrawnBox box_;
  std::vector<DrawnBox> lines_;  // about each, of no width
  bool is_one_box_ = false, is_empty_ = true;
};

}  // namespace telestrain
