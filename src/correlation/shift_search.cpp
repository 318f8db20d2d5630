#include <algorithm>
#include <cmath>
#include <vector>

#include "correlation/subset_correlation.h"
#include "correlation/window_search.h"

namespace telestrain {

using namespace correlation;

namespace {

constexpr int kBlock = 32;               // side of a block, reduced pixels
constexpr int kBlocksAlong = 3;          // blocks in each direction
constexpr int kLargeRegion_px = 500;     // from here on reduced by 4, below by 2
constexpr double kMinContrast_gray = 2;  // rms of a block
constexpr int kSamePeak = 2;             // reduced pixels: one hill of the correlation

struct Vote {
  Eigen::Vector2i corner, shift;  // reduced pixels
  double zncc = 0;
};

GrayImage CropSquare(const GrayImage& image, const Eigen::Vector2i& corner, int side) {
  return ReduceByMean(image, {corner.x(), corner.y(), side, side}, 1);
}

double Contrast(const GrayImage& block) {
  double sum = 0, squares = 0;
  for (float value : block.pixels) {
    sum += value;
    squares += static_cast<double>(value) * value;
  }
  const double count = static_cast<double>(block.pixels.size());
  return std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
}

// The part of the image where the block can be found within `reach`, as far as it exists.
Vote Search(const GrayImage& block, const GrayImage& image, const Eigen::Vector2i& corner,
            const Eigen::Vector2i& around, int reach) {
  const Eigen::Vector2i size(image.width, image.height);
  const Eigen::Vector2i low = (corner + around).array() - reach;
  const Eigen::Vector2i from = low.cwiseMax(0);
  const Eigen::Vector2i to = (low.array() + (2 * reach + block.width)).matrix().cwiseMin(size);
  Vote vote{corner, around, 0};
  if ((to - from).minCoeff() < block.width) return vote;
  const WindowSearch window(
      ReduceByMean(image, {from.x(), from.y(), (to - from).x(), (to - from).y()}, 1));
  const CorrelationPeak peak = FindPeak(window.Correlate({block}).front(), kSamePeak);
  vote.shift = from + peak.at - corner;
  vote.zncc = peak.zncc;
  return vote;
}

// Corners of blocks spread evenly, as far from the border as the shift asks and the size allows.
std::vector<Eigen::Vector2i> BlockCorners(int width, int height, int max_shift) {
  const auto along = [&](int length, int index) {
    const int margin = std::clamp((length - kBlock) / 2, 0, max_shift);
    return margin + (length - kBlock - 2 * margin) * index / (kBlocksAlong - 1);
  };
  std::vector<Eigen::Vector2i> corners;
  if (width < kBlock || height < kBlock) return corners;
  for (int k = 0; k < kBlocksAlong * kBlocksAlong; ++k)
    corners.push_back({along(width, k % kBlocksAlong), along(height, k / kBlocksAlong)});
  return corners;
}

// The best correlated of the blocks that agree with most correlation.
Vote Elect(const std::vector<Vote>& votes) {
  Vote best;
  double best_support = 0;
  for (const Vote& vote : votes) {
    double support = 1e-6 * vote.zncc;
    for (const Vote& other : votes)
      if ((vote.shift - other.shift).cwiseAbs().maxCoeff() <= kSamePeak)
        support += other.zncc * other.zncc;
    if (!(support > best_support)) continue;
    best_support = support;
    best = vote;
  }
  return best;
}

}  // namespace

ShiftSearch SearchShift(const GrayImage& reference, const GrayImage& image,
                        const PixelRegion& region, int max_shift_px) {
  const int factor = std::min(region.width, region.height) >= kLargeRegion_px ? 4 : 2;
  const GrayImage coarse_reference = ReduceByMean(reference, region, factor);
  const GrayImage coarse_image = ReduceByMean(image, region, factor);
  const int reach = (max_shift_px + factor - 1) / factor;
  std::vector<Vote> votes;
  for (const auto& corner : BlockCorners(coarse_reference.width, coarse_reference.height, reach)) {
    const GrayImage block = CropSquare(coarse_reference, corner, kBlock);
    if (!(Contrast(block) >= kMinContrast_gray)) continue;
    votes.push_back(Search(block, coarse_image, corner, {0, 0}, reach));
  }
  const Vote coarse = Elect(votes);
  if (!(coarse.zncc > 0)) return {};
  const Eigen::Vector2i origin(region.x, region.y), corner = origin + factor * coarse.corner;
  const GrayImage block = CropSquare(reference, corner, kBlock * factor);
  const Vote fine = Search(block, image, corner, factor * coarse.shift, factor);
  if (!(fine.zncc > 0)) return {};
  return {fine.shift.cast<double>(), fine.zncc};
}

}  // namespace telestrain
