#pragma once

#include <Eigen/Core>
#include <vector>

#include "correlation/image_filters.h"
#include "correlation/pixel_bits.h"

namespace telestrain::correlation {

// What the prefilter lets through of the images' noise: the noise of the blurred image is
// correlated between pixels, so that sum g n over a subset has the variance sigma^2 sum g'^2 with
// g' the gradient blurred once more. Kept are the sums of g^2 and g'^2 over tiles, for their ratio
// in any subset.
class NoiseShares {
 public:
  static constexpr int kTile_px = 16;  // counted from the region's corner

  NoiseShares() = default;
  // `inside` may be empty: all pixels count.
  NoiseShares(const ImageView& gradient_x, const ImageView& gradient_y,
              const std::vector<float>& blur, const PixelBits& inside, int threads);
  // sum g'^2 / sum g^2 along x and y in the tiles that a part meets; one where there is no
  // gradient.
  Eigen::Vector2d In(const PixelRegion& part) const;

 private:
  struct Tile {
    float raw[2] = {0, 0}, blurred[2] = {0, 0};
  };
  int columns_ = 0;
  std::vector<Tile> tiles_;
};

}  // namespace telestrain::correlation
