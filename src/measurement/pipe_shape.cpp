#include "measurement/pipe_shape.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

namespace telestrain {
namespace {

using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

constexpr int kIterations = 30;
constexpr double kConverged = 1e-12;  // mm, rad and 1/mm

// The arc's plane: its curvature and the direction (y, z) of its middle.
struct Arc {
  double curvature_per_mm;
  Eigen::Vector2d towards;
  explicit Arc(const Eigen::Vector2d& curvature)
      : curvature_per_mm(curvature.norm()), towards(curvature / curvature_per_mm) {}
};

// Orthonormal again, `along` kept.
void Straighten90And0(PipeShape& shape) {
  shape.along.normalize();
  shape.at_0 = (shape.at_0 - shape.along * shape.along.dot(shape.at_0)).normalized();
  const double sense = shape.along.cross(shape.at_0).dot(shape.at_90) < 0 ? -1 : 1;
  shape.at_90 = sense * shape.along.cross(shape.at_0);
}

}  // namespace

Eigen::Vector3d PipeShape::Straighten(const Eigen::Vector3d& in_array_mm) const {
  const Eigen::Vector3d from = in_array_mm - origin_in_array_mm;
  const Eigen::Vector3d flat(along.dot(from), at_90.dot(from), at_0.dot(from));
  if (!IsBent()) return flat;
  const Arc arc(curvature_per_mm);
  const double k = arc.curvature_per_mm, inward = arc.towards.dot(flat.tail<2>());
  const double angle = std::atan2(k * flat.x(), 1 - k * inward);
  // 1 - hypot(k x, 1 - k b) without the cancellation at small curvatures.
  const double squares = k * (flat.x() * flat.x() + inward * inward) - 2 * inward;
  const double straight_inward = -squares / (1 + std::sqrt(1 + k * squares));
  Eigen::Vector3d straight(angle / k, flat.y(), flat.z());
  straight.tail<2>() += arc.towards * (straight_inward - inward);
  return straight;
}

Eigen::Vector3d PipeShape::InArray(const Eigen::Vector3d& straight_mm) const {
  Eigen::Vector3d flat = straight_mm;
  if (IsBent()) {
    const Arc arc(curvature_per_mm);
    const double angle = arc.curvature_per_mm * straight_mm.x();
    const double lever_mm = 1 / arc.curvature_per_mm - arc.towards.dot(straight_mm.tail<2>());
    const double half = std::sin(0.5 * angle);
    flat.x() = lever_mm * std::sin(angle);
    flat.tail<2>() += arc.towards * (lever_mm * 2 * half * half);
  }
  return origin_in_array_mm + along * flat.x() + at_90 * flat.y() + at_0 * flat.z();
}

Eigen::Matrix3d PipeShape::AxesAt(double along_mm) const {
  Eigen::Matrix3d flat;
  flat << along, at_90, at_0;
  if (!IsBent()) return flat;
  const Arc arc(curvature_per_mm);
  const double angle = arc.curvature_per_mm * along_mm;
  const Eigen::Vector3d inward(0, arc.towards.x(), arc.towards.y());
  // Turns `along` towards the arc's middle and the middle back.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn += (std::cos(angle) - 1) *
          (inward * inward.transpose() + Eigen::Vector3d::UnitX() * Eigen::RowVector3d::UnitX());
  turn += std::sin(angle) *
          (inward * Eigen::RowVector3d::UnitX() - Eigen::Vector3d::UnitX() * inward.transpose());
  return flat * turn;
}

Eigen::Matrix3d PipeShape::SurfaceAxes(const Eigen::Vector3d& straight_mm) const {
  const double angle = std::atan2(straight_mm.y(), straight_mm.z());
  Eigen::Matrix3d local;  // columns in (s, y, z)
  local << 1, 0, 0, 0, std::cos(angle), std::sin(angle), 0, -std::sin(angle), std::cos(angle);
  return AxesAt(straight_mm.x()) * local;
}

PipeShape ShapeOf(const Cylinder& cylinder, const Eigen::Vector3d& viewing) {
  PipeShape shape;
  shape.along = cylinder.axis.x() < 0 ? -cylinder.axis : cylinder.axis;
  shape.origin_in_array_mm =
      cylinder.axis_point_mm - shape.along * shape.along.dot(cylinder.axis_point_mm);
  shape.at_0 = -viewing;
  shape.at_90 = shape.along.cross(shape.at_0);
  constexpr double kClear = 0.1;  // cosine: nearer to 90 degrees the array's y decides nothing
  const double sense = std::abs(shape.at_90.y()) > kClear ? shape.at_90.y() : shape.at_90.z();
  if (sense < 0) shape.at_90 = -shape.at_90;
  shape.radius_mm = cylinder.radius_mm;
  Straighten90And0(shape);
  return shape;
}

PipeShape Changed(const PipeShape& shape, const Vector7d& change) {
  PipeShape changed = shape;
  changed.origin_in_array_mm += change(0) * shape.at_90 + change(1) * shape.at_0;
  changed.along += change(2) * shape.at_90 + change(3) * shape.at_0;
  Straighten90And0(changed);
  changed.radius_mm += change(4);
  changed.curvature_per_mm += change.tail<2>();
  return changed;
}

// Normal equations of the distances within the limit; sums and counts of `fit` are set anew.
struct ShapeSystem {
  Matrix7d normal = Matrix7d::Zero();
  Vector7d right = Vector7d::Zero();
};

ShapeSystem Linearise(const std::vector<Eigen::Vector3d>& points, double limit_mm, ShapeFit& fit) {
  ShapeSystem system;
  fit.squares_mm2 = 0;
  fit.used = 0;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d at = fit.shape.Straighten(point);
    const double from_axis_mm = at.tail<2>().norm();
    const double distance_mm = from_axis_mm - fit.shape.radius_mm;
    if (std::abs(distance_mm) > limit_mm) continue;
    const Eigen::Vector2d n = at.tail<2>() / from_axis_mm;
    Vector7d row;
    row << -n, -at.x() * n, -1, -0.5 * at.x() * at.x() * n;
    system.normal += row * row.transpose();
    system.right -= row * distance_mm;
    fit.squares_mm2 += distance_mm * distance_mm;
    ++fit.used;
  }
  return system;
}

