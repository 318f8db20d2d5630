#include "viz/label_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/check.h"

namespace telestrain::viz {
namespace {

bool IsFree(const PixelBox& box, const PixelBox& within, const Occupancy& occupancy,
            const std::vector<PixelBox>& placed) {
  if (box.left < within.left || box.bottom < within.bottom || box.Right() > within.Right() ||
      box.Top() > within.Top())
    return false;
  for (const PixelBox& other : placed)
    if (Overlap(box, other)) return false;
  return occupancy.Count(box) == 0;
}

bool CrossesNone(const std::vector<PixelBox>& leader, const std::vector<PixelBox>& placed) {
  return std::none_of(leader.begin(), leader.end(), [&](const PixelBox& part) {
    return std::any_of(placed.begin(), placed.end(),
                       [&](const PixelBox& other) { return Overlap(part, other); });
  });
}

// The label with its edge, not its middle, radius_px away from the anchor.
PixelBox BoxAt(const LabelRequest& request, double radius_px, double turn_rad) {
  const double angle = request.preferred_rad + turn_rad;
  const Eigen::Vector2d toward(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d& size = request.size_px;
  const Eigen::Vector2d middle =
      request.anchor_px + radius_px * toward + 0.5 * toward.cwiseProduct(size);
  return {std::round(middle.x() - 0.5 * size.x()), std::round(middle.y() - 0.5 * size.y()),
          size.x(), size.y()};
}

}  // namespace

Occupancy::Occupancy(int width_px, int height_px, const std::vector<std::uint8_t>& taken)
    : width_px_(width_px), height_px_(height_px) {
  const std::size_t stride = static_cast<std::size_t>(width_px) + 1;
  TELESTRAIN_CHECK(taken.size() == static_cast<std::size_t>(width_px) * height_px,
                   "one byte per pixel");
  sums_.assign(stride * (static_cast<std::size_t>(height_px) + 1), 0);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height_px); ++y) {
    int row_sum = 0;
    for (std::size_t x = 0; x + 1 < stride; ++x) {
      row_sum += taken[y * (stride - 1) + x] != 0 ? 1 : 0;
      sums_[(y + 1) * stride + x + 1] = sums_[y * stride + x + 1] + row_sum;
    }
  }
}

int Occupancy::Count(const PixelBox& box) const {
  const int left = static_cast<int>(std::floor(box.left));
  const int bottom = static_cast<int>(std::floor(box.bottom));
  const int right = static_cast<int>(std::ceil(box.Right()));
  const int top = static_cast<int>(std::ceil(box.Top()));
  const auto clip_x = [this](int x) { return std::clamp(x, 0, width_px_); };
  const auto clip_y = [this](int y) { return std::clamp(y, 0, height_px_); };
  const auto sum = [this](int x, int y) {
    return sums_[static_cast<std::size_t>(y) * (width_px_ + 1) + x];
  };
  const int x0 = clip_x(left), x1 = clip_x(right), y0 = clip_y(bottom), y1 = clip_y(top);
  const int inside = (x1 - x0) * (y1 - y0);
  const int outside = (right - left) * (top - bottom) - inside;
  return sum(x1, y1) - sum(x0, y1) - sum(x1, y0) + sum(x0, y0) + outside;
}

bool Overlap(const PixelBox& a, const PixelBox& b) {
  return a.left < b.Right() && b.left < a.Right() && a.bottom < b.Top() && b.bottom < a.Top();
}

std::vector<PixelBox> LeaderBoxes(const Eigen::Vector2d& anchor_px, const PixelBox& label,
                                  double gap_px) {
  constexpr double kStep_px = 4;
  const PixelBox near = label.Grown(gap_px);
  const Eigen::Vector2d end(std::clamp(anchor_px.x(), near.left, near.Right()),
                            std::clamp(anchor_px.y(), near.bottom, near.Top()));
  const int parts = static_cast<int>((end - anchor_px).norm() / kStep_px);
  std::vector<PixelBox> boxes;
  for (int i = 1; i < parts; ++i) {  // leaders may share their anchor
    const Eigen::Vector2d at = anchor_px + (end - anchor_px) * i / parts;
    boxes.push_back(PixelBox{at.x(), at.y(), 0, 0}.Grown(0.5 * kStep_px));
  }
  return boxes;
}

namespace {

std::optional<PixelBox> NearestPlace(const LabelRequest& request, const PixelBox& within,
                                     const Occupancy& occupancy,
                                     const std::vector<PixelBox>& placed) {
  constexpr int kDirections = 32;
  const double ring_px = std::max(2.0, 0.25 * request.size_px.y());
  const double farthest_px = std::hypot(within.width, within.height);
  const auto is_free = [&](const PixelBox& box) {
    return IsFree(box.Grown(request.clearance_px), within, occupancy, placed) &&
           (!request.leader ||
            CrossesNone(LeaderBoxes(request.anchor_px, box, request.clearance_px), placed));
  };
  for (double radius_px = ring_px; radius_px < request.straight_px; radius_px += ring_px)
    if (const PixelBox box = BoxAt(request, radius_px, 0); is_free(box)) return box;
  for (double radius_px = ring_px; radius_px < farthest_px; radius_px += ring_px)
    for (int i = 0; i < kDirections; ++i) {
      // 0, +1, -1, +2, -2, ... steps away from the preferred direction.
      const int step = (i % 2 == 0 ? -1 : 1) * ((i + 1) / 2);
      const double turn_rad = step * 2 * std::numbers::pi / kDirections;
      if (const PixelBox box = BoxAt(request, radius_px, turn_rad); is_free(box)) return box;
    }
  return std::nullopt;
}

}  // namespace

std::optional<PixelBox> PlaceLabel(const LabelRequest& request, const PixelBox& within,
                                   const Occupancy& occupancy,
                                   const std::vector<PixelBox>& placed) {
  if (const auto box = NearestPlace(request, within, occupancy, placed)) return box;
  LabelRequest crossing = request;
  crossing.leader = false;
  return request.leader ? NearestPlace(crossing, within, occupancy, placed) : std::nullopt;
}

}  // namespace telestrain::viz
