#include "correlation/subset_solver.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "correlation/spline.h"
#include "correlation/subset_algebra.h"

namespace telestrain::correlation {
namespace {

constexpr double kLargestStep_px = 3;       // of a parameter in one iteration
constexpr double kLargestGradient = 0.999;  // what the padding of the splines is made for
constexpr int kRescueReach_px = 3;
constexpr double kSmallestPivot = 1e-6;  // of the Hessian: below it one direction has no contrast

// Largest way that curvature moves a pixel, in px.
Eigen::Vector2d BendingReach(const ShapeFunction& shape, double half_px) {
  return shape.curvature_per_px.cwiseAbs() * Eigen::Vector3d(0.5, 1, 0.5) * (half_px * half_px);
}

template <int kOrder>
class SubsetSolver {
 public:
  explicit SubsetSolver(const SubsetProblem& problem)
      : problem_(problem),
        half_px_(problem.subset.side_px / 2),
        reference_(MeasureReference(problem.subset, kOrder)),
        reference_fj_(Algebra::Join(reference_.fjx, reference_.fjy)),
        reference_j_(Algebra::Join(reference_.jx, reference_.jy)) {
    const double contrast = std::sqrt(reference_.ff / reference_.pixels);
    if (!(contrast >= problem.options->min_contrast_gray) || !(contrast > 0)) return;
    hessian_ = Algebra::Hessian(reference_);
    has_contrast_ = Algebra::Invert(hessian_, kSmallestPivot, inverse_hessian_);
  }

  SubsetMatch Solve(const ShapeFunction& start) const {
    SubsetMatch match = Describe(start);
    if (!has_contrast_)
      match.status = problem_.white ? MatchStatus::kSaturated : MatchStatus::kLowContrast;
    else if (problem_.saturated)
      match.status = MatchStatus::kSaturated;
    else
      match = Search(start);
    return match;
  }

 private:
  using Algebra = StepAlgebra<kOrder>;
  using Vector = typename Algebra::Vector;
  using Matrix = typename Algebra::Matrix;

  SubsetMatch Describe(const ShapeFunction& start) const {
    SubsetMatch match;
    match.shape = start;
    match.sssig = {reference_.xx[0][0], reference_.yy[0][0]};
    return match;
  }

  SubsetMatch Search(const ShapeFunction& start) const {
    SubsetMatch match = Iterate(start);
    if (match.ok() || match.status == MatchStatus::kSaturated) return match;
    // The iterations may have ended anywhere: what counts is where they were sent.
    if (start.displacement_px.allFinite() && SaturatedAt(start)) {
      match.status = MatchStatus::kSaturated;
      return match;
    }
    const auto offset = BestOffset(start);
    if (!offset) return match;
    const SubsetMatch rescued = Iterate(*offset);
    return rescued.ok() ? rescued : match;
  }

  SubsetMatch Iterate(const ShapeFunction& start) const {
    SubsetMatch match = Describe(start);
    while (match.iterations < problem_.options->max_iterations) {
      ++match.iterations;
      if (const auto reason = WhyUnusable(match.shape)) {
        match.status = *reason;
        return match;
      }
      const WarpedMoments moments = Measure(match.shape);
      if (!(WarpedEnergy(moments) > 0)) {  // nothing to correlate with
        match.status =
            SaturatedAt(match.shape) ? MatchStatus::kSaturated : MatchStatus::kLowCorrelation;
        return match;
      }
      Vector step = Step(moments);
      const double largest = step.cwiseAbs().maxCoeff();
      const bool converged = step.norm() < problem_.options->convergence_px;
      if (largest > kLargestStep_px) step *= kLargestStep_px / largest;
      match.shape = Algebra::Compose(match.shape, step, half_px_);
      if (!converged) continue;
      Assess(moments, match);
      return match;
    }
    match.status = MatchStatus::kNotConverged;
    return match;
  }

