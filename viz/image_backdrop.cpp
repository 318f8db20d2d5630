#include "viz/image_backdrop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/check.h"

namespace telestrain::viz {
namespace {

// The image's pixels below pixel `i` of the picture: [first, end).
std::array<int, 2> PixelsBelow(int i, double magnification, int count) {
  const int first = std::min(static_cast<int>(std::floor(i / magnification)), count - 1);
  const int end = static_cast<int>(std::floor((i + 1) / magnification));
  return {first, std::clamp(end, first + 1, count)};
}

float MeanOf(const GrayImage& image, const std::array<int, 2>& columns,
             const std::array<int, 2>& rows) {
  double sum = 0;
  for (int y = rows[0]; y < rows[1]; ++y)
    for (int x = columns[0]; x < columns[1]; ++x) sum += image.At(x, y);
  return static_cast<float>(sum / ((columns[1] - columns[0]) * (rows[1] - rows[0])));
}

}  // namespace

ImageBackdrop::ImageBackdrop(const GrayImage& image, int max_width, int max_height)
    : image_width_px_(image.width), image_height_px_(image.height) {
  TELESTRAIN_CHECK(image.width > 0 && image.height > 0, "an empty image has no picture");
  magnification_ = std::min(static_cast<double>(max_width) / image.width,
                            static_cast<double>(max_height) / image.height);
  width_ = std::max(1, static_cast<int>(std::floor(magnification_ * image.width + 1e-9)));
  height_ = std::max(1, static_cast<int>(std::floor(magnification_ * image.height + 1e-9)));
  gray_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int row = 0; row < height_; ++row)
    for (int column = 0; column < width_; ++column)
      gray_.push_back(MeanOf(image, PixelsBelow(column, magnification_, image.width),
                             PixelsBelow(row, magnification_, image.height)));
  Stretch();
}

void ImageBackdrop::Stretch() {
  std::vector<float> sorted = gray_;
  const auto tail = static_cast<std::ptrdiff_t>(sorted.size() / 100);
  std::nth_element(sorted.begin(), sorted.begin() + tail, sorted.end());
  const float low = sorted[static_cast<std::size_t>(tail)];
  std::nth_element(sorted.begin(), sorted.end() - 1 - tail, sorted.end());
  const float high = *(sorted.end() - 1 - tail);
  for (float& gray : gray_)
    gray = high > low ? std::clamp((gray - low) / (high - low), 0.0F, 1.0F) : 0.5F;
  mean_gray_ = static_cast<float>(std::accumulate(gray_.begin(), gray_.end(), 0.0) /
                                  static_cast<double>(gray_.size()));
}

}  // namespace telestrain::viz
