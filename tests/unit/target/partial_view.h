#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "random_view.h"

namespace telestrain::testing {

// A board that the view's edge cuts off and that hands, bars and discs cover, with the truth about
// what of it is to be seen.
struct PartialView {
  RandomView view;
  GrayImage image;
  std::vector<bool> covered;  // as image.pixels

  bool IsClear(const Eigen::Vector2d& at) const {
    const PixelRegion& r = view.search.region;
    const int x = static_cast<int>(std::lround(at.x())), y = static_cast<int>(std::lround(at.y()));
    return x > r.x && y > r.y && x < r.x + r.width - 1 && y < r.y + r.height - 1 &&
           !covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                    static_cast<std::size_t>(x)];
  }
  // Whether the parallelogram of the given half sides (squares) about a place is to be seen.
  bool IsClear(double column, double row, double half_x, double half_y) const {
    for (int a = -4; a <= 4; ++a)
      for (int b = -4; b <= 4; ++b)
        if (!IsClear(view.scene.origin_px +
                     view.scene.side_px *
                         Eigen::Vector2d(column + half_x * a / 4, row + half_y * b / 4)))
          return false;
    return true;
  }
  bool SeesCorner(int column, int row) const {
    return column >= 0 && row >= 0 && column < view.scene.columns && row < view.scene.rows &&
           IsClear(column, row, 0.5, 0.5);
  }
  int CornersSeen() const {
    int seen = 0;
    for (int row = 0; row < view.scene.rows; ++row)
      for (int column = 0; column < view.scene.columns; ++column) seen += SeesCorner(column, row);
    return seen;
  }
  // Six squares of a border in a row beside corners that are to be seen, and most of all.
  bool SeesBorder(bool along_column, bool at_last) const {
    const int lines = along_column ? view.scene.columns : view.scene.rows;
    const int places = along_column ? view.scene.rows : view.scene.columns;
    const int line = at_last ? lines - 1 : 0, border = at_last ? lines : -1;
    int seen = 0, beside = 0;
    for (int place = -1; place < places; ++place) {
      const double middle = place + 0.5;
      const bool corner = along_column ? SeesCorner(line, place) || SeesCorner(line, place + 1)
                                       : SeesCorner(place, line) || SeesCorner(place + 1, line);
      const bool clear =
          along_column ? IsClear(border, middle, 0.5, 0.5) : IsClear(middle, border, 0.5, 0.5);
      beside += corner;
      seen += corner && clear;
    }
    return seen >= 6 && seen >= 0.75 * beside;
  }
};

namespace partial {

// Paints where `is_inside(point)`; hard edges, as of something before the lens's focus blurred by
// the pixel alone.
template <typename IsInside>
void Paint(const IsInside& is_inside, float gray, PartialView* view) {
  for (int y = 0; y < view->image.height; ++y)
    for (int x = 0; x < view->image.width; ++x) {
      if (!is_inside(Eigen::Vector2d(x, y))) continue;
      view->image.At(x, y) = gray;
      view->covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(view->image.width) +
                    static_cast<std::size_t>(x)] = true;
    }
}

// A rectangle, a disc or four fingers; every other rectangle is turned as the board is.
inline void Cover(Uniform& uniform, PartialView* view) {
  const PixelRegion& r = view->view.search.region;
  const BoardScene& scene = view->view.scene;
  const Eigen::Vector2d at(r.x + uniform(0, r.width), r.y + uniform(0, r.height));
  const double levels[] = {uniform(0, 255), scene.plate_gray, scene.dark_gray, scene.bright_gray};
  const double choice = uniform(0, 10);  // often a level of the board itself
  const auto gray = static_cast<float>(levels[choice < 7 ? 0 : static_cast<int>(choice) - 6]);
  const double kind = uniform(0, 3);
  double angle = uniform(0, std::numbers::pi);
  if (uniform.OneIn(2)) angle = std::atan2(scene.side_px(1, 0), scene.side_px(0, 0));
  const double half_length = uniform(0.1, 0.5) * r.width,
               half_width = uniform(0.02, 0.25) * r.width;
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  if (kind < 1) {
    Paint(
        [&](const auto& p) {
          return std::abs(along.dot(p - at)) < half_length &&
                 std::abs(across.dot(p - at)) < half_width;
        },
        gray, view);
  } else if (kind < 2) {
    Paint([&](const auto& p) { return (p - at).norm() < half_width; }, gray, view);
  } else {
    const double finger = uniform(0.02, 0.05) * r.width;
    Paint(
        [&](const auto& p) {
          const double u = along.dot(p - at), v = across.dot(p - at) / finger;
          const double end = finger * (2 * std::sin(1.7 * std::floor(v / 2.3)));  // unequal lengths
          const double from_middle = std::abs(std::remainder(v - 1.15, 2.3));
          return std::abs(v) < 4.6 && from_middle < 1 &&
                 u > end - finger * std::sqrt(1 - from_middle * from_middle);
        },
        gray, view);
  }
}

}  // namespace partial

struct PartialLimits {
  double side_px = 18;
  PixelRegion region{5, 3, 330, 250};
  double noise_gray = -1;  // negative: 0.5 to 5 at random
};

inline PartialView MakePartialView(const PartialLimits& partial_limits, std::uint32_t seed) {
  ViewLimits limits;
  limits.side_px = partial_limits.side_px;
  limits.region = partial_limits.region;
  limits.tilt_rad = 0.785;
  limits.turn_rad = 0.7;
  limits.shift_px = 0.4 * limits.region.width;
  limits.least_blur_px = 0.6;
  limits.largest_blur_px = 1.3;
  PartialView partial_view;
  RandomView& view = partial_view.view;
  view = MakeRandomView(limits, seed);
  Uniform uniform(seed + 77777);
  view.scene.gradient = {uniform(-0.3, 0.3), uniform(-0.3, 0.3)};
  view.scene.noise_gray =
      partial_limits.noise_gray < 0 ? uniform(0.5, 5) : partial_limits.noise_gray;
  view.scene.dark_gray = uniform(15, 70);
  view.scene.bright_gray = uniform(130, 180);
  const bool bright_plate = uniform.OneIn(2);
  if (!uniform.OneIn(6))
    view.scene.plate_gray = bright_plate ? view.scene.bright_gray : view.scene.dark_gray;
  const PixelRegion& r = limits.region;
  partial_view.image = Blank(r.x + r.width + 10, r.y + r.height + 10, 128);
  partial_view.covered.assign(partial_view.image.pixels.size(), false);
  DrawBoard(view.scene, r, &partial_view.image);
  const int covers = static_cast<int>(uniform(0, 3));
  for (int i = 0; i < covers; ++i) partial::Cover(uniform, &partial_view);
  AddNoise(&partial_view.image, view.scene.noise_gray, seed);
  return partial_view;
}

}  // namespace telestrain::testing
