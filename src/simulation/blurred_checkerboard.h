#pragma once

#include <Eigen/Core>

#include "simulation/blur.h"

namespace telestrain {

// A checkerboard seen through a Gaussian blur, in closed form: no supersampling, edges and saddles
// are exact.
//
// The board has (columns + 1) x (rows + 1) squares around its inner corners, on a bright plate. It
// is dark where column + row of a square, counted from the corner with the smallest x and y, is
// even. With S_i = sgn(X - x_i), T_j = sgn(Y - y_j) of the edges near a pixel and (X, Y) normal,
// functions f(X), g(Y) that are constant between the edges have
//   E[S_i] = erf(h_i / sqrt 2)                              (h: distance from the edge in sigmas)
//   E[f g] = E[f] E[g] + sum_ij df_i dg_j / 4 Cov(S_i, T_j)             (df: jump at the edge)
//   Cov(S, T) = 4 int_0^rho phi2(h, k; r) dr                             (Plackett's identity)
// and the grey level is made of two such products. Every edge has its own variance (PlaneBlur).
class BlurredCheckerboard {
 public:
  // `blur` in board coordinates. At most six edges along an axis are taken as near: five sigmas
  // must be shorter than 2.5 squares, or the blur's tails (6e-7 of the contrast) are cut short.
  BlurredCheckerboard(int columns, int rows, double square_mm, const PlaneBlur& blur)
      : squares_{columns + 1, rows + 1}, square_mm_(square_mm), blur_(blur) {}

  // Share of the bright plate, 0 (dark square) to 1, at a point relative to the middle of the grid
  // of inner corners, `depth_mm` beyond focus.
  double Brightness(const Eigen::Vector2d& point_in_board_mm, double depth_mm) const;

 private:
  static constexpr int kMaxEdges = 6;
  // One axis around a pixel. The board is made of two functions: 1 inside it, and the wave that is
  // +1 and -1 in turn inside it; both are 0 outside.
  struct NearEdges {
    int count = 0;
    double inside_mean = 0, wave_mean = 0;
    double distance_mm[kMaxEdges], sigma_mm[kMaxEdges];  // distance ahead
    double inside_jump[kMaxEdges], wave_jump[kMaxEdges];
  };
  // `in_squares` is the coordinate from the board's first border, in squares.
  NearEdges FindEdges(int axis, double in_squares, double depth_mm) const;
  bool IsFar(int axis, double in_squares, double depth_mm) const;  // from every edge

  int squares_[2];
  double square_mm_;
  PlaneBlur blur_;
};

// Cov(sgn X, sgn Y) of standard normal deviates around (h, k) with this correlation; to 1e-6 up to
// a correlation of 0.95.
double SignCovariance(double h, double k, double correlation);

}  // namespace telestrain