  std::optional<ShapeFunction> BestOffset(const ShapeFunction& start) const {
    std::optional<ShapeFunction> best;
    double best_zncc = 0;
    for (int dy = -kRescueReach_px; dy <= kRescueReach_px; ++dy) {
      for (int dx = -kRescueReach_px; dx <= kRescueReach_px; ++dx) {
        ShapeFunction shape = start;
        shape.displacement_px += Eigen::Vector2d(dx, dy);
        if (WhyUnusable(shape)) continue;
        const WarpedMoments moments = Measure(shape);
        const double zncc = moments.tf / std::sqrt(WarpedEnergy(moments) * reference_.ff);
        if (!(zncc > best_zncc)) continue;
        best_zncc = zncc;
        best = shape;
      }
    }
    return best;
  }

  std::optional<MatchStatus> WhyUnusable(const ShapeFunction& shape) const {
    if (!shape.displacement_px.allFinite() || !shape.gradient.allFinite() ||
        !shape.curvature_per_px.allFinite())
      return MatchStatus::kNotConverged;
    const Eigen::Vector2d bending = BendingReach(shape, half_px_);
    if (shape.gradient.cwiseAbs().maxCoeff() + 2 * bending.maxCoeff() / half_px_ > kLargestGradient)
      return MatchStatus::kNotConverged;
    // The farthest pixel along x and along y is a corner.
    const Eigen::Matrix2d deformation = Eigen::Matrix2d::Identity() + shape.gradient;
    const Eigen::Vector2d reach =
        deformation.cwiseAbs() * Eigen::Vector2d::Constant(half_px_) + bending;
    const Eigen::Vector2d middle = problem_.center_px + shape.displacement_px;
    const bool inside = (middle - reach).minCoeff() >= kSplineMargin &&
                        (problem_.size_px - middle - reach).minCoeff() >= kSplineMargin + 1;
    return inside ? std::nullopt : std::optional(MatchStatus::kOutside);
  }

  WarpedMoments Measure(const ShapeFunction& shape) const {
    SubsetWarp warp{problem_.center_px.x() + shape.displacement_px.x() + kSplinePadding,
                    problem_.center_px.y() + shape.displacement_px.y() + kSplinePadding,
                    {},
                    {}};
    for (int k = 0; k < 5; ++k) {
      warp.u[k + 1] = k < 2 ? shape.gradient(0, k) : shape.curvature_per_px(0, k - 2);
      warp.v[k + 1] = k < 2 ? shape.gradient(1, k) : shape.curvature_per_px(1, k - 2);
    }
    const int bands = BandCount(problem_.subset.side_px);
    const float mean = static_cast<float>(reference_.mean);
    const auto measure = [&](int band) {
      return MeasureWarpedBand(problem_.subset, mean, problem_.spline, warp, kOrder, band);
    };
    if (bands == 1) return measure(0);
    WarpedMoments sum;
    if (problem_.threads == 1) {
      for (int band = 0; band < bands; ++band) sum = sum + measure(band);
      return sum;
    }
    std::vector<WarpedMoments> parts(static_cast<std::size_t>(bands));
    ParallelFor(bands, problem_.threads, [&](int band) { parts[band] = measure(band); });
    for (const WarpedMoments& part : parts) sum = sum + part;
    return sum;
  }

  // T without its mean, squared.
  double WarpedEnergy(const WarpedMoments& moments) const {
    return moments.tt - moments.t * moments.t / reference_.pixels;
  }

  // H^-1 sum J (s T - F), which displaces the reference towards the image.
  Vector Step(const WarpedMoments& moments) const {
    const double scale = std::sqrt(reference_.ff / WarpedEnergy(moments));
    const Vector warped =
        Algebra::Join(moments.tjx, moments.tjy) - moments.t / reference_.pixels * reference_j_;
    return inverse_hessian_ * (scale * warped - reference_fj_);
  }

