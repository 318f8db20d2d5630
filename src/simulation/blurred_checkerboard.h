#pragma once

#include <Eigen/Core>

namespace telestrain {

// A checkerboard seen through a Gaussian blur, in closed form: no supersampling, edges and saddles
// are exact.
//
// The board has (columns + 1) x (rows + 1) squares around its inner corners, on a bright plate. It
// is dark where column + row of a square, counted from the corner with the smallest x and y, is
// even. With signs S = sgn(X - x0), T = sgn(Y - y0) of the nearest edges and (X, Y) normal with
// mean (x, y) and the blur's covariance, the grey level needs
//   E[S] = erf(h / sqrt 2),  E[T] = erf(k / sqrt 2),
//   E[S T] = E[S] E[T] + 4 int_0^rho phi2(h, k; r) dr        (h, k: distances in sigmas)
// where the integral (Plackett's identity, five-point Gauss-Legendre) vanishes unless a tilted view
// correlates the two board coordinates.
class BlurredCheckerboard {
 public:
  // `cov_blur_mm2` is the blur's covariance in board coordinates. One square must be wider than
  // 10 sigma for the neglect of the edges beyond the nearest to stay below 1e-6.
  BlurredCheckerboard(int columns, int rows, double square_mm, const Eigen::Matrix2d& cov_blur_mm2);

  // Share of the bright plate, 0 (dark square) to 1, at a point relative to the middle of the grid
  // of inner corners.
  double Brightness(const Eigen::Vector2d& point_in_board_mm) const;

 private:
  int squares_x_, squares_y_;
  double square_mm_;
  double sigma_x_mm_, sigma_y_mm_, correlation_;
};

// E[sgn(X) sgn(Y)] for standard normal deviates around (h, k) with this correlation.
double MeanSignProduct(double h, double k, double correlation);

}  // namespace telestrain
