#include "correlation/seed_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "correlation/window_search.h"

namespace telestrain::correlation {
namespace {

constexpr int kReducedSide_px = 768;  // longest side that is searched
constexpr int kBlock_px = 32;         // side of a block, reduced pixels
constexpr int kBlocksAlong = 5;       // at most, in each direction
constexpr int kSamePeak_px = 2;       // reduced pixels: one hill of the correlation
constexpr double kSureMargin = 0.2;   // between the best and the second best peak
constexpr double kAngleStep_deg = 3;  // turns the edge of a block by less than half a pixel
constexpr int kFinestBlock_px = 65;   // largest block at full resolution
constexpr double kSlack_px = 3, kSlackPerPixel = 0.1;  // between blocks that support each other
constexpr std::size_t kEnoughToVote = 4;
constexpr double kAloneZncc = 0.9;

// A point whose surroundings are searched, and the best place so far.
struct Candidate {
  Eigen::Vector2i center_px;
  Eigen::Vector2d at_px = Eigen::Vector2d::Zero();  // of the centre in the image
  double angle_rad = 0, zncc = 0, margin = 0;
  bool Sure() const { return margin >= kSureMargin; }
};

// Cuts the part of an image within `reach` of a block of `side` about `at`, as far as it exists.
PixelRegion Window(const GrayImage& image, const Eigen::Vector2d& at, int side,
                   const Eigen::Vector2i& reach) {
  const Eigen::Vector2i corner = (at.array() - 0.5 * (side - 1)).round().cast<int>();
  const Eigen::Vector2i low = (corner - reach).cwiseMax(0);
  const Eigen::Vector2i high = (corner + reach + Eigen::Vector2i::Constant(side))
                                   .cwiseMin(Eigen::Vector2i(image.width, image.height));
  return {low.x(), low.y(), high.x() - low.x(), high.y() - low.y()};
}

// Searches one block at several angles and keeps the best.
class BlockSearch {
 public:
  BlockSearch(const GrayImage& reference, const GrayImage& image, int side)
      : reference_(reference), image_(image), side_(side) {}

  struct Best {
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    double angle_rad = 0, zncc = 0, margin = 0;
  };
  // `center` in the reference, `around` in the image.
  Best Find(const Eigen::Vector2d& center, const Eigen::Vector2d& around,
            const Eigen::Vector2i& reach, const std::vector<double>& angles_rad) const {
    Best best;
    const PixelRegion region = Window(image_, around, side_, reach);
    if (region.width < side_ || region.height < side_) return best;
    const WindowSearch window(ReduceByMean(image_, region, 1));
    std::vector<GrayImage> blocks;
    for (double angle : angles_rad) blocks.push_back(TurnedBlock(reference_, center, side_, angle));
    const std::vector<GrayImage> found = window.Correlate(blocks);
    for (std::size_t k = 0; k < found.size(); ++k) {
      const CorrelationPeak peak = FindPeak(found[k], kSamePeak_px);
      if (!(peak.zncc > best.zncc)) continue;
      const Eigen::Vector2d corner = (peak.at + Eigen::Vector2i(region.x, region.y)).cast<double>();
      best = {(corner.array() + 0.5 * (side_ - 1)).matrix(), angles_rad[k], peak.zncc, peak.margin};
    }
    return best;
  }

 private:
  const GrayImage& reference_;
  const GrayImage& image_;
  int side_;
};

// Of every cell of a coarse lattice over the points, the point nearest to its middle.
std::vector<Candidate> ChooseBlocks(const std::vector<Eigen::Vector2i>& centers) {
  Eigen::Vector2i low = centers[0], high = centers[0];
  for (const auto& center : centers) {
    low = low.cwiseMin(center);
    high = high.cwiseMax(center);
  }
  const Eigen::Vector2d cell =
      ((high - low).cast<double>() + Eigen::Vector2d::Ones()) / kBlocksAlong;
  std::map<std::pair<int, int>, std::pair<double, Eigen::Vector2i>> chosen;
  for (const auto& center : centers) {
    const Eigen::Vector2d place = (center - low).cast<double>().cwiseQuotient(cell);
    const Eigen::Vector2d whole = place.array().floor();
    const double off = (place - whole - Eigen::Vector2d::Constant(0.5)).norm();
    const std::pair<int, int> key(static_cast<int>(whole.y()), static_cast<int>(whole.x()));
    const auto [entry, added] = chosen.try_emplace(key, off, center);
    if (!added && off < entry->second.first) entry->second = {off, center};
  }
  std::vector<Candidate> blocks;
  for (const auto& [key, entry] : chosen) blocks.push_back({.center_px = entry.second});
  return blocks;
}

class SeedSearch {
 public:
  SeedSearch(const SeedReference& reference, const GrayImage& image, const FieldOptions& options)
      : reference_(reference),
        image_(image),
        options_(options),
        factor_(
            (std::max({image.width, image.height, reference.gray.width, reference.gray.height}) +
             kReducedSide_px - 1) /
            kReducedSide_px),
        coarse_reference_(Reduced(reference.gray)),
        coarse_image_(Reduced(image)) {}

