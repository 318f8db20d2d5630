#include "correlation/noise_shares.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace telestrain::correlation {

NoiseShares::NoiseShares(const ImageView& gradient_x, const ImageView& gradient_y,
                         const std::vector<float>& blur, const PixelBits& inside, int threads)
    : columns_((gradient_x.width + kTile_px - 1) / kTile_px) {
  const int width = gradient_x.width, height = gradient_x.height;
  const int rows = (height + kTile_px - 1) / kTile_px;
  tiles_.resize(static_cast<std::size_t>(columns_) * rows);
  ParallelFor(rows, threads, [&](int row) {
    const int top = row * kTile_px, end = std::min(height, top + kTile_px);
    std::vector<float> blurred(static_cast<std::size_t>(width) * kTile_px);
    for (int axis = 0; axis < 2; ++axis) {
      const ImageView& view = axis == 0 ? gradient_x : gradient_y;
      FilterSeparable(view, blur, blur, {0, top, width, end - top}, 1, blurred.data(), width);
      for (int y = top; y < end; ++y) {
        for (int x = 0; x < width; ++x) {
          const float raw = view.pixels[y * view.stride + x];
          const float smooth = blurred[static_cast<std::size_t>(y - top) * width + x];
          if (!std::isfinite(smooth) || !(inside.empty() || inside.At(x, y))) continue;
          Tile& tile = tiles_[static_cast<std::size_t>(row) * columns_ + x / kTile_px];
          tile.raw[axis] += raw * raw;
          tile.blurred[axis] += smooth * smooth;
        }
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