ShapeFit FitShape(const std::vector<Eigen::Vector3d>& points, const PipeShape& start, bool bent,
                  double limit_mm) {
  ShapeFit fit;
  fit.shape = start;
  const int size = bent ? 7 : 5;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const auto [normal, right] = Linearise(points, limit_mm, fit);
    if (fit.used <= size + 3) return fit;
    // Shifts, tilts and curvatures differ by powers of the base's length.
    const Eigen::VectorXd scale = normal.diagonal().head(size).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled =
        scale.asDiagonal() * normal.topLeftCorner(size, size) * scale.asDiagonal();
    const Eigen::LDLT<Eigen::MatrixXd> solver(scaled);
    if (!solver.isPositive() || solver.rcond() < 1e-13) return fit;
    Vector7d step = Vector7d::Zero();
    step.head(size) = scale.cwiseProduct(solver.solve(scale.cwiseProduct(right.head(size))));
    fit.shape = Changed(fit.shape, step);
    fit.covariance.setZero();
    fit.covariance.topLeftCorner(size, size) =
        fit.squares_mm2 / (fit.used - size) * scale.asDiagonal() *
        solver.solve(Eigen::MatrixXd::Identity(size, size)) * scale.asDiagonal();
    if (step.cwiseAbs().maxCoeff() < kConverged) break;
  }
  fit.ok = fit.shape.radius_mm > 0 && std::isfinite(fit.shape.radius_mm);
  return fit;
}

}  // namespace telestrain
