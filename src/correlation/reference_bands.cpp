#include "correlation/reference_bands.h"

#include <algorithm>

#include "base/parallel.h"
#include "correlation/noise_shares.h"

namespace telestrain::correlation {
namespace {

constexpr int kPointsPerTask = 16;
constexpr int kFilterReach_px = 64;  // more than blur, spline and slopes need together
constexpr int kSmallestBand_px = 64;

}  // namespace

ReferenceBands::ReferenceBands(const CorrelationReference& whole)
    : options_(whole.options()), whole_(&whole, [](const CorrelationReference*) {}) {}

ReferenceBands::ReferenceBands(const GrayImage& image, const FieldOptions& options,
                               const PixelMask* mask)
    : options_(options.correlation), image_(&image), mask_(mask) {
  const std::size_t rows = options.max_band_pixels / static_cast<std::size_t>(image.width);
  band_rows_ = static_cast<int>(
      std::clamp<std::size_t>(rows, kSmallestBand_px, static_cast<std::size_t>(1) << 30));
  if (band_rows_ >= image.height)
    whole_ = std::make_shared<const CorrelationReference>(Prepare(0, image.height));
}

CorrelationReference ReferenceBands::Prepare(int first_row, int last_row) const {
  const int reach = options_.subset_px / 2 + kFilterReach_px;
  const int top = std::max(0, first_row - reach) / NoiseShares::kTile_px * NoiseShares::kTile_px;
  const int bottom = std::min(image_->height, last_row + reach);
  return {*image_, {0, top, image_->width, bottom - top}, options_, mask_};
}

// A task's worth of points is matched one after the other; only then the rows may be shared.
int ReferenceBands::RowThreads(std::size_t points) const {
  return points <= kPointsPerTask ? options_.threads : 1;
}

void ReferenceBands::ForEach(const std::vector<Eigen::Vector2i>& centers_px,
                             const std::vector<int>& points, const Work& work) const {
  const auto run = [&](const CorrelationReference& reference, const std::vector<int>& some) {
    const int count = static_cast<int>(some.size());
    ParallelFor((count + kPointsPerTask - 1) / kPointsPerTask, options_.threads, [&](int task) {
      const int end = std::min(count, (task + 1) * kPointsPerTask);
      for (int k = task * kPointsPerTask; k < end; ++k) work(reference, some[k]);
    });
  };
  if (whole_) return run(*whole_, points);
  std::vector<std::vector<int>> bands((image_->height + band_rows_ - 1) / band_rows_);
  for (int point : points) {
    const int row = std::clamp(centers_px[point].y(), 0, image_->height - 1);
    bands[row / band_rows_].push_back(point);
  }
  for (int band = 0; band < static_cast<int>(bands.size()); ++band) {
    if (bands[band].empty()) continue;
    run(Prepare(band * band_rows_, std::min(image_->height, (band + 1) * band_rows_)), bands[band]);
  }
}

}  // namespace telestrain::correlation
