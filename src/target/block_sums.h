#pragma once

#include <vector>

#include "target/wide_loop.h"

namespace telestrain {

// Pixels of a window whose model is computed by the same formula, in whole blocks; (x, y) from the
// window's middle.
struct BlockPixels {
  // `side` is free to the formula but not 0.
  std::vector<float> x, y, gray, side;

  int Blocks() const { return static_cast<int>(x.size()) / kBlock; }
  void Clear() { x.clear(), y.clear(), gray.clear(), side.clear(); }
  void Reserve(int count);
  // Pixels (first_x, at_y), (first_x + 1, at_y), ..
  void Append(double first_x, double at_y, double at_side, const float* levels, int count);
  void Pad();  // after the last pixel, with side 0
};

// Sums of products of rows of a Jacobian with each other, in eight lanes and a fixed order.
class BlockSums {
 public:
  static constexpr int kMostRows = 12, kLanes = 8;
  using Rows = float[kMostRows][kBlock];

  explicit BlockSums(int rows) : rows_(rows) {}
  void Add(const Rows& block);
  // i <= j
  double Product(int i, int j) const;

 private:
  int rows_;
  float sums_[kMostRows][kMostRows][kLanes] = {};
};

}  // namespace telestrain
