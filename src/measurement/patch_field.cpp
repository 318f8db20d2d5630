#include "measurement/patch_field.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace telestrain {
namespace {

Eigen::Vector4d RowOf(const PatchField& field, const DisplacedPoint& point) {
  Eigen::Vector4d row;
  row << 1.0, point.reference_mm - field.center_in_array_mm;
  return row;
}

// Inverse where the points spread, zero where they do not: points in one plane say nothing across.
Eigen::Matrix4d PseudoInverse(const Eigen::Matrix4d& normal) {
  constexpr double kRelativeZero = 1e-14;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(normal);
  const Eigen::Vector4d values = solver.eigenvalues();
  Eigen::Vector4d inverse = Eigen::Vector4d::Zero();
  for (int i = 0; i < 4; ++i)
    if (values(i) > kRelativeZero * values(3)) inverse(i) = 1 / values(i);
  return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

PatchFit FitPatch(const std::vector<DisplacedPoint>& points,
                  const std::vector<std::size_t>& index) {
  PatchFit fit;
  fit.index = index;
  const auto count = static_cast<double>(index.size());
  for (const std::size_t i : index) fit.field.center_in_array_mm += points[i].reference_mm / count;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 4, 3> right = Eigen::Matrix<double, 4, 3>::Zero();
  for (const std::size_t i : index) {
    const Eigen::Vector4d row = RowOf(fit.field, points[i]);
    normal += row * row.transpose();
    right += row * points[i].displacement_mm.transpose();
  }
  fit.inverse = PseudoInverse(normal);
  const Eigen::Matrix<double, 4, 3> solution = fit.inverse * right;
  fit.field.displacement_mm = solution.row(0).transpose();
  fit.field.gradient = solution.bottomRows<3>().transpose();
  fit.field.points = static_cast<int>(index.size());
  return fit;
}

double PatchFit::Noise(const std::vector<DisplacedPoint>& points, const Eigen::Vector3d& direction,
                       const Eigen::Vector4d& basis) const {
  const Eigen::Vector4d weights = inverse * basis;
  double predicted = 0, scatter = 0, squares = 0;
  for (const std::size_t i : index) {
    const DisplacedPoint& point = points[i];
    const double w = weights.dot(RowOf(field, point));
    squares += w * w;
    predicted += w * w * direction.dot(point.covariance_mm2 * direction);
    scatter += std::pow(direction.dot(point.displacement_mm - field.At(point.reference_mm)), 2);
  }
  const double freedom = std::max(1.0, static_cast<double>(index.size()) - 4);
  return std::sqrt(std::max(predicted, squares * scatter / freedom));
}

double PatchFit::NoiseAt_mm(const std::vector<DisplacedPoint>& points,
                            const Eigen::Vector3d& direction,
                            const Eigen::Vector3d& position_mm) const {
  Eigen::Vector4d basis;
  basis << 1.0, position_mm - field.center_in_array_mm;
  return Noise(points, direction, basis);
}

double PatchFit::StrainNoise(const std::vector<DisplacedPoint>& points,
                             const Eigen::Vector3d& direction) const {
  Eigen::Vector4d basis;
  basis << 0.0, direction;
  return Noise(points, direction, basis);
}

}  // namespace telestrain
