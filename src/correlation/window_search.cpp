#include "correlation/window_search.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/FFT>

#include "base/check.h"

namespace telestrain::correlation {
namespace {

using Complex = std::complex<float>;

// A place with less than this share of the block's energy is flat: what single precision leaves of
// the products there could be taken for a peak.
constexpr double kFlatShare = 0.01;

// The smallest length from `length` on that is a product of 2, 3 and 5.
int FastLength(int length) {
  for (int n = std::max(length, 1);; ++n) {
    int rest = n;
    for (int prime : {2, 3, 5})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return n;
  }
}

std::vector<Complex> Transposed(const std::vector<Complex>& in, int columns, int rows) {
  constexpr int kTile = 16;  // keeps both sides in the cache
  std::vector<Complex> out(in.size());
  for (int y0 = 0; y0 < rows; y0 += kTile)
    for (int x0 = 0; x0 < columns; x0 += kTile)
      for (int y = y0; y < std::min(rows, y0 + kTile); ++y)
        for (int x = x0; x < std::min(columns, x0 + kTile); ++x)
          out[static_cast<std::size_t>(x) * rows + y] =
              in[static_cast<std::size_t>(y) * columns + x];
  return out;
}

// Rows of `columns` values; only the first `used` of the rows are not zero or of interest.
void TransformRows(std::vector<Complex>& values, int columns, int used, bool inverse) {
  Eigen::FFT<float> fft;
  std::vector<Complex> row(columns);
  for (int y = 0; y < used; ++y) {
    Complex* from = &values[static_cast<std::size_t>(y) * columns];
    std::copy_n(from, columns, row.data());
    if (inverse)
      fft.inv(from, row.data(), columns);
    else
      fft.fwd(from, row.data(), columns);
  }
}

float Mean(const GrayImage& image) {
  double sum = 0;
  for (float value : image.pixels) sum += value;
  return static_cast<float>(sum /
                            static_cast<double>(std::max<std::size_t>(image.pixels.size(), 1)));
}

double Energy(const GrayImage& image, float mean) {
  double sum = 0;
  for (float value : image.pixels) sum += (value - mean) * static_cast<double>(value - mean);
  return sum;
}

}  // namespace

WindowSearch::WindowSearch(const GrayImage& image)
    : width_(image.width),
      height_(image.height),
      columns_(FastLength(image.width)),
      rows_(FastLength(image.height)),
      spectrum_(static_cast<std::size_t>(columns_) * rows_),
      sums_(static_cast<std::size_t>(width_ + 1) * (height_ + 1)),
      squares_(sums_.size()) {
  const float mean = Mean(image);
  const std::size_t stride = static_cast<std::size_t>(width_) + 1;
  for (int y = 0; y < height_; ++y) {
    double sum = 0, square = 0;
    for (int x = 0; x < width_; ++x) {
      const float value = image.At(x, y) - mean;
      spectrum_[static_cast<std::size_t>(y) * columns_ + x] = value;
      sum += value;
      square += static_cast<double>(value) * value;
      const std::size_t at = (static_cast<std::size_t>(y) + 1) * stride + x + 1;
      sums_[at] = sums_[at - stride] + sum;
      squares_[at] = squares_[at - stride] + square;
    }
  }
  TransformRows(spectrum_, columns_, height_, false);
  spectrum_ = Transposed(spectrum_, columns_, rows_);
  TransformRows(spectrum_, rows_, columns_, false);
}

// Of one real block b and another one c the spectrum P of b + i c is taken; the inverse of
// W(k) P(-k) is then the correlation of the window with b plus i times that with c.
WindowSearch::Spectrum WindowSearch::Products(const GrayImage& one, const GrayImage* two) const {
  Spectrum block(spectrum_.size());
  const float mean_one = Mean(one), mean_two = two ? Mean(*two) : 0.f;
  for (int y = 0; y < one.height; ++y)
    for (int x = 0; x < one.width; ++x)
      block[static_cast<std::size_t>(y) * columns_ + x] = {one.At(x, y) - mean_one,
                                                           two ? two->At(x, y) - mean_two : 0.f};
  TransformRows(block, columns_, one.height, false);
  block = Transposed(block, columns_, rows_);
  TransformRows(block, rows_, columns_, false);
  Spectrum product(spectrum_.size());
  for (int x = 0; x < columns_; ++x) {
    const std::size_t row = static_cast<std::size_t>(x) * rows_;
    const std::size_t mirrored = static_cast<std::size_t>(x == 0 ? 0 : columns_ - x) * rows_;
    for (int y = 0; y < rows_; ++y)
      product[row + y] = spectrum_[row + y] * block[mirrored + (y == 0 ? 0 : rows_ - y)];
  }
  TransformRows(product, rows_, columns_, true);
  product = Transposed(product, rows_, columns_);
  TransformRows(product, columns_, height_ - one.height + 1, true);
  return product;
}

GrayImage WindowSearch::Normalise(const GrayImage& block, const Spectrum& products,
                                  bool imaginary) const {
  GrayImage out{width_ - block.width + 1, height_ - block.height + 1, 1, {}};
  out.pixels.reserve(static_cast<std::size_t>(out.width) * out.height);
  const double energy = Energy(block, Mean(block));
  const double pixels = static_cast<double>(block.width) * block.height;
  const std::size_t stride = static_cast<std::size_t>(width_) + 1;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const std::size_t top = static_cast<std::size_t>(y) * stride + x;
      const std::size_t bottom = top + static_cast<std::size_t>(block.height) * stride;
      const auto box = [&](const std::vector<double>& sums) {
        return sums[bottom + block.width] - sums[bottom] - sums[top + block.width] + sums[top];
      };
      const double sum = box(sums_), here = box(squares_) - sum * sum / pixels;
      const Complex product = products[static_cast<std::size_t>(y) * columns_ + x];
      const double value = imaginary ? product.imag() : product.real();
      const bool flat = !(energy > 0) || !(here > kFlatShare * energy);
      out.pixels.push_back(flat ? 0.f : static_cast<float>(value / std::sqrt(here * energy)));
    }
  }
  return out;
}

