#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "viz/pictures.h"

namespace telestrain::viz {

// A picture with few colours: indices into a table.
struct IndexedImage {
  std::vector<std::array<std::uint8_t, 3>> colors;
  std::vector<std::uint8_t> indices;  // one per pixel
};

// At most `most_colors` (2 to 256) colours by median cut (P. Heckbert 1982) over a histogram of 5
// bits per channel, each the mean of its pixels. White is exact: paper must not be grey.
IndexedImage Indexed(const RgbImage& image, std::size_t most_colors);

}  // namespace telestrain::viz
