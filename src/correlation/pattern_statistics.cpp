#include "correlation/pattern_statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "correlation/image_filters.h"
#include "correlation/noise_estimate.h"

namespace telestrain::correlation {
namespace {

constexpr int kTile_px = 96;
constexpr int kMargin_px = 16;   // for the blurs, around a tile
constexpr int kMostTiles = 400;  // 3.7 Mpx know every figure to less than a percent
constexpr int kLags_px = 48;
// Fourth-order central difference.
const std::vector<float> kSlope = {1.f / 12, -8.f / 12, 0.f, 8.f / 12, -1.f / 12};

// Sums over tiles, of pixels and of pairs of pixels.
struct Sums {
  double pixels = 0, saturated = 0;
  double slopes = 0, blurred = 0, twice = 0;                          // squared gradients, x and y
  std::vector<double> products = std::vector<double>(kLags_px, 0.0);  // by lag, x and y
  std::vector<double> pairs = std::vector<double>(kLags_px, 0.0);
};

// What white noise of variance one leaves in the square of a filter's result.
double NoiseOf(const std::vector<float>& blur, int times) {
  std::vector<float> along = {1.f};
  const auto convolve = [](const std::vector<float>& a, const std::vector<float>& b) {
    std::vector<float> c(a.size() + b.size() - 1, 0.f);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t k = 0; k < b.size(); ++k) c[i + k] += a[i] * b[k];
    return c;
  };
  for (int k = 0; k < times; ++k) along = convolve(along, blur);
  return NoiseVarianceAfter(along) * NoiseVarianceAfter(convolve(along, kSlope));
}

class PatternMeter {
 public:
  PatternMeter(const GrayImage& image, const PixelMask* mask, double prefilter_sigma_px)
      : image_(image), mask_(mask), blur_(GaussianKernel(prefilter_sigma_px)) {}

  void AddTile(const PixelRegion& tile, Sums& sums) const {
    const int left = std::max(0, tile.x - kMargin_px), top = std::max(0, tile.y - kMargin_px);
    const int right = std::min(image_.width, tile.x + tile.width + kMargin_px);
    const int bottom = std::min(image_.height, tile.y + tile.height + kMargin_px);
    const GrayImage around = Crop(image_, {left, top, right - left, bottom - top});
    const PixelRegion inner{tile.x - left, tile.y - top, tile.width, tile.height};
    const std::vector<char> counts = Counts(tile, sums);
    AddPairs(around, inner, counts, sums);
    sums.slopes += Squares(around, inner, counts);
    const GrayImage once = Blur(around, blur_);
    sums.blurred += Squares(once, inner, counts);
    sums.twice += Squares(Blur(once, blur_), inner, counts);
  }

  const std::vector<float>& blur() const { return blur_; }

 private:
  // Which pixels of a tile are inside the mask.
  std::vector<char> Counts(const PixelRegion& tile, Sums& sums) const {
    std::vector<char> counts;
    for (int y = tile.y; y < tile.y + tile.height; ++y)
      for (int x = tile.x; x < tile.x + tile.width; ++x) {
        counts.push_back(!mask_ || mask_->At(x, y));
        if (!counts.back()) continue;
        const float value = image_.At(x, y);
        sums.pixels += 1;
        sums.saturated += !(value > 0) || !(value < image_.max_gray);
      }
    return counts;
  }

  static double Squares(const GrayImage& image, const PixelRegion& inner,
                        const std::vector<char>& counts) {
    double sum = 0;
    for (const GrayImage& slope : {Filtered(image, kSlope, {1.f}), Filtered(image, {1.f}, kSlope)})
      for (int k = 0; k < inner.width * inner.height; ++k) {
        const float value = slope.At(inner.x + k % inner.width, inner.y + k / inner.width);
        if (counts[k]) sum += static_cast<double>(value) * value;
      }
    return sum;
  }

  static void AddPairs(const GrayImage& image, const PixelRegion& inner,
                       const std::vector<char>& counts, Sums& sums) {
    double mean = 0, count = 0;
    std::vector<float> values;
    for (int k = 0; k < inner.width * inner.height; ++k) {
      values.push_back(image.At(inner.x + k % inner.width, inner.y + k / inner.width));
      mean += counts[k] ? values.back() : 0;
      count += counts[k];
    }
    if (!(count > 0)) return;
    for (float& value : values) value -= static_cast<float>(mean / count);
    for (int lag = 0; lag < kLags_px; ++lag)
      for (const bool down : {false, true}) {
        const int dx = down ? 0 : lag, dy = down ? lag : 0;
        for (int y = 0; y + dy < inner.height; ++y)
          for (int x = 0; x + dx < inner.width; ++x) {
            const int a = y * inner.width + x, b = a + dy * inner.width + dx;
            if (!counts[a] || !counts[b]) continue;
            sums.products[lag] += static_cast<double>(values[a]) * values[b];
            sums.pairs[lag] += 1;
          }
      }
  }

  const GrayImage& image_;
  const PixelMask* mask_;
  std::vector<float> blur_;
};

// Twice the lag at which the autocorrelation falls to half; the noise is only in that of lag zero.
double FullWidth(const Sums& sums, double variance) {
  double before = variance;
  for (int lag = 1; lag < kLags_px; ++lag) {
    if (!(sums.pairs[lag] > 0)) return 0;
    const double here = sums.products[lag] / sums.pairs[lag];
    if (here < variance / 2)
      return 2 * (lag - 1 + (before - variance / 2) / std::max(before - here, 1e-12));
    before = here;
  }
  return 2.0 * kLags_px;
}

Sums MeasureTiles(const PatternMeter& meter, const PixelRegion& region) {
  const int side_x = std::min(kTile_px, region.width), side_y = std::min(kTile_px, region.height);
  const int across = region.width / side_x, down = region.height / side_y;
  const int every = std::max(1, across * down / kMostTiles);
  Sums sums;
  for (int k = 0; k < across * down; k += every)
    meter.AddTile({region.x + k % across * side_x, region.y + k / across * side_y, side_x, side_y},
                  sums);
  return sums;
}

}  // namespace

PatternStatistics MeasurePattern(const GrayImage& image, const PixelRegion& region,
                                 const PixelMask* mask, double prefilter_sigma_px) {
  const PatternMeter meter(image, mask, prefilter_sigma_px);
  const Sums sums = MeasureTiles(meter, region);
  PatternStatistics found;
  if (!(sums.pixels > 0)) return found;
  found.noise_gray = EstimateNoise_gray(image, region, mask);
  const double noise = found.noise_gray * found.noise_gray;
  const auto component = [&](double squares, int blurs) {
    return std::max(squares / (2 * sums.pixels) - noise * NoiseOf(meter.blur(), blurs), 1e-12);
  };
  const double variance = std::max(0.0, sums.products[0] / sums.pairs[0] - noise);
  found.contrast_gray = std::sqrt(variance);
  found.saturated_share = sums.saturated / sums.pixels;
  found.speckle_px = variance > noise * 1e-3 && variance > 0 ? FullWidth(sums, variance) : 0;
  found.gradient_gray_per_px = std::sqrt(component(sums.slopes, 0));
  found.noise_gain = component(sums.twice, 2) / std::pow(component(sums.blurred, 1), 2);
  return found;
}

double OrderVariance(int shape_order) { return shape_order < 2 ? 1 : 3.5; }

}  // namespace telestrain::correlation
