#include "simulation/speckle_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/random_stream.h"

namespace telestrain {
namespace {

constexpr double kRadiusSpread = 0.2;  // radii are uniform within +-20 % of the mean
constexpr double kCoverage = 0.5;
constexpr double kReach_sigma = 3.5;  // a disc's blurred edge ends here, below 2.4e-4

// Side of a cell that holds one disc on average: P(bare) = exp(-mean disc area / cell area).
double CellSide_mm(double mean_radius_mm) {
  const double mean_square =
      mean_radius_mm * mean_radius_mm * (1 + kRadiusSpread * kRadiusSpread / 3);
  return std::sqrt(std::numbers::pi * mean_square / -std::log(1 - kCoverage));
}

}  // namespace

SpecklePattern::SpecklePattern(std::uint64_t key, const SurfacePatch& patch,
                               double mean_diameter_mm, double blur_sigma_mm)
    : patch_(patch),
      mean_radius_mm_(0.5 * mean_diameter_mm),
      blur_sigma_mm_(blur_sigma_mm),
      cell_mm_(CellSide_mm(mean_radius_mm_)),
      lookup_mm_(0.5 * mean_diameter_mm) {
  const double reach_mm = 2 * mean_radius_mm_ + kReach_sigma * kMaxStretch * blur_sigma_mm_;
  const auto cell_of = [this](double value_mm) {
    return static_cast<int>(std::floor(value_mm / cell_mm_));
  };
  std::vector<Disc> discs;
  for (int row = cell_of(patch.lower_mm.y() - reach_mm);
       row <= cell_of(patch.upper_mm.y() + reach_mm); ++row)
    for (int column = cell_of(patch.lower_mm.x() - reach_mm);
         column <= cell_of(patch.upper_mm.x() + reach_mm); ++column)
      AddCell(key, column, row, discs);
  BuildLookup(discs);
}

void SpecklePattern::AddCell(std::uint64_t key, int column, int row,
                             std::vector<Disc>& discs) const {
  RandomStream random(CombineKeys(CombineKeys(key, static_cast<std::uint32_t>(column)),
                                  static_cast<std::uint32_t>(row)));
  for (int left = random.Poisson(1.0); left > 0; --left) {
    const double x_mm = (column + random.Uniform()) * cell_mm_;
    const double y_mm = (row + random.Uniform()) * cell_mm_;
    const double radius_mm = mean_radius_mm_ * random.Uniform(1 - kRadiusSpread, 1 + kRadiusSpread);
    discs.push_back(
        {static_cast<float>(x_mm), static_cast<float>(y_mm), static_cast<float>(radius_mm)});
  }
}

void SpecklePattern::BuildLookup(const std::vector<Disc>& discs) {
  const Eigen::Vector2d size_mm = patch_.upper_mm - patch_.lower_mm;
  columns_ = static_cast<int>(std::ceil(size_mm.x() / lookup_mm_));
  rows_ = static_cast<int>(std::ceil(size_mm.y() / lookup_mm_));
  const auto squares = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  // Calls visit(square) for every square that the disc can colour.
  const auto for_squares = [this](const Disc& disc, const auto& visit) {
    const double blur_mm = kReach_sigma * blur_sigma_mm_;
    const double x = disc.x_mm - patch_.lower_mm.x(), y = disc.y_mm - patch_.lower_mm.y();
    const double reach_x = disc.radius_mm + blur_mm,
                 reach_y = disc.radius_mm + kMaxStretch * blur_mm;
    const auto index = [this](double value_mm, int count) {
      return std::clamp(static_cast<int>(std::floor(value_mm / lookup_mm_)), -1, count);
    };
    for (int row = std::max(0, index(y - reach_y, rows_));
         row <= std::min(rows_ - 1, index(y + reach_y, rows_)); ++row)
      for (int column = std::max(0, index(x - reach_x, columns_));
           column <= std::min(columns_ - 1, index(x + reach_x, columns_)); ++column)
        visit(static_cast<std::size_t>(row) * columns_ + column);
  };
  first_.assign(squares + 1, 0);
  for (const Disc& disc : discs) for_squares(disc, [this](std::size_t i) { ++first_[i + 1]; });
  for (std::size_t i = 0; i < squares; ++i) first_[i + 1] += first_[i];
  near_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (const Disc& disc : discs) for_squares(disc, [&](std::size_t i) { near_[next[i]++] = disc; });
}

double SpecklePattern::Paint(const Eigen::Vector2d& point_mm, double stretch_y) const {
  const Eigen::Vector2d in_squares = (point_mm - patch_.lower_mm) / lookup_mm_;
  const int column = std::clamp(static_cast<int>(in_squares.x()), 0, columns_ - 1);
  const int row = std::clamp(static_cast<int>(in_squares.y()), 0, rows_ - 1);
  const auto square = static_cast<std::size_t>(row) * columns_ + column;
  const double stretch2 = std::min(stretch_y, kMaxStretch) * std::min(stretch_y, kMaxStretch);
  const double reach_mm = kReach_sigma * blur_sigma_mm_ * std::sqrt(stretch2);
  double bare = 1;
  for (int i = first_[square]; i < first_[square + 1]; ++i) {
    const Disc& disc = near_[i];
    const double x = point_mm.x() - disc.x_mm, y = point_mm.y() - disc.y_mm;
    const double radius = disc.radius_mm, distance2 = x * x + y * y;
    if (distance2 > (radius + reach_mm) * (radius + reach_mm)) continue;
    const double distance = std::sqrt(distance2);
    // Distance from the edge over the blur across it, sigma |(x, stretch y)| / distance. Inside,
    // the distance bends so that the quotient stays smooth in the middle of the disc.
    const double edge =
        distance < radius ? 0.5 * (radius * radius - distance2) : (radius - distance) * distance;
    const double inside_sigma =
        edge / (blur_sigma_mm_ * std::sqrt(x * x + stretch2 * y * y) + 1e-15);
    if (inside_sigma < -kReach_sigma) continue;
    bare *= 0.5 * std::erfc(inside_sigma * std::numbers::sqrt2 / 2);
  }
  return 1 - bare;
}

}  // namespace telestrain
