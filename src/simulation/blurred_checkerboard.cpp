#include "simulation/blurred_checkerboard.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/normal_share.h"

namespace telestrain {
namespace {

double Inside(int square, int squares) { return square >= 0 && square < squares ? 1 : 0; }
double Wave(int square, int squares) {
  return Inside(square, squares) * (square % 2 == 0 ? 1 : -1);
}

// The library's floor is a call without newer instructions.
int FloorOf(double value) {
  const int truncated = static_cast<int>(value);
  return truncated - (value < truncated ? 1 : 0);
}

}  // namespace

bool BlurredCheckerboard::IsFar(int axis, double in_squares, double depth_mm) const {
  const int nearest = std::clamp(FloorOf(in_squares + 0.5), 0, squares_[axis]);
  return std::abs(in_squares - nearest) * square_mm_ > blur_.Reach_mm(axis, depth_mm);
}

double SignCovariance(double h, double k, double correlation) {
  // Gauss-Legendre nodes and weights on [-1, 1]; over the angle, r = sin(angle), the integrand has
  // no singularity near a correlation of one (Genz 2004).
  constexpr double kNodes[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                               0.9602898564975363};
  constexpr double kWeights[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                 0.1012285362903763};
  if (correlation == 0) return 0;
  const double half_angle = 0.5 * std::asin(correlation);
  const double squares = 0.5 * (h * h + k * k), product = h * k;
  double integral = 0;
  for (int i = 0; i < 8; ++i) {
    const double r = std::sin(half_angle * (1 + (i < 4 ? kNodes[i] : -kNodes[i - 4])));
    integral += kWeights[i % 4] * std::exp((r * product - squares) / (1 - r * r));
  }
  return 4 * half_angle * integral / (2 * std::numbers::pi);
}

BlurredCheckerboard::NearEdges BlurredCheckerboard::FindEdges(int axis, double in_squares,
                                                              double depth_mm) const {
  const int squares = squares_[axis];
  const auto ahead_mm = [&](int edge) { return (edge - in_squares) * square_mm_; };
  const double reach_mm = blur_.Reach_mm(axis, depth_mm);
  const auto is_near = [&](int edge) {
    return edge >= 0 && edge <= squares && std::abs(ahead_mm(edge)) < reach_mm;
  };
  int first = std::clamp(FloorOf(in_squares), -1, squares) + 1;
  int end = first;  // edges ahead start here
  while (end - first < kMaxEdges / 2 && is_near(end)) ++end;
  while (end - first < kMaxEdges && is_near(first - 1)) --first;
  NearEdges edges;
  edges.inside_mean = Inside(first - 1, squares);
  edges.wave_mean = Wave(first - 1, squares);
  for (int edge = first; edge < end; ++edge) {
    const int i = edges.count++;
    edges.distance_mm[i] = ahead_mm(edge);
    edges.sigma_mm[i] = std::sqrt(blur_.Variance_mm2(axis, depth_mm, edges.distance_mm[i]));
    edges.inside_jump[i] = Inside(edge, squares) - Inside(edge - 1, squares);
    edges.wave_jump[i] = Wave(edge, squares) - Wave(edge - 1, squares);
    const double beyond = NormalShare(-edges.distance_mm[i] / edges.sigma_mm[i]);
    edges.inside_mean += edges.inside_jump[i] * beyond;
    edges.wave_mean += edges.wave_jump[i] * beyond;
  }
  return edges;
}

double BlurredCheckerboard::Brightness(const Eigen::Vector2d& point_in_board_mm,
                                       double depth_mm) const {
  const Eigen::Vector2d in_squares(point_in_board_mm.x() / square_mm_ + 0.5 * squares_[0],
                                   point_in_board_mm.y() / square_mm_ + 0.5 * squares_[1]);
  if (IsFar(0, in_squares.x(), depth_mm) && IsFar(1, in_squares.y(), depth_mm)) {
    const int column = FloorOf(in_squares.x()), row = FloorOf(in_squares.y());
    const bool dark =
        Inside(column, squares_[0]) * Inside(row, squares_[1]) != 0 && (column + row) % 2 == 0;
    return dark ? 0 : 1;
  }
  const NearEdges x = FindEdges(0, in_squares.x(), depth_mm);
  const NearEdges y = FindEdges(1, in_squares.y(), depth_mm);
  double dark = x.inside_mean * y.inside_mean + x.wave_mean * y.wave_mean;
  for (int i = 0; i < x.count; ++i)
    for (int j = 0; j < y.count; ++j) {
      const double sigma_x = x.sigma_mm[i], sigma_y = y.sigma_mm[j];
      const double cov = blur_.Covariance_mm2(depth_mm, x.distance_mm[i], y.distance_mm[j]);
      dark += 0.25 * (x.inside_jump[i] * y.inside_jump[j] + x.wave_jump[i] * y.wave_jump[j]) *
              SignCovariance(x.distance_mm[i] / sigma_x, y.distance_mm[j] / sigma_y,
                             cov / (sigma_x * sigma_y));
    }
  return 1 - 0.5 * dark;
}

}  // namespace telestrain
