#pragma once

#include <algorithm>

#include "tests/unit/correlation/speckle.h"

namespace telestrain {

// Paint-like speckle given by a formula: black discs on white, half of the area painted, whose
// edges are the integral of a Gaussian. 0.7 px is an edge as lens and pixel leave it: from 10 to
// 90 % in 1.8 px. The sharper the edge, the more detail aliases between the pixels.
class PaintedDiscs {
 public:
  static constexpr double kWhite_gray = 210, kBlack_gray = 40;

  PaintedDiscs(unsigned seed, int width, int height, double edge_px = 0.7)
      : edge_px_(edge_px),
        columns_(static_cast<int>((width + 2 * kBeyond) / kCell_px) + 1),
        rows_(static_cast<int>((height + 2 * kBeyond) / kCell_px) + 1),
        cells_(static_cast<std::size_t>(columns_) * rows_) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    const int discs = static_cast<int>(columns_ * kCell_px * rows_ * kCell_px / kAreaPerDisc_px2);
    for (int k = 0; k < discs; ++k) {
      const double x = uniform() * columns_, y = uniform() * rows_;  // in cells
      cells_[static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x)].push_back(
          {x * kCell_px - kBeyond, y * kCell_px - kBeyond, 1.5 + 2 * uniform()});
    }
  }

  double At(const Eigen::Vector2d& at_px) const {
    const int column = static_cast<int>((at_px.x() + kBeyond) / kCell_px);
    const int row = static_cast<int>((at_px.y() + kBeyond) / kCell_px);
    double bare = 1;  // what no disc covers
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r)
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns_ - 1); ++c)
        for (const Disc& disc : cells_[static_cast<std::size_t>(r) * columns_ + c])
          bare *= Bare(disc, at_px);
    return kBlack_gray + (kWhite_gray - kBlack_gray) * bare;
  }

  GrayImage Render(int width, int height, const ShapeFunction& map = {},
                   const Eigen::Vector2d& about = Eigen::Vector2d::Zero()) const {
    return RenderPattern(*this, width, height, map, about);
  }

 private:
  struct Disc {
    double x, y, radius;
  };
  // A disc reaches 3.5 px and five times its edge.
  static constexpr double kBeyond = 80, kCell_px = 8, kAreaPerDisc_px2 = 30;

  double Bare(const Disc& disc, const Eigen::Vector2d& at) const {
    const double beyond = std::hypot(at.x() - disc.x, at.y() - disc.y) - disc.radius;
    if (beyond > 5 * edge_px_) return 1;
    return 0.5 * std::erfc(-beyond / (std::sqrt(2.) * edge_px_));
  }

  double edge_px_;
  int columns_, rows_;
  std::vector<std::vector<Disc>> cells_;
};

}  // namespace telestrain
