#include "target/saddle_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "target/saddle_window.h"

namespace telestrain {
namespace {

using Eigen::Vector2d;

constexpr double kSmallestSigma_gray = 0.3;  // rounding to whole grey levels: 1/sqrt(12)
constexpr double kSmallestBlur_px = 0.25;    // below it a pixel grid cannot tell
// What a last step may leave of the corner's place, in blurs; noise leaves 1e-3 and more.
constexpr double kConverged_blurs = 1e-4;
constexpr double kConvergedBlur = 0.05;  // the square of such a step is left: 0.3 %
constexpr int kIterations = 20;

bool IsInside(const SaddleParameters& p, const SaddleStart& start) {
  Eigen::Matrix2d axes;
  axes << start.half_axis_u_px, start.half_axis_v_px;
  const Vector2d at = axes.inverse() * p.segment<2>(kLinear);
  return at.allFinite() && at.cwiseAbs().maxCoeff() < 0.75 && p[10] > -3 && p[10] < 4;
}

// What a full Gauss-Newton step from `p` leaves of the place, in blurs. An edge's profile is odd
// and its slope even: the move of an edge leaves its cube and its products with the relative errors
// of the slope.
double Left_blurs(const SaddleStart& start, const SaddleParameters& p,
                  const SaddleParameters& step) {
  const double extent_px = std::max(start.half_axis_u_px.norm(), start.half_axis_v_px.norm());
  const double turn = step.segment<2>(8).cwiseAbs().maxCoeff();
  const double move = (step.segment<2>(kLinear).norm() + extent_px * turn) * std::exp(-p[10]);
  return move * (move * move + std::abs(step[10]) + std::abs(step[3] / p[3]));
}

// Damped Gauss-Newton: full steps while the cost falls. The last step is taken without another
// evaluation.
bool Minimise(const SaddleStart& start, SaddleWindow* window, SaddleParameters* p,
              SaddleEquations* at) {
  if (window->pixels() < 2 * kParameters) return false;
  *at = window->At(*p);
  double damping = 0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    SaddleNormal damped = at->normal;
    damped.diagonal() *= 1 + damping;
    SaddleParameters step = damped.ldlt().solve(at->gradient);
    step[10] = std::clamp(step[10], -0.7, 0.7);
    step.segment<2>(8) = step.segment<2>(8).cwiseMax(-0.3).cwiseMin(0.3);
    SaddleParameters next = *p + step;
    next[10] = std::max(next[10], std::log(kSmallestBlur_px));
    if (!IsInside(next, start)) return false;
    const bool is_small =
        Left_blurs(start, *p, step) < kConverged_blurs && std::abs(step[10]) < kConvergedBlur;
    if (is_small && damping < 0.01) {
      *p = next;
      at->cost -= step.dot(at->gradient);  // what a full step gains
      return true;
    }
    if (!window->Holds(next)) window->Sort(next);
    const SaddleEquations trial = window->At(next);
    if (!(trial.cost <= at->cost * (1 + 1e-5))) {
      damping = std::max(1e-2, damping * 10);
      continue;
    }
    *p = next;
    *at = trial;
    damping = damping > 1e-2 ? damping * 0.1 : 0;
  }
  return false;
}

}  // namespace

std::optional<SaddleFit> FitSaddle(const GrayImage& image, const PixelRegion& region,
                                   const SaddleStart& start) {
  SaddleWindow window(image, region, start);
  SaddleParameters p = SaddleParameters::Zero();
  const auto angle = [](const Vector2d& axis) { return std::atan2(axis.y(), axis.x()); };
  p.segment<2>(8) =
      start.angles_rad.value_or(Vector2d(angle(start.half_axis_u_px), angle(start.half_axis_v_px)));
  p[10] = std::log(start.blur_px);
  window.Sort(p);
  window.StartLinear(&p);
  SaddleEquations at;
  if (!p.allFinite() || !Minimise(start, &window, &p, &at)) return std::nullopt;
  const SaddleNormal inverse = at.normal.ldlt().solve(SaddleNormal::Identity());
  SaddleFit fit;
  const double sigma = std::sqrt(std::max(0.0, at.cost) / (window.pixels() - kParameters));
  fit.sigma_gray = std::max(sigma, kSmallestSigma_gray);
  fit.point.pixel = start.pixel + p.segment<2>(kLinear);
  fit.point.covariance_px2 =
      fit.sigma_gray * fit.sigma_gray * inverse.block<2, 2>(kLinear, kLinear);
  fit.contrast_gray = p[3] + p[4] * p[6] + p[5] * p[7];
  fit.level_gray = p[0] + p[1] * p[6] + p[2] * p[7];
  fit.blur_px = std::exp(p[10]);
  fit.angle_u_rad = p[8];
  fit.angle_v_rad = p[9];
  fit.pixels = window.pixels();
  const bool determined =
      fit.point.covariance_px2.allFinite() && fit.point.covariance_px2.diagonal().minCoeff() > 0;
  return determined ? std::optional(fit) : std::nullopt;
}

}  // namespace telestrain