  std::vector<KnownMatch> Run(const std::vector<Eigen::Vector2i>& centers) const {
    std::vector<Candidate> blocks = ChooseBlocks(centers);
    const int side = std::min({kBlock_px, coarse_reference_.width, coarse_reference_.height,
                               coarse_image_.width, coarse_image_.height});
    SearchCoarse(side, {0.0}, blocks);
    const auto sure = [](const Candidate& block) { return block.Sure(); };
    if (2 * std::count_if(blocks.begin(), blocks.end(), sure) <
        static_cast<std::ptrdiff_t>(blocks.size()))
      SearchCoarse(side, Angles(), blocks);
    Refine(blocks);
    return Elect(blocks);
  }

 private:
  GrayImage Reduced(const GrayImage& image) const {
    return ReduceByMean(image, {0, 0, image.width, image.height}, factor_);
  }
  double ToCoarse(double x) const { return (x + 0.5) / factor_ - 0.5; }
  double ToFine(double x) const { return (x + 0.5) * factor_ - 0.5; }

  std::vector<double> Angles() const {
    std::vector<double> angles;
    for (double deg = kAngleStep_deg; deg <= options_.max_rotation_deg; deg += kAngleStep_deg)
      for (double sign : {-1.0, 1.0}) angles.push_back(sign * deg * std::numbers::pi / 180);
    return angles;
  }

  // A better correlation than before is kept; blocks that are sure stay as they are.
  void SearchCoarse(int side, const std::vector<double>& angles_rad,
                    std::vector<Candidate>& blocks) const {
    const Eigen::Vector2i reach(
        static_cast<int>(std::ceil(options_.max_shift_share * coarse_image_.width)),
        static_cast<int>(std::ceil(options_.max_shift_share * coarse_image_.height)));
    const BlockSearch search(coarse_reference_, coarse_image_, side);
    if (angles_rad.empty()) return;
    ParallelFor(static_cast<int>(blocks.size()), options_.correlation.threads, [&](int i) {
      Candidate& block = blocks[i];
      if (block.Sure()) return;
      const Eigen::Vector2d inside = (block.center_px - reference_.origin_px).cast<double>();
      const Eigen::Vector2d center = inside.unaryExpr([&](double x) { return ToCoarse(x); });
      const Eigen::Vector2d whole =
          block.center_px.cast<double>().unaryExpr([&](double x) { return ToCoarse(x); });
      const auto best = search.Find(center, whole, reach, angles_rad);
      if (!(best.zncc > block.zncc)) return;
      block.at_px = best.at.unaryExpr([&](double x) { return ToFine(x); });
      block.angle_rad = best.angle_rad;
      block.zncc = best.zncc;
      block.margin = best.margin;
    });
  }

  void Refine(std::vector<Candidate>& blocks) const {
    const int side = std::min({kFinestBlock_px, options_.correlation.subset_px,
                               reference_.gray.width, reference_.gray.height});
    const BlockSearch search(reference_.gray, image_, side);
    ParallelFor(static_cast<int>(blocks.size()), options_.correlation.threads, [&](int i) {
      Candidate& block = blocks[i];
      if (!(block.zncc > 0)) return;
      const Eigen::Vector2d center = (block.center_px - reference_.origin_px).cast<double>();
      const auto best = search.Find(center, block.at_px, Eigen::Vector2i::Constant(factor_ + 2),
                                    {block.angle_rad});
      block.at_px = best.at;
      block.zncc = best.zncc;
    });
  }

  std::vector<KnownMatch> Elect(const std::vector<Candidate>& blocks) const {
    std::vector<KnownMatch> all, supported;
    for (const Candidate& block : blocks) {
      if (!(block.zncc >= options_.correlation.min_zncc / 2)) continue;
      KnownMatch seed{block.center_px, {}, block.zncc};
      seed.shape.displacement_px = block.at_px - block.center_px.cast<double>();
      const double c = std::cos(block.angle_rad), s = std::sin(block.angle_rad);
      seed.shape.gradient << c - 1, -s, s, c - 1;
      all.push_back(seed);
    }
    for (const KnownMatch& seed : all) {
      const auto supports = [&](const KnownMatch& other) {
        const double way = (other.center_px - seed.center_px).cast<double>().norm();
        const Eigen::Vector2d off =
            Continue(seed, other.center_px).displacement_px - other.shape.displacement_px;
        return way > 0 && off.norm() <= kSlack_px + kSlackPerPixel * way;
      };
      if (std::any_of(all.begin(), all.end(), supports)) supported.push_back(seed);
    }
    if (all.size() >= kEnoughToVote) {
      // The best of many places looks like a match now and then; one that stands alone must be
      // good.
      if (supported.empty())
        for (const KnownMatch& seed : all)
          if (seed.zncc >= kAloneZncc) supported.push_back(seed);
      all = std::move(supported);
    }
    // Nothing found: at rest is as good a guess as any.
    if (all.empty())
      for (const Candidate& block : blocks) all.push_back({block.center_px, {}, 0});
    return all;
  }

  const SeedReference& reference_;
  const GrayImage& image_;
  const FieldOptions& options_;
  int factor_;
  GrayImage coarse_reference_, coarse_image_;
};

}  // namespace

std::vector<KnownMatch> SearchSeeds(const SeedReference& reference, const GrayImage& image,
                                    const std::vector<Eigen::Vector2i>& centers_px,
                                    const FieldOptions& options) {
  if (centers_px.empty()) return {};
  return SeedSearch(reference, image, options).Run(centers_px);
}

}  // namespace telestrain::correlation
