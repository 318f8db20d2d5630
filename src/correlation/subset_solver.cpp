#include "correlation/subset_solver.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "correlation/quintic_spline.h"

namespace telestrain::correlation {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kLargestStep_px = 3;       // of a corner in one iteration
constexpr double kLargestGradient = 0.999;  // what the padding of the splines is made for
constexpr int kRescueReach_px = 3;
constexpr double kSmallestPivot = 1e-6;  // of the Hessian: below it one direction has no contrast

// sum J J^T in the order (u, v, du/dx, du/dy, dv/dx, dv/dy).
Matrix6 Assemble(const GradientMoments& moments) {
  constexpr int kPlaces[2][3] = {{0, 2, 3}, {1, 4, 5}};             // parameters of u and of v
  constexpr int kMoment[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};  // of offset products
  const ProductMoments* products[2][2] = {{&moments.xx, &moments.xy}, {&moments.xy, &moments.yy}};
  Matrix6 sum;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      for (int k = 0; k < 9; ++k)
        sum(kPlaces[a][k / 3], kPlaces[b][k % 3]) = (*products[a][b])[kMoment[k / 3][k % 3]];
  return sum;
}

// Largest way that a step moves a corner of the subset, in px.
double CornerStep(const Vector6& step) {
  return std::hypot(std::abs(step[0]) + std::abs(step[2]) + std::abs(step[3]),
                    std::abs(step[1]) + std::abs(step[4]) + std::abs(step[5]));
}

// How a step, its gradient in half sides, changes the six parameters.
Matrix6 StepToShape(const Eigen::Matrix2d& deformation, double half_side_px) {
  Matrix6 jacobian = Matrix6::Zero();
  for (int row = 0; row < 2; ++row) {
    for (int k = 0; k < 2; ++k) {
      jacobian(row, k) = deformation(row, k);
      for (int j = 0; j < 2; ++j)
        jacobian(2 + 2 * row + j, 2 + 2 * k + j) = deformation(row, k) / half_side_px;
    }
  }
  return jacobian;
}

// T without its mean, squared.
double WarpedEnergy(const WarpedMoments& moments, double pixels) {
  return moments.tt - moments.t * moments.t / pixels;
}

Vector6 ToVector(const std::array<double, 6>& values) { return Vector6(values.data()); }

}  // namespace

SubsetSolver::SubsetSolver(const SubsetProblem& problem)
    : problem_(problem),
      half_side_px_(problem.subset.side_px / 2),
      pixels_(static_cast<double>(problem.subset.side_px) * problem.subset.side_px),
      reference_(MeasureReference(problem.subset)) {
  const double contrast = std::sqrt(reference_.ff / pixels_);
  if (!(contrast >= problem.options->min_contrast_gray) || !(contrast > 0)) return;
  const Eigen::LDLT<Matrix6> hessian(Assemble(MeasureGradients(problem.subset)));
  const Vector6 pivots = hessian.vectorD();
  has_contrast_ = pivots.minCoeff() > kSmallestPivot * pivots.maxCoeff();
  if (has_contrast_) inverse_hessian_ = hessian.solve(Matrix6::Identity());
}

SubsetMatch SubsetSolver::Solve(const ShapeFunction& start) const {
  SubsetMatch match;
  match.shape = start;
  match.status = MatchStatus::kLowContrast;
  if (!has_contrast_) return match;
  match = Iterate(start);
  if (match.ok()) return match;
  const auto offset = BestOffset(start);
  if (!offset) return match;
  const SubsetMatch rescued = Iterate(*offset);
  return rescued.ok() ? rescued : match;
}

SubsetMatch SubsetSolver::Iterate(const ShapeFunction& start) const {
  SubsetMatch match;
  match.shape = start;
  while (match.iterations < problem_.options->max_iterations) {
    ++match.iterations;
    if (const auto reason = WhyUnusable(match.shape)) {
      match.status = *reason;
      return match;
    }
    const WarpedMoments moments = Measure(match.shape);
    if (!(WarpedEnergy(moments, pixels_) > 0)) {  // nothing to correlate with
      match.status = MatchStatus::kLowCorrelation;
      return match;
    }
    Vector6 step = Step(moments);
    const double corner_step = CornerStep(step);
    if (corner_step > kLargestStep_px) step *= kLargestStep_px / corner_step;
    match.shape = Compose(match.shape, step);
    if (!(corner_step < problem_.options->convergence_px)) continue;
    Assess(moments, match);
    return match;
  }
  match.status = MatchStatus::kNotConverged;
  return match;
}

std::optional<ShapeFunction> SubsetSolver::BestOffset(const ShapeFunction& start) const {
  std::optional<ShapeFunction> best;
  double best_zncc = 0;
  for (int dy = -kRescueReach_px; dy <= kRescueReach_px; ++dy) {
    for (int dx = -kRescueReach_px; dx <= kRescueReach_px; ++dx) {
      ShapeFunction shape = start;
      shape.displacement_px += Eigen::Vector2d(dx, dy);
      if (WhyUnusable(shape)) continue;
      const WarpedMoments moments = Measure(shape);
      const double zncc = moments.tf / std::sqrt(WarpedEnergy(moments, pixels_) * reference_.ff);
      if (!(zncc > best_zncc)) continue;
      best_zncc = zncc;
      best = shape;
    }
  }
  return best;
}

