#include "simulation/blurred_checkerboard.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace telestrain {
namespace {

// Beyond this many sigmas from an edge its blur is below 6e-7 of the contrast.
constexpr double kFarFromEdge_sigma = 5.0;

double MeanSign(double h) {
  if (std::abs(h) > kFarFromEdge_sigma) return h < 0 ? -1 : 1;
  return std::erf(h * std::numbers::sqrt2 / 2);
}

// One axis near its nearest edge: distance in sigmas, and the two functions that the board is made
// of, left and right of the edge: 1 inside the board, and the square wave that is 0 outside.
struct NearestEdge {
  double distance_sigma;
  double inside_left, inside_right;
  double wave_left, wave_right;
};

NearestEdge FindEdge(double coordinate_mm, int squares, double square_mm, double sigma_mm) {
  const double in_squares = coordinate_mm / square_mm + 0.5 * squares;
  const double edge = std::clamp(std::round(in_squares), 0.0, static_cast<double>(squares));
  const int right = static_cast<int>(edge), left = right - 1;
  const auto inside = [squares](int square) { return square >= 0 && square < squares ? 1.0 : 0.0; };
  const auto wave = [&](int square) { return inside(square) * (square % 2 == 0 ? 1 : -1); };
  return {(in_squares - edge) * square_mm / sigma_mm, inside(left), inside(right), wave(left),
          wave(right)};
}

// E[f(X) g(Y)] of two functions that jump at the edges, from the means of the signs.
double MeanProduct(const Eigen::Vector2d& f, const Eigen::Vector2d& g, double mean_s, double mean_t,
                   double mean_st) {
  const double f_mean = 0.5 * (f[0] + f[1]), f_jump = 0.5 * (f[1] - f[0]);
  const double g_mean = 0.5 * (g[0] + g[1]), g_jump = 0.5 * (g[1] - g[0]);
  return f_mean * g_mean + f_mean * g_jump * mean_t + f_jump * g_mean * mean_s +
         f_jump * g_jump * mean_st;
}

}  // namespace

double MeanSignProduct(double h, double k, double correlation) {
  const double product = MeanSign(h) * MeanSign(k);
  if (std::abs(h) > kFarFromEdge_sigma || std::abs(k) > kFarFromEdge_sigma) return product;
  // Gauss-Legendre nodes and weights on [-1, 1].
  constexpr double kNodes[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                               0.9061798459386640};
  constexpr double kWeights[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                 0.4786286704993665, 0.2369268850561891};
  double integral = 0;
  for (int i = 0; i < 5; ++i) {
    const double r = 0.5 * correlation * (1 + kNodes[i]);
    const double rest = 1 - r * r;
    integral += kWeights[i] * std::exp(-(h * h - 2 * r * h * k + k * k) / (2 * rest)) /
                (2 * std::numbers::pi * std::sqrt(rest));
  }
  return product + 4 * 0.5 * correlation * integral;
}

BlurredCheckerboard::BlurredCheckerboard(int columns, int rows, double square_mm,
                                         const Eigen::Matrix2d& cov_blur_mm2)
    : squares_x_(columns + 1),
      squares_y_(rows + 1),
      square_mm_(square_mm),
      sigma_x_mm_(std::sqrt(cov_blur_mm2(0, 0))),
      sigma_y_mm_(std::sqrt(cov_blur_mm2(1, 1))),
      correlation_(cov_blur_mm2(0, 1) / (sigma_x_mm_ * sigma_y_mm_)) {}

double BlurredCheckerboard::Brightness(const Eigen::Vector2d& point_in_board_mm) const {
  const NearestEdge x = FindEdge(point_in_board_mm.x(), squares_x_, square_mm_, sigma_x_mm_);
  const NearestEdge y = FindEdge(point_in_board_mm.y(), squares_y_, square_mm_, sigma_y_mm_);
  const double mean_s = MeanSign(x.distance_sigma), mean_t = MeanSign(y.distance_sigma);
  const double mean_st = MeanSignProduct(x.distance_sigma, y.distance_sigma, correlation_);
  const double inside = MeanProduct({x.inside_left, x.inside_right},
                                    {y.inside_left, y.inside_right}, mean_s, mean_t, mean_st);
  const double wave = MeanProduct({x.wave_left, x.wave_right}, {y.wave_left, y.wave_right}, mean_s,
                                  mean_t, mean_st);
  return 1 - 0.5 * (inside + wave);
}

}  // namespace telestrain