std::vector<GrayImage> WindowSearch::Correlate(const std::vector<GrayImage>& blocks) const {
  std::vector<GrayImage> found;
  for (std::size_t k = 0; k < blocks.size(); k += 2) {
    const GrayImage& one = blocks[k];
    const GrayImage* two = k + 1 < blocks.size() ? &blocks[k + 1] : nullptr;
    TELESTRAIN_CHECK(one.width <= width_ && one.height <= height_ &&
                         (!two || (two->width == one.width && two->height == one.height)),
                     "the blocks must be of one size and fit into the image");
    const Spectrum products = Products(one, two);
    found.push_back(Normalise(one, products, false));
    if (two) found.push_back(Normalise(*two, products, true));
  }
  return found;
}

CorrelationPeak FindPeak(const GrayImage& correlation, int apart) {
  CorrelationPeak peak;
  double second = 0;
  for (int y = 0; y < correlation.height; ++y)
    for (int x = 0; x < correlation.width; ++x)
      if (correlation.At(x, y) > peak.zncc) peak = {{x, y}, correlation.At(x, y), 0};
  for (int y = 0; y < correlation.height; ++y)
    for (int x = 0; x < correlation.width; ++x)
      if (std::abs(x - peak.at.x()) > apart || std::abs(y - peak.at.y()) > apart)
        second = std::max<double>(second, correlation.At(x, y));
  peak.margin = peak.zncc - second;
  return peak;
}

GrayImage ReduceByMean(const GrayImage& image, const PixelRegion& region, int factor) {
  GrayImage small{region.width / factor, region.height / factor, image.max_gray, {}};
  small.pixels.assign(static_cast<std::size_t>(small.width) * small.height, 0.f);
  const float weight = 1.f / static_cast<float>(factor * factor);
  std::vector<float> sums(static_cast<std::size_t>(small.width) * factor);
  for (int y = 0; y < small.height; ++y) {
    std::fill(sums.begin(), sums.end(), 0.f);
    for (int k = 0; k < factor; ++k) {
      const float* row =
          &image.pixels[static_cast<std::size_t>(region.y + y * factor + k) * image.width +
                        region.x];
      for (std::size_t x = 0; x < sums.size(); ++x) sums[x] += row[x];
    }
    for (int x = 0; x < small.width; ++x) {
      float sum = 0;
      for (int k = 0; k < factor; ++k) sum += sums[static_cast<std::size_t>(x) * factor + k];
      small.At(x, y) = sum * weight;
    }
  }
  return small;
}

GrayImage TurnedBlock(const GrayImage& image, const Eigen::Vector2d& center_px, int side_px,
                      double angle_rad) {
  GrayImage block{side_px, side_px, image.max_gray, {}};
  block.pixels.reserve(static_cast<std::size_t>(side_px) * side_px);
  const double c = std::cos(angle_rad), s = std::sin(angle_rad), half = 0.5 * (side_px - 1);
  for (int y = 0; y < side_px; ++y) {
    for (int x = 0; x < side_px; ++x) {
      const double dx = x - half, dy = y - half;
      const double at_x = std::clamp(center_px.x() + c * dx + s * dy, 0.0, image.width - 1.001);
      const double at_y = std::clamp(center_px.y() - s * dx + c * dy, 0.0, image.height - 1.001);
      const int left = static_cast<int>(at_x), top = static_cast<int>(at_y);
      const float fx = static_cast<float>(at_x - left), fy = static_cast<float>(at_y - top);
      const float above = (1 - fx) * image.At(left, top) + fx * image.At(left + 1, top);
      const float below = (1 - fx) * image.At(left, top + 1) + fx * image.At(left + 1, top + 1);
      block.pixels.push_back((1 - fy) * above + fy * below);
    }
  }
  return block;
}

}  // namespace telestrain::correlation
