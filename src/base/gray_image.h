#pragma once

#include <cstddef>
#include <vector>

namespace telestrain {

// A grey-level image, row by row from the top left; pixel (0,0) is the centre of the first one.
struct GrayImage {
  int width = 0;
  int height = 0;
  float max_gray = 255;  // full scale of the format: 255 or 65535
  std::vector<float> pixels;

  float At(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  float& At(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

}  // namespace telestrain
