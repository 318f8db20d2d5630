#include "target/block_sums.h"

namespace telestrain {
namespace {

using Lanes = float[BlockSums::kLanes];

TELESTRAIN_WIDE void AddProducts(const BlockSums::Rows& block, int rows,
                                 Lanes (*sums)[BlockSums::kMostRows]) {
  constexpr int kLanes = BlockSums::kLanes;
  for (int i = 0; i < rows; ++i)
    for (int j = i; j < rows; ++j) {
      float lanes[kLanes] = {};
      for (int k = 0; k < kBlock; k += kLanes)
        for (int l = 0; l < kLanes; ++l) lanes[l] += block[i][k + l] * block[j][k + l];
      for (int l = 0; l < kLanes; ++l) sums[i][j][l] += lanes[l];
    }
}

}  // namespace

void BlockPixels::Reserve(int count) {
  for (auto* values : {&x, &y, &gray, &side})
    values->reserve(static_cast<std::size_t>(count + kBlock));
}

void BlockPixels::Append(double first_x, double at_y, double at_side, const float* levels,
                         int count) {
  const std::size_t first = x.size(), size = first + static_cast<std::size_t>(count);
  x.resize(size);
  for (int i = 0; i < count; ++i)
    x[first + static_cast<std::size_t>(i)] = static_cast<float>(first_x + i);
  gray.insert(gray.end(), levels, levels + count);
  y.resize(size, static_cast<float>(at_y));
  side.resize(size, static_cast<float>(at_side));
}

void BlockPixels::Pad() {
  const std::size_t size = (x.size() + kBlock - 1) / kBlock * kBlock;
  for (auto* values : {&x, &y, &gray, &side}) values->resize(size, 0);
}

void BlockSums::Add(const Rows& block) { AddProducts(block, rows_, sums_); }

double BlockSums::Product(int i, int j) const {
  const Lanes& l = sums_[i][j];
  const auto pair = [&l](int a) {
    return static_cast<double>(l[a]) + static_cast<double>(l[a + 1]);
  };
  return (pair(0) + pair(2)) + (pair(4) + pair(6));
}

}  // namespace telestrain
