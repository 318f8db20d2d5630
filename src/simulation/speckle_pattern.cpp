#include "simulation/speckle_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/normal_share.h"
#include "simulation/random_stream.h"

namespace telestrain {
namespace {

constexpr double kRadiusSpread = 0.2;  // radii are uniform within +-20 % of the mean
constexpr double kCoverage = 0.5;
constexpr double kReach_sigma = 3.5;  // a disc's blurred edge ends here, below 2.4e-4
constexpr double kMargin_radii = 20;  // of discs around the patch

// Side of a cell that holds one disc on average: P(bare) = exp(-mean disc area / cell area).
double CellSide_mm(double mean_radius_mm) {
  const double mean_square =
      mean_radius_mm * mean_radius_mm * (1 + kRadiusSpread * kRadiusSpread / 3);
  return std::sqrt(std::numbers::pi * mean_square / -std::log(1 - kCoverage));
}

// Discs around a point, gathered in floats for the vector unit.
class DiscBlock {
 public:
  explicit DiscBlock(const Eigen::Matrix2d& cov_mm2)
      : xx_(static_cast<float>(cov_mm2(0, 0))),
        xy_(static_cast<float>(cov_mm2(0, 1))),
        yy_(static_cast<float>(cov_mm2(1, 1))) {}
  bool IsFull() const { return count_ == kSize; }
  void Add(double x_mm, double y_mm, float radius_mm) {
    x_mm_[count_] = static_cast<float>(x_mm);
    y_mm_[count_] = static_cast<float>(y_mm);
    radius_mm_[count_++] = radius_mm;
  }
  // Share of surface that they leave bare; empties the block.
  double Bare() {
    while (count_ % kVector != 0) Add(1, 1, 0);  // far away: changes nothing
    const float trace = xx_ + yy_, trace_of_square = xx_ * xx_ + 2 * xy_ * xy_ + yy_ * yy_;
    float beyond_sigma[kSize];  // of the edge
    for (int i = 0; i < count_; ++i) {
      const float x = x_mm_[i], y = y_mm_[i];
      // Mean and half the variance of the squared distance, then those of the distance.
      const float mean = x * x + y * y + trace;
      const float half = trace_of_square + 2 * (x * x * xx_ + 2 * x * y * xy_ + y * y * yy_);
      const float mean_root2 = std::sqrt(mean * mean - half);
      const float variance = half / (mean + mean_root2);
      beyond_sigma[i] = (std::sqrt(mean_root2) - radius_mm_[i]) / std::sqrt(variance);
    }
    double bare = 1;
    for (int i = 0; i < count_; ++i)
      if (beyond_sigma[i] < kReach_sigma) bare *= NormalShare(beyond_sigma[i]);
    count_ = 0;
    return bare;
  }

 private:
  static constexpr int kSize = 64, kVector = 4;
  float xx_, xy_, yy_;
  int count_ = 0;
  float x_mm_[kSize], y_mm_[kSize], radius_mm_[kSize];
};

}  // namespace

SpecklePattern::SpecklePattern(std::uint64_t key, const SurfacePatch& patch,
                               double mean_diameter_mm)
    : mean_radius_mm_(0.5 * mean_diameter_mm), cell_mm_(CellSide_mm(mean_radius_mm_)) {
  const double margin_mm = kMargin_radii * mean_radius_mm_;
  const auto cell_of = [this](double value_mm) {
    return static_cast<int>(std::floor(value_mm / cell_mm_));
  };
  first_column_ = cell_of(patch.lower_mm.x() - margin_mm);
  first_row_ = cell_of(patch.lower_mm.y() - margin_mm);
  columns_ = cell_of(patch.upper_mm.x() + margin_mm) - first_column_ + 1;
  rows_ = cell_of(patch.upper_mm.y() + margin_mm) - first_row_ + 1;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      FillCell(key, first_column_ + column, first_row_ + row);
  first_.push_back(static_cast<int>(x_mm_.size()));
}

void SpecklePattern::FillCell(std::uint64_t key, int column, int row) {
  RandomStream random(CombineKeys(CombineKeys(key, static_cast<std::uint32_t>(column)),
                                  static_cast<std::uint32_t>(row)));
  first_.push_back(static_cast<int>(x_mm_.size()));
  for (int left = random.Poisson(1.0); left > 0; --left) {
    const double x_mm = (column + random.Uniform()) * cell_mm_;
    const double y_mm = (row + random.Uniform()) * cell_mm_;
    const double radius_mm = mean_radius_mm_ * random.Uniform(1 - kRadiusSpread, 1 + kRadiusSpread);
    x_mm_.push_back(x_mm);
    y_mm_.push_back(y_mm);
    radius_mm_.push_back(static_cast<float>(radius_mm));
  }
}

double SpecklePattern::Paint(const Eigen::Vector2d& point_mm,
                             const Eigen::Matrix2d& cov_blur_mm2) const {
  const double xx = cov_blur_mm2(0, 0), yy = cov_blur_mm2(1, 1);
  const double radius_mm = mean_radius_mm_ * (1 + kRadiusSpread);
  const double reach_x = radius_mm + kReach_sigma * std::sqrt(xx);
  const double reach_y = radius_mm + kReach_sigma * std::sqrt(yy);
  const auto cell = [this](double value_mm, int first, int count) {
    return std::clamp(static_cast<int>(std::floor(value_mm / cell_mm_)) - first, 0, count - 1);
  };
  const int left = cell(point_mm.x() - reach_x, first_column_, columns_);
  const int right = cell(point_mm.x() + reach_x, first_column_, columns_);
  const int bottom = cell(point_mm.y() + reach_y, first_row_, rows_);
  DiscBlock block(cov_blur_mm2);
  double bare = 1;
  for (int row = cell(point_mm.y() - reach_y, first_row_, rows_); row <= bottom; ++row) {
    const int* cells = &first_[static_cast<std::size_t>(row) * columns_];
    for (int i = cells[left]; i < cells[right + 1]; ++i) {
      block.Add(point_mm.x() - x_mm_[i], point_mm.y() - y_mm_[i], radius_mm_[i]);
      if (block.IsFull()) bare *= block.Bare();
    }
  }
  return 1 - bare * block.Bare();
}

}  // namespace telestrain
