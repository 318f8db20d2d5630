#include "report/reading/drawing_state.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace telestrain {
namespace {

constexpr std::size_t kMostLines = 1000000;  // of a path

}  // namespace

DrawnBox Common(const DrawnBox& a, const DrawnBox& b) {
  return {std::max(a.left_pt, b.left_pt), std::max(a.bottom_pt, b.bottom_pt),
          std::min(a.right_pt, b.right_pt), std::min(a.top_pt, b.top_pt)};
}

DrawingMatrix DrawingMatrix::Then(const DrawingMatrix& next) const {
  return {a * next.a + b * next.c,          a * next.b + b * next.d,
          c * next.a + d * next.c,          c * next.b + d * next.d,
          e * next.a + f * next.c + next.e, e * next.b + f * next.d + next.f};
}

bool DrawingMatrix::KeepsBoxes() const { return b == 0 && c == 0; }
bool DrawingMatrix::IsUpright() const { return KeepsBoxes() && a > 0 && d > 0; }

DrawnBox BoxAbout(const std::vector<std::array<double, 2>>& points) {
  DrawnBox box{points[0][0], points[0][1], points[0][0], points[0][1]};
  for (const auto& [x, y] : points) {
    if (!std::isfinite(x) || !std::isfinite(y))
      throw std::runtime_error("a page of it draws at no place");
    box.left_pt = std::min(box.left_pt, x);
    box.bottom_pt = std::min(box.bottom_pt, y);
    box.right_pt = std::max(box.right_pt, x);
    box.top_pt = std::max(box.top_pt, y);
  }
  return box;
}

void DrawnPath::Add(const DrawnBox& box) {
  if (lines_.size() >= kMostLines) throw std::runtime_error("a page of it draws too much");
  box_ = is_empty_ ? box
                   : BoxAbout({{box_.left_pt, box_.bottom_pt},
                               {box_.right_pt, box_.top_pt},
                               {box.left_pt, box.bottom_pt},
                               {box.right_pt, box.top_pt}});
  is_empty_ = false;
  is_one_box_ = false;
  lines_.push_back(box);
}

void DrawnPath::MoveTo(const std::array<double, 2>& at) {
  at_ = at;
  Add(BoxAbout({at}));
}

void DrawnPath::LineTo(const std::array<double, 2>& at) {
  Add(BoxAbout({at_, at}));
  at_ = at;
}

void DrawnPath::Rectangle(const DrawnBox& box, bool keeps_box) {
  const bool is_first = is_empty_;
  const double left = box.left_pt, right = box.right_pt, low = box.bottom_pt, high = box.top_pt;
  for (const DrawnBox& side : {DrawnBox{left, low, right, low}, DrawnBox{left, high, right, high},
                               DrawnBox{left, low, left, high}, DrawnBox{right, low, right, high}})
    Add(side);
  is_one_box_ = is_first && keeps_box;
}

}  // namespace telestrain
