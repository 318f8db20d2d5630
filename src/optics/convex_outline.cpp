#include "optics/convex_outline.h"

#include <algorithm>

#include "base/check.h"

namespace telestrain {
namespace {

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// One side of the hull (Andrew's monotone chain) over points in ascending or descending order.
template <typename Iterator>
ConvexOutline Chain(Iterator begin, Iterator end) {
  ConvexOutline chain;
  for (Iterator point = begin; point != end; ++point) {
    while (chain.size() >= 2 &&
           Cross(chain.back() - chain[chain.size() - 2], *point - chain[chain.size() - 2]) <= 0)
      chain.pop_back();
    chain.push_back(*point);
  }
  if (!chain.empty()) chain.pop_back();  // the first of the other side
  return chain;
}

}  // namespace

ConvexOutline RectangleOutline(const Eigen::Vector2d& lowest_mm,
                               const Eigen::Vector2d& highest_mm) {
  return {lowest_mm, {highest_mm.x(), lowest_mm.y()}, highest_mm, {lowest_mm.x(), highest_mm.y()}};
}

ConvexOutline HullOf(std::vector<Eigen::Vector2d> points_mm) {
  std::sort(points_mm.begin(), points_mm.end(), [](const auto& a, const auto& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  ConvexOutline hull = Chain(points_mm.begin(), points_mm.end());
  const ConvexOutline upper = Chain(points_mm.rbegin(), points_mm.rend());
  hull.insert(hull.end(), upper.begin(), upper.end());
  return hull;
}

double AreaOf_mm2(const ConvexOutline& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    twice += Cross(outline[i], outline[(i + 1) % outline.size()]);
  return 0.5 * twice;
}

Eigen::Vector2d MiddleOf(const ConvexOutline& outline) {
  TELESTRAIN_CHECK(!outline.empty(), "an empty outline has no middle");
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : outline) sum += corner;
  return sum / static_cast<double>(outline.size());
}

ConvexOutline CutAt(const ConvexOutline& outline, const Eigen::Vector2d& on_line_mm,
                    const Eigen::Vector2d& inward) {
  ConvexOutline kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& here = outline[i];
    const Eigen::Vector2d& next = outline[(i + 1) % outline.size()];
    const double from = inward.dot(here - on_line_mm), to = inward.dot(next - on_line_mm);
    if (from >= 0) kept.push_back(here);
    if ((from > 0 && to < 0) || (from < 0 && to > 0))
      kept.push_back(here + from / (from - to) * (next - here));
  }
  return kept.size() < 3 ? ConvexOutline{} : kept;
}

ConvexOutline Intersection(const ConvexOutline& a, const ConvexOutline& b) {
  ConvexOutline shared = a;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Eigen::Vector2d edge = b[(i + 1) % b.size()] - b[i];
    shared = CutAt(shared, b[i], {-edge.y(), edge.x()});
  }
  return b.empty() ? ConvexOutline{} : shared;
}

bool Contains(const ConvexOutline& outline, const Eigen::Vector2d& point_mm) {
  for (std::size_t i = 0; i < outline.size(); ++i)
    if (Cross(outline[(i + 1) % outline.size()] - outline[i], point_mm - outline[i]) < 0)
      return false;
  return outline.size() >= 3;
}

}  // namespace telestrain
