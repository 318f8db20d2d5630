#include "measurement/beam_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr int kIterations = 10;
constexpr double kConverged = 1e-11;  // mm, rad, 1/mm: far below any strain or motion that matters
constexpr double kSmallestSigma_mm = 1e-6;  // exact points are weighted alike

using Jacobian = Eigen::Matrix<double, 3, BeamState::kCount>;
using UColumns = Eigen::Matrix<double, 3, 5>;  // membrane, across, slope 0, slope 90, twist

UColumns Derivatives(double twist, double poisson, const Eigen::Vector3d& p) {
  const double s = p.x(), y = p.y(), z = p.z(), n = poisson;
  const double cosine = std::cos(twist * s), sine = std::sin(twist * s);
  UColumns columns;
  columns << s, 0, s * z, s * y, 0,  //
      0, y, -n * y * z, -0.5 * (s * s + n * (y * y - z * z)), s * (z * cosine - y * sine), 0, z,
      -0.5 * (s * s + n * (z * z - y * y)), -n * y * z, -s * (y * cosine + z * sine);
  return columns;
}

struct Equations {
  Eigen::Vector3d residual;
  Jacobian rows;
};

// What does not change from point to point.
struct Beam {
  const PipeShape& shape;
  double poisson;
  const BeamState::Vector& value;
  Eigen::Matrix3d rotation;
};

// Measured less modelled position, and how the model moves with its parameters (the rotation by a
// further small one).
Equations EquationsOf(const Beam& beam, const DisplacedPoint& point) {
  const PipeShape& shape = beam.shape;
  const Eigen::Vector3d straight = shape.Straighten(point.reference_mm);
  const Eigen::Vector3d loaded = straight + BeamDisplacement_mm(beam.value, beam.poisson, straight);
  const Eigen::Vector3d turned = beam.rotation * (shape.InArray(loaded) - shape.origin_in_array_mm);
  Eigen::Matrix3d axes = shape.AxesAt(loaded.x());
  axes.col(0) *= 1 - shape.curvature_per_mm.dot(loaded.tail<2>());
  Equations equations;
  equations.residual = point.reference_mm + point.displacement_mm - turned -
                       shape.origin_in_array_mm - beam.value.segment<3>(BeamState::kTranslation);
  equations.rows.leftCols<3>() = -Skew(turned);
  equations.rows.middleCols<3>(BeamState::kTranslation).setIdentity();
  equations.rows.rightCols<5>() =
      beam.rotation * axes * Derivatives(beam.value(BeamState::kTwist), beam.poisson, straight);
  return equations;
}

struct NormalEquations {
  BeamState::Matrix matrix = BeamState::Matrix::Zero();
  BeamState::Vector right = BeamState::Vector::Zero();
  double chi2 = 0, squares_mm2 = 0;
};

NormalEquations Accumulate(const Beam& beam, const std::vector<DisplacedPoint>& points,
                           const std::vector<std::size_t>& index) {
  NormalEquations normal;
  const Eigen::Matrix3d floor = kSmallestSigma_mm * kSmallestSigma_mm * Eigen::Matrix3d::Identity();
  for (const std::size_t i : index) {
    const Equations equations = EquationsOf(beam, points[i]);
    const Eigen::Matrix3d weight = (points[i].covariance_mm2 + floor).inverse();
    const Jacobian weighted = weight * equations.rows;
    normal.matrix.noalias() += equations.rows.transpose() * weighted;
    normal.right.noalias() += weighted.transpose() * equations.residual;
    normal.chi2 += equations.residual.dot(weight * equations.residual);
    normal.squares_mm2 += equations.residual.squaredNorm();
  }
  return normal;
}

}  // namespace

Eigen::Vector3d BeamDisplacement_mm(const BeamState::Vector& value, double poisson,
                                    const Eigen::Vector3d& p) {
  const double s = p.x(), y = p.y(), z = p.z();
  const double across = value(BeamState::kAcross);
  const double g0 = value(BeamState::kSlope0), g90 = value(BeamState::kSlope90);
  const double turn = value(BeamState::kTwist) * s, sine = std::sin(turn);
  const double one_minus_cosine = 2 * std::sin(0.5 * turn) * std::sin(0.5 * turn);
  return {(value(BeamState::kMembrane) + g0 * z + g90 * y) * s,
          across * y - poisson * g0 * y * z - 0.5 * g90 * (s * s + poisson * (y * y - z * z)) +
              z * sine - y * one_minus_cosine,
          across * z - poisson * g90 * y * z - 0.5 * g0 * (s * s + poisson * (z * z - y * y)) -
              y * sine - z * one_minus_cosine};
}

std::vector<DisplacedPoint> BeyondBeam(const PipeShape& shape, double poisson,
                                       const BeamState::Vector& value,
                                       const std::vector<DisplacedPoint>& points,
                                       const std::vector<std::size_t>& index) {
  const Beam beam{shape, poisson, value, ExpRotation(value.head<3>())};
  std::vector<DisplacedPoint> beyond = points;
  for (const std::size_t i : index)
    beyond[i].displacement_mm = EquationsOf(beam, points[i]).residual;
  return beyond;
}

BeamState FitBeam(const PipeShape& shape, double poisson, const std::vector<DisplacedPoint>& points,
                  const std::vector<std::size_t>& index, const BeamState::Vector& start) {
  BeamState state;
  state.value = start;
  const double freedom = 3.0 * static_cast<double>(index.size()) - int{BeamState::kCount};
  if (freedom <= 0) return state;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const NormalEquations normal = Accumulate(
        {shape, poisson, state.value, ExpRotation(state.value.head<3>())}, points, index);
    const BeamState::Vector scale = normal.matrix.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::LDLT<Eigen::MatrixXd> solver(scale.asDiagonal() * normal.matrix *
                                              scale.asDiagonal());
    if (!solver.isPositive() || !(solver.rcond() > 1e-12)) return state;
    const BeamState::Vector step =
        scale.cwiseProduct(solver.solve(scale.cwiseProduct(normal.right)));
    state.value += step;
    state.value.head<3>() = LogRotation(ExpRotation(step.head<3>()) *
                                        ExpRotation(state.value.head<3>() - step.head<3>()));
    state.chi2_per_freedom = normal.chi2 / freedom;
    state.misfit_rms_mm = std::sqrt(normal.squares_mm2 / (3.0 * static_cast<double>(index.size())));
    state.covariance = std::max(1.0, state.chi2_per_freedom) * scale.asDiagonal() *
                       solver.solve(BeamState::Matrix::Identity()) * scale.asDiagonal();
    state.ok = state.value.allFinite();
    if (step.cwiseAbs().maxCoeff() < kConverged) break;
  }
  return state;
}

}  // namespace telestrain
