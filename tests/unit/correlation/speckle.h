#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

#include "base/gray_image.h"
#include "correlation/subset_correlation.h"

namespace telestrain {

// A pattern after the map: what was at `about` + d is seen at about + d + displacement + gradient
// d.
template <class Pattern>
GrayImage RenderPattern(const Pattern& pattern, int width, int height, const ShapeFunction& map,
                        const Eigen::Vector2d& about) {
  GrayImage image{width, height, 255, {}};
  const Eigen::Matrix2d inverse = (Eigen::Matrix2d::Identity() + map.gradient).inverse();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.pixels.push_back(static_cast<float>(
          pattern.At(about + inverse * (Eigen::Vector2d(x, y) - about - map.displacement_px))));
  return image;
}

// A speckle pattern given by a formula, so that a displaced image is as exact as the reference:
// round spots of random place and strength, each a Gaussian of the distance to its centre.
class Speckle {
 public:
  // Covers [-80, width + 80) x [-80, height + 80) px.
  Speckle(unsigned seed, int width, int height, double spot_px = 1.6)
      : cell_px_(5 * spot_px),
        columns_(static_cast<int>((width + 2 * kBeyond) / cell_px_) + 1),
        rows_(static_cast<int>((height + 2 * kBeyond) / cell_px_) + 1),
        spot_px_(spot_px),
        cells_(static_cast<std::size_t>(columns_) * rows_) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    constexpr int kSpotsPerCell = 4;
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column)
        for (int k = 0; k < kSpotsPerCell; ++k)
          cells_[static_cast<std::size_t>(row) * columns_ + column].push_back(
              {(column + uniform()) * cell_px_ - kBeyond, (row + uniform()) * cell_px_ - kBeyond,
               120 * uniform() - 60});
  }

  double At(const Eigen::Vector2d& at_px) const {
    const int column = static_cast<int>((at_px.x() + kBeyond) / cell_px_);
    const int row = static_cast<int>((at_px.y() + kBeyond) / cell_px_);
    double sum = 128;
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r)
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns_ - 1); ++c)
        for (const Spot& spot : cells_[static_cast<std::size_t>(r) * columns_ + c])
          sum += Value(spot, at_px);
    return sum;
  }

  GrayImage Render(int width, int height, const ShapeFunction& map = {},
                   const Eigen::Vector2d& about = Eigen::Vector2d::Zero()) const {
    return RenderPattern(*this, width, height, map, about);
  }

 private:
  static constexpr double kBeyond = 80;
  struct Spot {
    double x, y, gray;
  };

  // Cut off smoothly at five spot radii, the reach of the neighbouring cells.
  double Value(const Spot& spot, const Eigen::Vector2d& at) const {
    const double dx = at.x() - spot.x, dy = at.y() - spot.y;
    const double q = 0.5 * (dx * dx + dy * dy) / (spot_px_ * spot_px_);
    return q > 12.5 ? 0 : spot.gray * std::exp(-q);
  }

  double cell_px_;
  int columns_, rows_;
  double spot_px_;
  std::vector<std::vector<Spot>> cells_;
};

inline void AddNoise(double sigma_gray, std::mt19937& random, GrayImage& image) {
  if (!(sigma_gray > 0)) return;  // no normal distribution
  std::normal_distribution<float> noise(0, static_cast<float>(sigma_gray));
  for (float& value : image.pixels) value += noise(random);
}

// Where the map takes a centre and how: the truth of a match there.
inline ShapeFunction TruthAt(const ShapeFunction& map, const Eigen::Vector2d& about,
                             const Eigen::Vector2i& center_px) {
  return {map.displacement_px + map.gradient * (center_px.cast<double>() - about), map.gradient};
}

inline std::vector<Eigen::Vector2i> GridOfCenters(const PixelRegion& region, int margin_px,
                                                  int step_px) {
  std::vector<Eigen::Vector2i> centers;
  for (int y = region.y + margin_px; y < region.y + region.height - margin_px; y += step_px)
    for (int x = region.x + margin_px; x < region.x + region.width - margin_px; x += step_px)
      centers.push_back({x, y});
  return centers;
}

}  // namespace telestrain