  bool SaturatedAt(const ShapeFunction& shape) const {
    const Saturation& saturation = *problem_.image_saturation;
    if (saturation.black.empty() && saturation.white.empty()) return false;
    const int side = problem_.subset.side_px;
    const Eigen::Vector2d corner = problem_.center_px + shape.displacement_px;
    if (corner.minCoeff() < 0 || (problem_.size_px - corner).minCoeff() < 0) return false;
    const int x = static_cast<int>(std::lround(corner.x() - half_px_));
    const int y = static_cast<int>(std::lround(corner.y() - half_px_));
    const int left = std::max(x, 0), top = std::max(y, 0);
    const int right = std::min(x + side, static_cast<int>(problem_.size_px.x()));
    const int bottom = std::min(y + side, static_cast<int>(problem_.size_px.y()));
    if (right <= left || bottom <= top) return false;
    return saturation.In({left, top, right - left, bottom - top});
  }

  // The noise of F - s T has the variance sigma^2 (r + s^2 r') at a pixel, r and r' the shares that
  // the blurs leave, and is correlated between pixels by the blurs. With M the sum of the J J^T of
  // once more blurred gradients, sum J n has the covariance sigma^2 M from F and, as |I + G| pixels
  // of the image share a pixel of the reference, sigma^2 s^2 M / |I + G| from T: together w M. M is
  // taken as S H S with S the roots of the noise shares of the two gradients. Of the residual, the
  // fit takes w trace(H^-1 M), the mean and the scale w each. All this is for the step d, D on the
  // side of the reference; u changes by (I + G) d and G by (I + G) D.
  void Assess(const WarpedMoments& moments, SubsetMatch& match) const {
    const double energy = WarpedEnergy(moments);
    const double scale2 = reference_.ff / energy;
    match.zncc = moments.tf / std::sqrt(energy * reference_.ff);
    match.status = match.zncc >= problem_.options->min_zncc ? MatchStatus::kConverged
                                                            : MatchStatus::kLowCorrelation;
    if (SaturatedAt(match.shape)) match.status = MatchStatus::kSaturated;
    Vector shares;
    shares << Half::Constant(std::sqrt(problem_.noise_shares.x())),
        Half::Constant(std::sqrt(problem_.noise_shares.y()));
    const Matrix noise = shares.asDiagonal() * hessian_ * shares.asDiagonal();
    const Eigen::Matrix2d deformation = Eigen::Matrix2d::Identity() + match.shape.gradient;
    const double weight = 1 + scale2 / std::max(std::abs(deformation.determinant()), 1e-3);
    const double total = reference_.pixels * (problem_.reference_noise_variance +
                                              scale2 * problem_.image_noise_variance);
    const double taken = weight * (inverse_hessian_.cwiseProduct(noise).sum() + 2);
    const double variance =
        std::max(0.0, 2 * reference_.ff * (1 - match.zncc)) / std::max(total - taken, 0.01 * total);
    match.sigma_gray = std::sqrt(variance);
    const auto to_shape = Algebra::ToShape(deformation, half_px_);
    const Eigen::Matrix<double, 6, Algebra::kSize> spread = to_shape * inverse_hessian_;
    const Eigen::Matrix<double, 6, 6> covariance = spread * noise * spread.transpose();
    match.covariance = 0.5 * variance * weight * (covariance + covariance.transpose());
  }
  using Half = Eigen::Matrix<double, Algebra::kBasis, 1>;

  const SubsetProblem& problem_;
  double half_px_;
  ReferenceMoments reference_;
  Vector reference_fj_, reference_j_;
  bool has_contrast_ = false;
  Matrix hessian_, inverse_hessian_;
};

}  // namespace

SubsetMatch SolveSubset(const SubsetProblem& problem, const ShapeFunction& start) {
  ShapeFunction from = start;
  if (problem.options->shape_order < 2) from.curvature_per_px.setZero();
  if (problem.options->shape_order < 1) from.gradient.setZero();
  if (problem.options->shape_order == 0) return SubsetSolver<0>(problem).Solve(from);
  if (problem.options->shape_order == 1) return SubsetSolver<1>(problem).Solve(from);
  return SubsetSolver<2>(problem).Solve(from);
}

}  // namespace telestrain::correlation
