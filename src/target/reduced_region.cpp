#include "target/reduced_region.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/check.h"

namespace telestrain {

GrayImage ReduceRegion(const GrayImage& image, const PixelRegion& region, int n) {
  TELESTRAIN_CHECK(n >= 1, "squares have at least one pixel");
  GrayImage reduced;
  reduced.width = region.width / n;
  reduced.height = region.height / n;
  reduced.max_gray = image.max_gray;
  reduced.pixels.resize(static_cast<std::size_t>(reduced.width) *
                        static_cast<std::size_t>(reduced.height));
  const int used = reduced.width * n;
  std::vector<float> row(static_cast<std::size_t>(used));
  const float share = 1.0F / static_cast<float>(n * n);
  for (int y = 0; y < reduced.height; ++y) {
    const float* first = image.pixels.data() +
                         static_cast<std::ptrdiff_t>(region.y + y * n) * image.width + region.x;
    float* __restrict sums = row.data();
    std::copy_n(first, used, sums);
    for (int i = 1; i < n; ++i) {
      const float* __restrict next = first + static_cast<std::ptrdiff_t>(i) * image.width;
      for (int x = 0; x < used; ++x) sums[x] += next[x];
    }
    float* __restrict out = reduced.pixels.data() + static_cast<std::ptrdiff_t>(y) * reduced.width;
    for (int x = 0; x < reduced.width; ++x) {
      const float* square = sums + static_cast<std::ptrdiff_t>(x) * n;
      float sum = square[0];
      for (int i = 1; i < n; ++i) sum += square[i];
      out[x] = sum * share;
    }
  }
  return reduced;
}

}  // namespace telestrain
