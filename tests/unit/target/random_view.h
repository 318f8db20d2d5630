#pragma once

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "board_renderer.h"
#include "target/target_detector.h"

namespace telestrain::testing {

// A board in a random pose before one of many kinds of view, with the right answer.
struct RandomView {
  TargetSearch search;
  BoardScene scene;

  // Least distance of an inner corner (share 0) or of the outermost edges (1) from the region's
  // edge, px; negative: outside.
  double LeastDistanceToEdge_px(double beyond_squares) const {
    double least = 1e9;
    const PixelRegion& r = search.region;
    for (const double column : {-beyond_squares, scene.columns - 1 + beyond_squares})
      for (const double row : {-beyond_squares, scene.rows - 1 + beyond_squares}) {
        const Eigen::Vector2d p = scene.origin_px + scene.side_px * Eigen::Vector2d(column, row);
        least = std::min({least, p.x() - r.x, p.y() - r.y, r.x + r.width - 1 - p.x(),
                          r.y + r.height - 1 - p.y()});
      }
    return least;
  }
};

struct ViewLimits {
  double side_px = 68;  // of a square seen frontally
  PixelRegion region{40, 30, 1296, 972};
  double tilt_rad = 0.35;   // largest, beyond the view's own 30 deg
  double turn_rad = 0.785;  // largest, in the board's plane
  double shift_px = 60;
  double least_blur_px = 0.6, largest_blur_px = 3;
  double noise_gray = 1.5;
};

// Numbers that are the same with every compiler.
class Uniform {
 public:
  explicit Uniform(std::uint32_t seed) : generator_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(generator_()) + 0.5) / 4294967296.0;
  }
  bool OneIn(std::uint32_t count) { return generator_() % count == 0; }

 private:
  std::mt19937 generator_;
};

// Image axes of a view that looks 30 deg obliquely; turned by quarters and mirrored at will.
inline Eigen::Matrix<double, 2, 3> RandomViewAxes(Uniform& uniform) {
  const double obliquity = uniform.OneIn(2) ? 0.5236 : -0.5236;
  Eigen::Matrix<double, 2, 3> axes =
      Eigen::AngleAxisd(obliquity, Eigen::Vector3d::UnitX()).toRotationMatrix().topRows<2>();
  if (uniform.OneIn(2)) axes.row(0) *= -1;
  if (uniform.OneIn(4)) axes.row(0).swap(axes.row(1));
  const double quarters = std::floor(uniform(0, 4));
  return Eigen::Rotation2Dd(std::numbers::pi / 2 * quarters).toRotationMatrix() * axes;
}

// Sides of a square (px per square, 2x2) of a board turned and tilted at random, shortened to no
// less than a half.
inline Eigen::Matrix2d RandomSides(const ViewLimits& limits,
                                   const Eigen::Matrix<double, 2, 3>& axes, Uniform& uniform) {
  for (;;) {
    const double turn = uniform(-limits.turn_rad, limits.turn_rad);
    const double tilt = uniform(0, limits.tilt_rad), about = uniform(0, 2 * std::numbers::pi);
    const Eigen::Matrix3d rotation =
        (Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(about), std::sin(about), 0)) *
         Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()))
            .toRotationMatrix();
    const Eigen::Matrix2d sides = limits.side_px * axes * rotation.leftCols<2>();
    if (sides.jacobiSvd().singularValues()[1] >= 0.5 * limits.side_px) return sides;
  }
}

inline RandomView MakeRandomView(const ViewLimits& limits, std::uint32_t seed) {
  Uniform uniform(seed);
  const Eigen::Matrix<double, 2, 3> axes = RandomViewAxes(uniform);
  RandomView view;
  view.search.view = "V";
  view.search.region = limits.region;
  view.search.columns = view.scene.columns;
  view.search.rows = view.scene.rows;
  view.search.square_mm = 0.3;
  view.search.nominal_px_per_mm = limits.side_px / 0.3 * axes.leftCols<2>();

  view.scene.side_px = RandomSides(limits, axes, uniform);
  const Eigen::Vector2d middle(0.5 * (view.scene.columns - 1), 0.5 * (view.scene.rows - 1));
  const double shift_x = uniform(-limits.shift_px, limits.shift_px);
  const double shift_y = uniform(-limits.shift_px, limits.shift_px);
  view.scene.origin_px =
      limits.region.Middle() - view.scene.side_px * middle + Eigen::Vector2d(shift_x, shift_y);
  view.scene.blur_px = uniform(limits.least_blur_px, limits.largest_blur_px);
  view.scene.dark_gray = uniform(10, 60);
  view.scene.bright_gray = uniform(120, 190);
  view.scene.plate_gray = uniform(0, 200);
  view.scene.first_square_bright = uniform.OneIn(2);
  const double gradient_x = uniform(-0.2, 0.2), gradient_y = uniform(-0.2, 0.2);
  view.scene.gradient = Eigen::Vector2d(gradient_x, gradient_y);
  view.scene.noise_gray = limits.noise_gray;
  return view;
}

inline GrayImage Render(const RandomView& view, std::uint32_t seed) {
  const PixelRegion& r = view.search.region;
  GrayImage image = Blank(r.x + r.width + 10, r.y + r.height + 10, 128);
  DrawBoard(view.scene, r, &image);
  AddNoise(&image, view.scene.noise_gray, seed);
  return image;
}

}  // namespace telestrain::testing
