#include "measurement/cylinder_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

namespace telestrain {
namespace {

constexpr std::size_t kMinPoints = 20;
constexpr int kIterations = 40;
using Matrix5d = Eigen::Matrix<double, 5, 5>;
using Vector5d = Eigen::Matrix<double, 5, 1>;

struct NormalSystem {
  Matrix5d matrix = Matrix5d::Zero();
  Vector5d right = Vector5d::Zero();
  double squares = 0;
  int count = 0;
};

// Parameters: shift along and tilt towards two directions across the axis, radius.
NormalSystem Linearise(const std::vector<Eigen::Vector3d>& points, const Cylinder& cylinder,
                       const Eigen::Vector3d& side_x, const Eigen::Vector3d& side_y,
                       const std::vector<bool>& used) {
  NormalSystem system;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!used[i]) continue;
    const Eigen::Vector3d normal = cylinder.Normal(points[i]);
    const double along = cylinder.AxialCoordinate_mm(points[i]);
    const double nx = normal.dot(side_x), ny = normal.dot(side_y);
    const Vector5d row = (Vector5d() << -nx, -ny, -along * nx, -along * ny, -1).finished();
    const double distance = cylinder.Distance_mm(points[i]);
    system.matrix += row * row.transpose();
    system.right -= row * distance;
    system.squares += distance * distance;
    ++system.count;
  }
  return system;
}

// Marks points within five robust sigmas of the surface.
std::vector<bool> Inliers(const std::vector<Eigen::Vector3d>& points, const Cylinder& cylinder) {
  std::vector<double> distances;
  for (const auto& point : points) distances.push_back(std::abs(cylinder.Distance_mm(point)));
  std::vector<double> sorted = distances;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double limit = std::max(5 * 1.4826 * *middle, 1e-6);
  std::vector<bool> inliers;
  for (const double distance : distances) inliers.push_back(distance <= limit);
  return inliers;
}

}  // namespace

Result<CylinderFit> FitCylinder(const std::vector<Eigen::Vector3d>& points, const Cylinder& start) {
  if (points.size() < kMinPoints)
    return EstimationFailed("the pipe surface has " + std::to_string(points.size()) +
                            " measured points, at least " + std::to_string(kMinPoints) +
                            " are needed for its cylinder");
  CylinderFit fit;
  fit.cylinder = start;
  fit.used.assign(points.size(), true);
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const auto& point : points) center += point / static_cast<double>(points.size());
  for (int i = 0; i < kIterations; ++i) {
    Cylinder& cylinder = fit.cylinder;
    cylinder.axis_point_mm += cylinder.axis * cylinder.axis.dot(center - cylinder.axis_point_mm);
    const Eigen::Vector3d side_x = cylinder.axis.unitOrthogonal();
    const Eigen::Vector3d side_y = cylinder.axis.cross(side_x);
    if (i >= 3) fit.used = Inliers(points, cylinder);
    const NormalSystem system = Linearise(points, cylinder, side_x, side_y, fit.used);
    const Eigen::LDLT<Matrix5d> solver(system.matrix);
    if (!solver.isPositive() || solver.rcond() < 1e-12)
      return EstimationFailed("the measured points do not determine the pipe's cylinder");
    const Vector5d step = solver.solve(system.right);
    cylinder.axis_point_mm += step(0) * side_x + step(1) * side_y;
    cylinder.axis = (cylinder.axis + step(2) * side_x + step(3) * side_y).normalized();
    cylinder.radius_mm += step(4);
    const double variance = system.squares / std::max(1, system.count - 5);
    const Matrix5d inverse = solver.solve(Matrix5d::Identity());
    fit.sigma_diameter_mm = 2 * std::sqrt(variance * inverse(4, 4));
    fit.rms_mm = std::sqrt(system.squares / std::max(1, system.count));
    if (i > 4 && step.cwiseAbs().maxCoeff() < 1e-11) break;
  }
  const double radius = fit.cylinder.radius_mm;
  if (!std::isfinite(radius) || radius < 0.25 * start.radius_mm || radius > 4 * start.radius_mm)
    return EstimationFailed("the measured points do not lie on a pipe: the fitted radius is " +
                            std::to_string(radius) + " mm, nominal " +
                            std::to_string(start.radius_mm) + " mm");
  return fit;
}

}  // namespace telestrain
