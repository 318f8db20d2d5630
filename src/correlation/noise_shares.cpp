#include "correlation/noise_shares.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace telestrain::correlation {

namespace {

// Sums down the columns of a row of tiles; compilers turn the loop into vectors.
void AddSquares(const float* raw, const float* blurred, const std::vector<float>& counted,
                std::vector<float>& raw_sums, std::vector<float>& blurred_sums) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  for (std::size_t x = 0; x < counted.size(); ++x) {
    const float factor = std::abs(blurred[x]) <= kLargest ? counted[x] : 0.f;
    raw_sums[x] += factor > 0 ? raw[x] * raw[x] : 0.f;
    blurred_sums[x] += factor > 0 ? blurred[x] * blurred[x] : 0.f;
  }
}

}  // namespace

NoiseShares::NoiseShares(const ImageView& gradient_x, const ImageView& gradient_y,
                         const std::vector<float>& blur, const PixelBits& inside, int threads)
    : columns_((gradient_x.width + kTile_px - 1) / kTile_px) {
  const int width = gradient_x.width, height = gradient_x.height;
  const int rows = (height + kTile_px - 1) / kTile_px;
  tiles_.resize(static_cast<std::size_t>(columns_) * rows);
  ParallelFor(rows, threads, [&](int row) {
    const int top = row * kTile_px, end = std::min(height, top + kTile_px);
    const auto columns = static_cast<std::size_t>(width);
    std::vector<float> blurred(columns * kTile_px), counted(columns, 1.f);
    for (int axis = 0; axis < 2; ++axis) {
      const ImageView& view = axis == 0 ? gradient_x : gradient_y;
      FilterSeparable(view, blur, blur, {0, top, width, end - top}, 1, blurred.data(), width);
      std::vector<float> raw_sums(columns), blurred_sums(columns);
      for (int y = top; y < end; ++y) {
        if (!inside.empty())
          for (int x = 0; x < width; ++x) counted[x] = inside.At(x, y) ? 1.f : 0.f;
        AddSquares(view.pixels + y * view.stride, &blurred[(y - top) * columns], counted, raw_sums,
                   blurred_sums);
      }
      for (int x = 0; x < width; ++x) {
        Tile& tile = tiles_[static_cast<std::size_t>(row) * columns_ + x / kTile_px];
        tile.raw[axis] += raw_sums[x];
        tile.blurred[axis] += blurred_sums[x];
      }
    }
  });
}

Eigen::Vector2d NoiseShares::In(const PixelRegion& part) const {
  Eigen::Vector2d raw(0, 0), blurred(0, 0);
  for (int row = part.y / kTile_px; row <= (part.y + part.height - 1) / kTile_px; ++row) {
    for (int column = part.x / kTile_px; column <= (part.x + part.width - 1) / kTile_px; ++column) {
      const Tile& tile = tiles_[static_cast<std::size_t>(row) * columns_ + column];
      raw += Eigen::Vector2d(tile.raw[0], tile.raw[1]);
      blurred += Eigen::Vector2d(tile.blurred[0], tile.blurred[1]);
    }
  }
  return {raw.x() > 0 ? blurred.x() / raw.x() : 1, raw.y() > 0 ? blurred.y() / raw.y() : 1};
}

}  // namespace telestrain::correlation
