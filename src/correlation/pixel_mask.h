#pragma once

#include <cstddef>
#include <vector>

namespace telestrain {

// Which pixels of a whole image belong to a region of any shape, row by row from the top left.
struct PixelMask {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> inside;  // 0 or 1

  bool At(int x, int y) const {
    return inside[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)] != 0;
  }
};

}  // namespace telestrain
