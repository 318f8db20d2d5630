#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>
#include <vector>

namespace telestrain::correlation {

// The nearest of a set of points: a quadtree over their bounding box. Of two as near, the one of
// the lower index comes first, so the answer depends on nothing but the points.
class NearestPoints {
 public:
  explicit NearestPoints(const std::vector<Eigen::Vector2i>& points_px);

  // Indices of at most `count` points, the nearest first.
  std::vector<int> Find(const Eigen::Vector2i& at_px, std::size_t count) const;

 private:
  struct Node {
    Eigen::Vector2i low = Eigen::Vector2i::Zero(), high = low;  // bounding box of its points
    int first = 0, last = 0;                                    // of order_
    int children = -1;                                          // four in a row; none for a leaf
  };
  struct Found {
    std::int64_t distance2;
    int index;
    auto operator<=>(const Found&) const = default;
  };
  void Build(int node, int depth);
  void Visit(int node, const Eigen::Vector2i& at, std::size_t count,
             std::vector<Found>& found) const;
  static std::int64_t Distance2(const Node& node, const Eigen::Vector2i& at);

  const std::vector<Eigen::Vector2i> points_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace telestrain::correlation
