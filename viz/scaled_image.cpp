#include "viz/scaled_image.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace telestrain::viz {
namespace {

// The old pixels under a new one, along one axis.
struct Cover {
  std::size_t first = 0;
  std::vector<double> weights;  // sum 1
};

std::vector<Cover> CoversOf(int old_size, int new_size) {
  std::vector<Cover> covers(static_cast<std::size_t>(new_size));
  const double step = static_cast<double>(old_size) / new_size;
  for (int i = 0; i < new_size; ++i) {
    Cover& cover = covers[static_cast<std::size_t>(i)];
    const double begin = i * step, end = std::min<double>((i + 1) * step, old_size);
    cover.first = static_cast<std::size_t>(begin);
    for (double at = std::floor(begin); at < end - 1e-9; ++at)
      cover.weights.push_back((std::min(at + 1, end) - std::max(at, begin)) / (end - begin));
  }
  return covers;
}

double OnWhite(const RgbImage& image, std::size_t pixel, std::size_t channel) {
  const double value = image.rgb[3 * pixel + channel];
  if (image.alpha.empty()) return value;
  return 255 + (value - 255) * image.alpha[pixel] / 255;
}

}  // namespace

RgbImage Reduced(const RgbImage& image, int width_px, int height_px) {
  TELESTRAIN_CHECK(
      width_px > 0 && height_px > 0 && width_px <= image.width_px && height_px <= image.height_px,
      "a reduced picture is not larger");
  RgbImage reduced{width_px, height_px, image.dots_per_inch, {}, {}};
  reduced.rgb.reserve(3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  const auto columns = CoversOf(image.width_px, width_px);
  const auto old_width = static_cast<std::size_t>(image.width_px);
  std::vector<double> row(3 * old_width);
  for (const Cover& y : CoversOf(image.height_px, height_px)) {
    std::fill(row.begin(), row.end(), 0.0);
    for (std::size_t j = 0; j < y.weights.size(); ++j)
      for (std::size_t i = 0; i < row.size(); ++i)
        row[i] += y.weights[j] * OnWhite(image, (y.first + j) * old_width + i / 3, i % 3);
    for (const Cover& x : columns)
      for (std::size_t channel = 0; channel < 3; ++channel) {
        double sum = 0;
        for (std::size_t i = 0; i < x.weights.size(); ++i)
          sum += x.weights[i] * row[3 * (x.first + i) + channel];
        reduced.rgb.push_back(static_cast<std::uint8_t>(std::lround(sum)));
      }
  }
  return reduced;
}

}  // namespace telestrain::viz
