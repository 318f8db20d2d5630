#include "correlation/noise_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace telestrain::correlation {
namespace {

constexpr int kTile_px = 32;
constexpr int kReach_px = 2;  // of a fourth difference
constexpr int kMostTiles = 4096;
constexpr std::array<float, 5> kFourth = {1, -4, 6, -4, 1}, kSecond = {0, -1, 2, -1, 0};
// Largest share of what a pattern leaves in second differences that it leaves in fourth ones.
constexpr double kLargestShare = 0.6;
// Second differences of tiles with much and with little pattern must differ by this share of the
// latter for the pattern to be seen in them at all.
constexpr double kVisible = 0.2;

struct Tile {
  double fourth = 0, second = 0;  // variances, for a noise of one
  double slopes = 0;              // mean square of first differences: nearly all pattern
};

double Variance(const GrayImage& image, int left, int top, const std::array<float, 5>& weights) {
  double norm = 0, sum = 0;
  for (float a : weights) norm += static_cast<double>(a) * a;
  for (int y = top; y < top + kTile_px; ++y) {
    for (int x = left; x < left + kTile_px; ++x) {
      float value = 0;
      for (int j = 0; j < 5; ++j) {
        float row = 0;
        for (int i = 0; i < 5; ++i)
          row += weights[i] * image.At(x + i - kReach_px, y + j - kReach_px);
        value += weights[j] * row;
      }
      sum += static_cast<double>(value) * value;
    }
  }
  return sum / (kTile_px * kTile_px * norm * norm);
}

double Slopes(const GrayImage& image, int left, int top) {
  double sum = 0;
  for (int y = top; y < top + kTile_px; ++y) {
    for (int x = left; x < left + kTile_px; ++x) {
      const float right = image.At(x + 1, y) - image.At(x, y);
      const float down = image.At(x, y + 1) - image.At(x, y);
      sum += static_cast<double>(right) * right + static_cast<double>(down) * down;
    }
  }
  return sum;
}

bool IsUsable(const GrayImage& image, const PixelMask* mask, int left, int top) {
  for (int y = top - kReach_px; y < top + kTile_px + kReach_px; ++y) {
    for (int x = left - kReach_px; x < left + kTile_px + kReach_px; ++x) {
      const float value = image.At(x, y);
      if (!(value > 0) || !(value < image.max_gray) || (mask && !mask->At(x, y))) return false;
    }
  }
  return true;
}

std::vector<Tile> MeasureTiles(const GrayImage& image, const PixelRegion& region,
                               const PixelMask* mask) {
  const int across = (region.width - 2 * kReach_px) / kTile_px;
  const int down = (region.height - 2 * kReach_px) / kTile_px;
  std::vector<Tile> tiles;
  const long long all = static_cast<long long>(across) * std::max(0, down);
  const long long every = std::max(1LL, all / kMostTiles);
  for (long long k = 0; k < all; k += every) {
    const int left = region.x + kReach_px + static_cast<int>(k % across) * kTile_px;
    const int top = region.y + kReach_px + static_cast<int>(k / across) * kTile_px;
    if (!IsUsable(image, mask, left, top)) continue;
    tiles.push_back({Variance(image, left, top, kFourth), Variance(image, left, top, kSecond),
                     Slopes(image, left, top)});
  }
  return tiles;
}

Tile MeanOf(std::vector<Tile>::const_iterator first, std::vector<Tile>::const_iterator last) {
  Tile mean;
  const double count = static_cast<double>(last - first);
  for (; first != last; ++first) {
    mean.fourth += first->fourth / count;
    mean.second += first->second / count;
  }
  return mean;
}

}  // namespace

// With the noise variance s and what the pattern leaves, t in second and k t in fourth differences:
// fourth = s + k t, second = s + t, so fourth = (1 - k) s + k second. The slope k comes from the
// means of the third of the tiles with least and of the third with most pattern, told by first
// differences: sorted by the second ones, the tiles' noise would make a slope of its own.
double EstimateNoise_gray(const GrayImage& image, const PixelRegion& region,
                          const PixelMask* mask) {
  std::vector<Tile> tiles = MeasureTiles(image, region, mask);
  if (tiles.empty()) return 0;
  std::sort(tiles.begin(), tiles.end(),
            [](const Tile& a, const Tile& b) { return a.slopes < b.slopes; });
  const Tile all = MeanOf(tiles.begin(), tiles.end());
  const auto third = static_cast<std::ptrdiff_t>(tiles.size() / 3);
  double share = 0;
  if (third > 0) {
    const Tile low = MeanOf(tiles.begin(), tiles.begin() + third);
    const Tile high = MeanOf(tiles.end() - third, tiles.end());
    if (high.second > (1 + kVisible) * low.second)
      share =
          std::clamp((high.fourth - low.fourth) / (high.second - low.second), 0.0, kLargestShare);
  }
  const double variance = (all.fourth - share * all.second) / (1 - share);
  return std::sqrt(std::max(0.0, variance));
}

}  // namespace telestrain::correlation
