#pragma once

#include "base/gray_image.h"
#include "correlation/pixel_bits.h"

namespace telestrain::correlation {

// Above this share of a subset's pixels at one end of the grey scale a match is reported as
// saturated: half of the pixels then have no gradient and no noise, so that neither the
// displacement nor its standard deviation says what it seems to. Each end counts by itself, since a
// good pattern of black and white may touch both.
inline constexpr double kMostSaturatedShare = 0.5;

// Pixels of a region at the ends of the grey scale.
struct Saturation {
  PixelBits black, white;

  Saturation() = default;
  Saturation(const GrayImage& image, const PixelRegion& region)
      : Saturation(image.pixels.data(), image.width, image.max_gray, region) {}

  static bool Exceeds(const PixelBits& bits, const PixelRegion& part) {
    return static_cast<double>(bits.Count(part)) >
           kMostSaturatedShare * part.width * static_cast<double>(part.height);
  }
  bool In(const PixelRegion& part) const { return Exceeds(black, part) || Exceeds(white, part); }

 private:
  Saturation(const float* pixels, std::ptrdiff_t stride, float max_gray, const PixelRegion& region)
      : black(BitsWhere(region, [=](int x, int y) { return pixels[y * stride + x] <= 0; })),
        white(BitsWhere(region, [=](int x, int y) { return pixels[y * stride + x] >= max_gray; })) {
  }
};

}  // namespace telestrain::correlation
