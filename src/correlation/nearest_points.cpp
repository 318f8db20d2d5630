#include "correlation/nearest_points.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace telestrain::correlation {
namespace {

constexpr int kLeafPoints = 16;
constexpr int kMaxDepth = 40;  // points on one place cannot be parted

}  // namespace

NearestPoints::NearestPoints(const std::vector<Eigen::Vector2i>& points_px)
    : points_(points_px), order_(points_px.size()) {
  if (points_.empty()) return;
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.emplace_back();
  nodes_[0].last = static_cast<int>(order_.size());
  Build(0, 0);
}

void NearestPoints::Build(int node, int depth) {
  const int first = nodes_[node].first, last = nodes_[node].last;
  Eigen::Vector2i low = points_[order_[first]], high = low;
  for (int k = first; k < last; ++k) {
    low = low.cwiseMin(points_[order_[k]]);
    high = high.cwiseMax(points_[order_[k]]);
  }
  nodes_[node].low = low;
  nodes_[node].high = high;
  if (last - first <= kLeafPoints || depth == kMaxDepth) return;
  const Eigen::Vector2i middle = low + (high - low) / 2;
  const auto part = [&](int from, int to, int axis) {
    const auto at =
        std::stable_partition(order_.begin() + from, order_.begin() + to,
                              [&](int index) { return points_[index][axis] <= middle[axis]; });
    return static_cast<int>(at - order_.begin());
  };
  const int half = part(first, last, 1);
  const std::array<int, 5> cuts = {first, part(first, half, 0), half, part(half, last, 0), last};
  const int children = static_cast<int>(nodes_.size());
  nodes_[node].children = children;
  for (int k = 0; k < 4; ++k) {
    nodes_.emplace_back();
    nodes_.back().first = cuts[k];
    nodes_.back().last = cuts[k + 1];
  }
  for (int k = 0; k < 4; ++k)
    if (cuts[k] < cuts[k + 1]) Build(children + k, depth + 1);
}

std::int64_t NearestPoints::Distance2(const Node& node, const Eigen::Vector2i& at) {
  const Eigen::Vector2i nearest = at.cwiseMax(node.low).cwiseMin(node.high);
  return (nearest - at).cast<std::int64_t>().squaredNorm();
}

void NearestPoints::Visit(int node, const Eigen::Vector2i& at, std::size_t count,
                          std::vector<Found>& found) const {
  const Node& here = nodes_[node];
  if (here.children < 0) {
    for (int k = here.first; k < here.last; ++k) {
      const Found candidate{(points_[order_[k]] - at).cast<std::int64_t>().squaredNorm(),
                            order_[k]};
      if (found.size() == count && !(candidate < found.back())) continue;
      found.insert(std::upper_bound(found.begin(), found.end(), candidate), candidate);
      if (found.size() > count) found.pop_back();
    }
    return;
  }
  std::array<Found, 4> order{};
  int filled = 0;
  for (int child = here.children; child < here.children + 4; ++child) {
    if (nodes_[child].first == nodes_[child].last) continue;
    order[filled] = {Distance2(nodes_[child], at), child};
    for (int k = filled++; k > 0 && order[k] < order[k - 1]; --k) std::swap(order[k], order[k - 1]);
  }
  for (int k = 0; k < filled; ++k)
    if (found.size() < count || order[k].distance2 <= found.back().distance2)
      Visit(order[k].index, at, count, found);
}

std::vector<int> NearestPoints::Find(const Eigen::Vector2i& at_px, std::size_t count) const {
  std::vector<Found> found;
  if (!nodes_.empty() && count > 0) Visit(0, at_px, count, found);
  std::vector<int> indices;
  for (const Found& one : found) indices.push_back(one.index);
  return indices;
}

}  // namespace telestrain::correlation
