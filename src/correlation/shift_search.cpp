#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "correlation/float_vector.h"
#include "correlation/image_filters.h"
#include "correlation/subset_correlation.h"

namespace telestrain {

using namespace correlation;

namespace {

constexpr int kBlock = 32;               // side of a block, reduced pixels; a multiple of kLanes
constexpr int kBlocksAlong = 3;          // blocks in each direction
constexpr int kLargeRegion_px = 500;     // from here on reduced by 4, below by 2
constexpr double kMinContrast_gray = 2;  // rms of a block
constexpr double kMinMargin = 0.1;       // between the best and the second best peak

struct Position {
  int x, y;
};

struct Peak {
  Position shift{};
  double zncc = -1;
};

GrayImage Reduce(const GrayImage& image, int factor) {
  GrayImage small{image.width / factor, image.height / factor, image.max_gray, {}};
  small.pixels.reserve(static_cast<std::size_t>(small.width) * small.height);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      float sum = 0;
      for (int k = 0; k < factor * factor; ++k)
        sum += image.At(x * factor + k % factor, y * factor + k / factor);
      small.pixels.push_back(sum / static_cast<float>(factor * factor));
    }
  }
  return small;
}

// A square block of one image that is looked for in another one.
class BlockMatcher {
 public:
  BlockMatcher(const GrayImage& reference, const GrayImage& image, Position corner, int side)
      : image_(image), corner_(corner), side_(side) {
    double sum = 0;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) sum += reference.At(corner.x + x, corner.y + y);
    const float mean = static_cast<float>(sum / (side * side));
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        block_.push_back(reference.At(corner.x + x, corner.y + y) - mean);
    for (float value : block_) energy_ += static_cast<double>(value) * value;
    offset_ = mean;
  }

  double Contrast() const { return std::sqrt(energy_ / (side_ * side_)); }

  // Nothing where the shifted block leaves the image.
  std::optional<double> Zncc(Position shift) const {
    const int left = corner_.x + shift.x, top = corner_.y + shift.y;
    if (left < 0 || top < 0 || left + side_ > image_.width || top + side_ > image_.height)
      return std::nullopt;
    double t = 0, tt = 0, tf = 0;
    for (int y = 0; y < side_; ++y) {
      const float* row = &image_.pixels[static_cast<std::size_t>(top + y) * image_.width + left];
      const float* block = &block_[static_cast<std::size_t>(y) * side_];
      Float8 sum{}, squares{}, products{};
      for (int x = 0; x < side_; x += kLanes) {
        const Float8 value = Load(row + x) - offset_;
        sum += value;
        squares += value * value;
        products += value * Load(block + x);
      }
      t += SumLanes(sum);
      tt += SumLanes(squares);
      tf += SumLanes(products);
    }
    const double energy = tt - t * t / (side_ * side_);
    if (!(energy > 0) || !(energy_ > 0)) return 0.0;
    return tf / std::sqrt(energy * energy_);
  }

  // Of all shifts within `reach` of `around`.
  std::vector<Peak> Search(Position around, int reach) const {
    std::vector<Peak> all;
    for (int y = around.y - reach; y <= around.y + reach; ++y)
      for (int x = around.x - reach; x <= around.x + reach; ++x)
        if (const auto zncc = Zncc({x, y})) all.push_back({{x, y}, *zncc});
    return all;
  }

 private:
  const GrayImage& image_;
  Position corner_;
  int side_;
  float offset_ = 0;
  double energy_ = 0;
  std::vector<float> block_;
};

Peak Highest(const std::vector<Peak>& peaks) {
  Peak best;
  for (const Peak& peak : peaks)
    if (peak.zncc > best.zncc) best = peak;
  return best;
}

// The highest one that is not part of the hill around `best`.
Peak HighestBeside(const std::vector<Peak>& peaks, Position best) {
  std::vector<Peak> others;
  for (const Peak& peak : peaks)
    if (std::abs(peak.shift.x - best.x) > 2 || std::abs(peak.shift.y - best.y) > 2)
      others.push_back(peak);
  return Highest(others);
}

// Corners of blocks spread evenly, as far from the border as the shift asks and the size allows.
std::vector<Position> BlockCorners(int width, int height, int max_shift) {
  const auto along = [&](int length, int index) {
    const int margin = std::clamp((length - kBlock) / 2, 0, max_shift);
    return margin + (length - kBlock - 2 * margin) * index / (kBlocksAlong - 1);
  };
  std::vector<Position> corners;
  if (width < kBlock || height < kBlock) return corners;
  for (int k = 0; k < kBlocksAlong * kBlocksAlong; ++k)
    corners.push_back({along(width, k % kBlocksAlong), along(height, k / kBlocksAlong)});
  return corners;
}

struct Candidate {
  Peak peak;
  bool distinct = false;  // by its margin
  bool operator<(const Candidate& other) const {
    return distinct != other.distinct ? other.distinct : peak.zncc < other.peak.zncc;
  }
};

}  // namespace

ShiftSearch SearchShift(const GrayImage& reference, const GrayImage& image,
                        const PixelRegion& region, int max_shift_px) {
  const int factor = std::min(region.width, region.height) >= kLargeRegion_px ? 4 : 2;
  const GrayImage fine_reference = Crop(reference, region), fine_image = Crop(image, region);
  const GrayImage coarse_reference = Reduce(fine_reference, factor);
  const GrayImage coarse_image = Reduce(fine_image, factor);
  const int reach = (max_shift_px + factor - 1) / factor;

  Candidate best;
  for (const Position& corner :
       BlockCorners(coarse_reference.width, coarse_reference.height, reach)) {
    const BlockMatcher coarse(coarse_reference, coarse_image, corner, kBlock);
    if (!(coarse.Contrast() >= kMinContrast_gray)) continue;
    const auto peaks = coarse.Search({0, 0}, reach);
    const Peak first = Highest(peaks);
    const Peak second = HighestBeside(peaks, first.shift);
    const BlockMatcher fine(fine_reference, fine_image, {corner.x * factor, corner.y * factor},
                            kBlock * factor);
    const Position around{first.shift.x * factor, first.shift.y * factor};
    const Peak refined = Highest(fine.Search(around, factor));
    const Candidate candidate{refined, first.zncc - second.zncc >= kMinMargin};
    if (best < candidate) best = candidate;
  }
  if (best.peak.zncc <= 0) return {};
  return {Eigen::Vector2d(best.peak.shift.x, best.peak.shift.y), best.peak.zncc};
}

}  // namespace telestrain
