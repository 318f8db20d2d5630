#pragma once

#include <Eigen/Core>

#include "target/block_sums.h"
#include "target/blurred_saddle.h"

namespace telestrain {

// The pixels near both edge lines of a saddle and the sums of their least-squares problem. Errors
// of the model: 2e-6 of the grey levels.
class EdgeCrossing {
 public:
  // Order of the columns: a, gx, gy, c, cx, cy, x0, y0, angles of the lines u and v, log blur.
  static constexpr int kColumns = 11;

  // The lines at one set of parameters: normals, their derivatives by the angles, 1 / blur.
  struct Lines {
    Eigen::Vector2d center_px, normal_u, normal_v, turned_u, turned_v;
    double inverse_blur = 1;
  };
  struct Sums {
    Eigen::Matrix<double, kColumns, kColumns> normal;  // lower triangle
    Eigen::Matrix<double, kColumns, 1> gradient;
    double cost = 0;
  };

  BlockPixels& pixels() { return pixels_; }

  // `linear`: a, gx, gy, c, cx, cy.
  Sums At(const Lines& lines, const BlurredSaddle& saddle,
          const Eigen::Matrix<double, 6, 1>& linear) const;

 private:
  BlockPixels pixels_;
};

}  // namespace telestrain
