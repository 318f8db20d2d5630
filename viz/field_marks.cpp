#include "viz/field_marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "viz/scene/scene_colors.h"
#include "viz/scene_marks.h"

namespace telestrain::viz {
namespace {

constexpr Rgb kPaper{1, 1, 1};
constexpr Rgb kFailure{0.78, 0.02, 0.20};
constexpr double kArrowSpacing_pt = 19, kHalo_pt = 0.8;
constexpr double kCross_pt = 1.7, kDot_pt = 1.1, kLeastDotSpacing_pt = 3.2;

}  // namespace

FieldMarks::FieldMarks(Canvas* canvas, const ImageBackdrop& backdrop, const FieldScene& scene,
                       const Eigen::Vector2d& upper_left)
    : canvas_(canvas), backdrop_(backdrop), scene_(scene), upper_left_(upper_left) {}

Eigen::Vector2d FieldMarks::CanvasPlace(const Eigen::Vector2d& place_px) const {
  const Eigen::Vector2d place = backdrop_.BackdropPlace(place_px);
  return {upper_left_.x() + place.x(), upper_left_.y() - place.y()};
}

FieldMarks::ArrowKey FieldMarks::AddArrows() const {
  std::vector<double> lengths_px;
  for (const FieldSample& sample : scene_.samples)
    if (sample.is_point && !sample.failed) lengths_px.push_back(sample.arrow_px.norm());
  if (lengths_px.empty()) return {};
  // The longest fiftieth may be outliers; they overlap their neighbours.
  const auto nearly_longest =
      lengths_px.begin() +
      static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(lengths_px.size()));
  std::nth_element(lengths_px.begin(), nearly_longest, lengths_px.end());
  if (!(*nearly_longest > 0)) return {};
  const double spacing_px = canvas_->Px(kArrowSpacing_pt);
  const int stride =
      std::max(1, static_cast<int>(std::ceil(spacing_px / PicturePx(scene_.step_px))));
  const double reach_px = std::min(PicturePx(stride * scene_.step_px), 2 * spacing_px);
  const double enlarged = RoundDown(0.98 * reach_px / PicturePx(*nearly_longest));
  for (int row = stride / 2; row < scene_.rows; row += stride)
    for (int column = stride / 2; column < scene_.columns; column += stride) {
      const FieldSample& sample = scene_.samples[static_cast<std::size_t>(row * scene_.columns) +
                                                 static_cast<std::size_t>(column)];
      if (!sample.is_point || sample.failed) continue;
      const Eigen::Vector2d tail = CanvasPlace(sample.at_px);
      const Eigen::Vector2d way(sample.arrow_px.x(), -sample.arrow_px.y());
      AddFlatArrow(canvas_, tail, tail + enlarged * backdrop_.magnification() * way);
    }
  return {enlarged, RoundDown(*nearly_longest)};
}

void FieldMarks::AddCross(const Eigen::Vector2d& at) const {
  const double half = canvas_->Px(kCross_pt);
  const double ink_px = canvas_->Px(0.8), halo_px = ink_px + canvas_->Px(kHalo_pt);
  for (const auto& [color, width_px] : {std::pair{kPaper, halo_px}, {kFailure, ink_px}})
    for (const double sign : {-1.0, 1.0})
      canvas_->Shapes().AddLine(at + half * Eigen::Vector2d(-1, sign),
                                at + half * Eigen::Vector2d(1, -sign), color, width_px);
}

int FieldMarks::AddFailures() const {
  int failed = 0;
  std::set<std::pair<int, int>> taken;
  const double cell_px = canvas_->Px(3.5 * kCross_pt);
  for (const FieldSample& sample : scene_.samples) {
    if (!sample.is_point || !sample.failed) continue;
    ++failed;
    const Eigen::Vector2d at = CanvasPlace(sample.at_px);
    const Eigen::Vector2d cell = at / cell_px;
    if (taken.emplace(static_cast<int>(cell.x()), static_cast<int>(cell.y())).second) AddCross(at);
  }
  return failed;
}

void FieldMarks::AddSquare(const Eigen::Vector2d& center, double side_px) const {
  const double line = std::round(canvas_->Px(0.9)), half = 0.5 * side_px;
  const PixelBox box{std::round(center.x() - half), std::round(center.y() - half),
                     std::round(side_px), std::round(side_px)};
  canvas_->Shapes().AddFrame(box.Grown(line), kPaper, line);
  canvas_->Shapes().AddFrame(box, kInk, line);
}

void FieldMarks::AddSubset() const {
  const auto first = std::find_if(scene_.samples.begin(), scene_.samples.end(),
                                  [](const FieldSample& sample) { return sample.is_point; });
  if (first == scene_.samples.end()) return;
  AddSquare(CanvasPlace(first->at_px), PicturePx(scene_.subset_px));
}

bool FieldMarks::AddGridDots() const {
  if (PicturePx(scene_.step_px) < canvas_->Px(kLeastDotSpacing_pt)) return false;
  const double side = std::round(canvas_->Px(kDot_pt));
  for (const FieldSample& sample : scene_.samples) {
    if (!sample.is_point || sample.failed) continue;
    const Eigen::Vector2d at = CanvasPlace(sample.at_px);
    const PixelBox box{std::round(at.x() - 0.5 * side), std::round(at.y() - 0.5 * side), side,
                       side};
    canvas_->Shapes().AddBox(box.Grown(1), kPaper, 0.8);
    canvas_->Shapes().AddBox(box, kInk);
  }
  return true;
}

}  // namespace telestrain::viz