std::optional<MatchStatus> SubsetSolver::WhyUnusable(const ShapeFunction& shape) const {
  if (!shape.displacement_px.allFinite() || !shape.gradient.allFinite() ||
      shape.gradient.cwiseAbs().maxCoeff() > kLargestGradient)
    return MatchStatus::kNotConverged;
  const Eigen::Vector2d middle = problem_.center_px + shape.displacement_px;
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector2d offset =
        half_side_px_ * Eigen::Vector2d(corner % 2 ? 1 : -1, corner / 2 ? 1 : -1);
    const Eigen::Vector2d at = middle + offset + shape.gradient * offset;
    const bool inside = at.minCoeff() >= kSplineMargin &&
                        at.x() <= problem_.size_px.x() - 1 - kSplineMargin &&
                        at.y() <= problem_.size_px.y() - 1 - kSplineMargin;
    if (!inside) return MatchStatus::kOutside;
  }
  return std::nullopt;
}

WarpedMoments SubsetSolver::Measure(const ShapeFunction& shape) const {
  const Eigen::Vector2d corner = Eigen::Vector2d::Constant(-half_side_px_);
  const Eigen::Vector2d at = problem_.center_px + shape.displacement_px + corner +
                             shape.gradient * corner + Eigen::Vector2d::Constant(kSplinePadding);
  return MeasureWarped(problem_.subset, static_cast<float>(reference_.mean), problem_.spline,
                       {at.x(), at.y(), shape.gradient(0, 0), shape.gradient(0, 1),
                        shape.gradient(1, 0), shape.gradient(1, 1)});
}

// H^-1 sum J (s T - F), which displaces the reference towards the image.
SubsetSolver::Vector6 SubsetSolver::Step(const WarpedMoments& moments) const {
  const double scale = std::sqrt(reference_.ff / WarpedEnergy(moments, pixels_));
  const Vector6 warped = ToVector(moments.tj) - moments.t / pixels_ * ToVector(reference_.j);
  return inverse_hessian_ * (scale * warped - ToVector(reference_.fj));
}

// shape after the inverse of the step: x + u + G x with x = (I + D)^-1 (x' - d).
ShapeFunction SubsetSolver::Compose(const ShapeFunction& shape, const Vector6& step) const {
  const Eigen::Matrix2d identity = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d gradient;
  gradient << step[2], step[3], step[4], step[5];
  const Eigen::Matrix2d product =
      (identity + shape.gradient) * (identity + gradient / half_side_px_).inverse();
  return {shape.displacement_px - product * step.head<2>(), product - identity};
}

// The noise of F - s T has the variance sigma^2 (r + s^2 r') at a pixel, r and r' the shares that
// the blurs leave, and is correlated between pixels by the blurs. With M the sum of the J J^T of
// once more blurred gradients, sum J n has the covariance sigma^2 M from F and, as |I + G| pixels
// of the image share a pixel of the reference, sigma^2 s^2 M / |I + G| from T: together w M. Of the
// residual, the fit takes w trace(H^-1 M), the mean and the scale w each. All this is for the step
// d, D on the side of the reference; u changes by (I + G) d and G by (I + G) D.
void SubsetSolver::Assess(const WarpedMoments& moments, SubsetMatch& match) const {
  const double energy = WarpedEnergy(moments, pixels_);
  const double scale2 = reference_.ff / energy;
  match.zncc = moments.tf / std::sqrt(energy * reference_.ff);
  match.status = match.zncc >= problem_.options->min_zncc ? MatchStatus::kConverged
                                                          : MatchStatus::kLowCorrelation;
  const Matrix6 noise_matrix = Assemble(MeasureGradients(problem_.noise_subset));
  const Matrix6 spread = inverse_hessian_ * noise_matrix;
  const Eigen::Matrix2d deformation = Eigen::Matrix2d::Identity() + match.shape.gradient;
  const double weight = 1 + scale2 / std::max(std::abs(deformation.determinant()), 1e-3);
  const double shares = problem_.reference_noise_variance + scale2 * problem_.image_noise_variance;
  const double freedom =
      std::max(pixels_ * shares - weight * (spread.trace() + 2), 0.01 * pixels_ * shares);
  const double variance = std::max(0.0, 2 * reference_.ff * (1 - match.zncc)) / freedom;
  match.sigma_gray = std::sqrt(variance);

  const Matrix6 from_step = StepToShape(deformation, half_side_px_);
  const Matrix6 sandwich = spread * inverse_hessian_ * (variance * weight);
  match.covariance = from_step * (0.5 * (sandwich + sandwich.transpose())) * from_step.transpose();
}

}  // namespace telestrain::correlation
