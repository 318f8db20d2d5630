#include "correlation/lost_points.h"

#include "correlation/point_propagation.h"

namespace telestrain::correlation {
namespace {

constexpr int kReach_points = 2;
constexpr double kLeastNeighbors = 3;

using Vector6 = Eigen::Matrix<double, 6, 1>;

Vector6 Parameters(const ShapeFunction& shape) {
  Vector6 p;
  p << shape.displacement_px, shape.gradient.row(0).transpose(), shape.gradient.row(1).transpose();
  return p;
}

// Where neighbours put a lost point; unknown when they are too few.
ChainedPoint FromNeighbors(const ChainedPoint& lost, const std::vector<ChainedPoint>& neighbors) {
  ChainedPoint point = lost;
  const double count = static_cast<double>(neighbors.size());
  point.known = count >= kLeastNeighbors;
  if (!point.known) return point;
  Vector6 mean = Vector6::Zero();
  std::vector<Vector6> say;
  point.covariance.setZero();
  for (const ChainedPoint& neighbor : neighbors) {
    const KnownMatch match{neighbor.first_center_px, neighbor.from_first, 1};
    say.push_back(Parameters(Continue(match, lost.first_center_px)));
    mean += say.back() / count;
    point.covariance += neighbor.covariance / count;
  }
  for (const Vector6& one : say)
    point.covariance += (one - mean) * (one - mean).transpose() / (count - 1);
  point.from_first = {};
  point.from_first.displacement_px = mean.head<2>();
  point.from_first.gradient << mean[2], mean[3], mean[4], mean[5];
  const Eigen::Vector2d at = lost.first_center_px.cast<double>() + mean.head<2>();
  point.center_px = at.array().round().cast<int>();
  point.offset_px = at - point.center_px.cast<double>();
  point.target_noise.setZero();
  point.shared = 0;
  return point;
}

}  // namespace

std::vector<ChainedPoint> NextLinks(const std::vector<ChainedPoint>& points,
                                    const std::vector<SubsetMatch>& matches, int columns,
                                    int subset_px) {
  std::vector<ChainedPoint> next(points.size());
  const int count = static_cast<int>(points.size());
  for (int i = 0; i < count; ++i)
    if (matches[i].ok()) next[i] = NextLink(points[i], matches[i], subset_px);
  for (int i = 0; i < count; ++i) {
    if (matches[i].ok()) continue;
    std::vector<ChainedPoint> neighbors;
    const int row = i / columns, column = i % columns;
    for (int y = row - kReach_points; y <= row + kReach_points; ++y)
      for (int x = column - kReach_points; x <= column + kReach_points; ++x) {
        const int other = y * columns + x;
        if (x >= 0 && x < columns && other >= 0 && other < count && matches[other].ok())
          neighbors.push_back(next[other]);
      }
    next[i] = FromNeighbors(points[i], neighbors);
  }
  return next;
}

}  // namespace telestrain::correlation
