#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "base/gray_image.h"
#include "session/session.h"

namespace telestrain::testing {

// A checkerboard on a plate as a telecentric view sees it, point-sampled after an isotropic
// Gaussian blur. Made for tests of the detector; shares no code with it.
struct BoardScene {
  int columns = 13, rows = 9;                                  // inner corners
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();         // of corner (0, 0)
  Eigen::Matrix2d side_px = 68 * Eigen::Matrix2d::Identity();  // of one square along x and y
  double blur_px = 0.8;
  double dark_gray = 30, bright_gray = 220, plate_gray = 180;
  bool first_square_bright = true;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  // relative, from the middle to the edge
  double noise_gray = 1.5;

  Eigen::Vector2d Corner(int column, int row) const {
    return origin_px + side_px * Eigen::Vector2d(column, row);
  }
};

// Edges at -1, 0, .., corners of one direction, blurred with `sigma` squares.
struct EdgeProfile {
  double alternating = 0;  // +1 in the square before edge 0, -1 behind it, ..; 0 off the board
  double inside = 0;       // 1 on the board

  static EdgeProfile At(double x, int corners, double sigma) {
    EdgeProfile profile;
    const int nearest = static_cast<int>(std::lround(x));
    const int reach = 1 + static_cast<int>(std::ceil(6 * sigma));
    const auto step = [&](double edge) {
      const double deviations = (x - edge) / sigma;
      if (std::abs(deviations) > 7) return deviations > 0 ? 1.0 : 0.0;
      return 0.5 * std::erfc(-deviations / std::numbers::sqrt2);
    };
    const int first = std::max(-1, nearest - reach), last = std::min(corners, nearest + reach);
    double sign = first % 2 == 0 ? -1 : 1;  // behind edge `first`
    if (first > -1 && first <= corners) {
      profile.alternating = -sign;
      profile.inside = 1;
    }
    for (int edge = first; edge <= last; ++edge, sign = -sign) {
      const double passed = step(edge);
      const bool is_end = edge == -1 || edge == corners;
      const double jump = edge == -1 ? sign : edge == corners ? sign : 2 * sign;
      profile.alternating += jump * passed;
      if (is_end) profile.inside += (edge == -1 ? 1 : -1) * passed;
    }
    return profile;
  }
};

// What the product of two blurred edges lacks when they are not perpendicular: 4 times the
// integral of the bivariate normal density over its correlation (Simpson's rule).
inline double ObliqueTerm(double h, double k, double rho) {
  constexpr int kSteps = 16;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double r = rho * i / kSteps, q = 1 - r * r;
    const double density = std::exp(-(h * h - 2 * r * h * k + k * k) / (2 * q)) /
                           (2 * std::numbers::pi * std::sqrt(q));
    sum += density * (i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2);
  }
  return 4 * sum * rho / (3 * kSteps);
}

// Approximately normal numbers, fast: a table drawn once.
class Noise {
 public:
  explicit Noise(std::uint32_t seed) : generator_(seed), table_(1 << 18) {
    std::normal_distribution<float> normal;
    for (float& value : table_) value = normal(generator_);
  }
  // Starts at another place of the table for every row.
  const float* Row(int width) {
    return table_.data() + generator_() % (table_.size() - static_cast<std::size_t>(width));
  }

 private:
  std::mt19937 generator_;
  std::vector<float> table_;
};

inline GrayImage Blank(int width, int height, float gray) {
  GrayImage image;
  image.width = width;
  image.height = height;
  image.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), gray);
  return image;
}

// Noise, rounding to whole levels and clipping to 0 .. 255.
inline void AddNoise(GrayImage* image, double sigma_gray, std::uint32_t seed) {
  Noise noise(seed);
  for (int y = 0; y < image->height; ++y) {
    const float* row = noise.Row(image->width);
    for (int x = 0; x < image->width; ++x)
      image->At(x, y) = std::clamp(
          std::round(image->At(x, y) + static_cast<float>(sigma_gray) * row[x]), 0.0F, 255.0F);
  }
}

// Draws the board into `region` (over what is there), without noise.
inline void DrawBoard(const BoardScene& scene, const PixelRegion& region, GrayImage* image) {
  const Eigen::Matrix2d to_board = scene.side_px.inverse();
  const Eigen::Vector2d per_square = to_board.rowwise().norm();  // squares per px across the edges
  const double rho = to_board.row(0).dot(to_board.row(1)) / (per_square.x() * per_square.y());
  const double mean = 0.5 * (scene.dark_gray + scene.bright_gray);
  const double half =
      (scene.first_square_bright ? 0.5 : -0.5) * (scene.bright_gray - scene.dark_gray);
  for (int y = region.y; y < region.y + region.height; ++y)
    for (int x = region.x; x < region.x + region.width; ++x) {
      const Eigen::Vector2d at = to_board * (Eigen::Vector2d(x, y) - scene.origin_px);
      const auto along = EdgeProfile::At(at.x(), scene.columns, scene.blur_px * per_square.x());
      const auto up = EdgeProfile::At(at.y(), scene.rows, scene.blur_px * per_square.y());
      double saddle = along.alternating * up.alternating;
      const double column = std::round(at.x()), row = std::round(at.y());
      const bool has_corner = column >= 0 && column < scene.columns && row >= 0 && row < scene.rows;
      const double h = (at.x() - column) / (scene.blur_px * per_square.x());
      const double k = (at.y() - row) / (scene.blur_px * per_square.y());
      if (has_corner && std::abs(h) < 5 && std::abs(k) < 5 && std::abs(rho) > 1e-9)
        saddle += (std::lround(column + row) % 2 == 0 ? 1 : -1) * ObliqueTerm(h, k, rho);
      const double on_board = along.inside * up.inside;
      const double gray = scene.plate_gray + on_board * (mean - scene.plate_gray) + half * saddle;
      const Eigen::Vector2d from_middle = (Eigen::Vector2d(x, y) - region.Middle()).array() /
                                          (0.5 * Eigen::Array2d(region.width, region.height));
      image->At(x, y) = static_cast<float>(gray * (1 + scene.gradient.dot(from_middle)));
    }
}

}  // namespace telestrain::testing
