#pragma once

#include <Eigen/Core>

#include "target/block_sums.h"

namespace telestrain {

// The pixels near one of a saddle's two edge lines and far from the other, where the saddle is the
// one edge's blurred profile, and the sums of their least-squares problem. Errors of the model:
// 1e-6 of the grey levels.
class EdgeStrip {
 public:
  // Order of the columns: a, gx, gy, c, cx, cy, x0, y0, the line's angle, log blur.
  static constexpr int kColumns = 10;

  // The line at one set of parameters: normal, its derivative by the angle, 1 / blur.
  struct Line {
    Eigen::Vector2d center_px, normal, turned_normal;
    double inverse_blur = 1;
  };
  struct Sums {
    Eigen::Matrix<double, kColumns, kColumns> normal;  // lower triangle
    Eigen::Matrix<double, kColumns, 1> gradient;
    double cost = 0;
  };

  // The side (+1, -1) of the other line.
  BlockPixels& pixels() { return pixels_; }

  // `linear`: a, gx, gy, c, cx, cy.
  Sums At(const Line& line, const Eigen::Matrix<double, 6, 1>& linear) const;

 private:
  BlockPixels pixels_;
};

}  // namespace telestrain
