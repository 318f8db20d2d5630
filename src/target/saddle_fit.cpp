#include "target/saddle_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "target/blurred_saddle.h"

namespace telestrain {
namespace {

using Eigen::Vector2d;

constexpr int kLinear = 6;     // a, gx, gy, c, cx, cy
constexpr int kNonlinear = 5;  // x0, y0, angle of line u, angle of line v, log blur
constexpr int kParameters = kLinear + kNonlinear;
using Normal = Eigen::Matrix<double, kParameters, kParameters>;
using Parameters = Eigen::Matrix<double, kParameters, 1>;

constexpr double kSmallestSigma_gray = 0.3;  // rounding to whole grey levels: 1/sqrt(12)
constexpr double kSmallestBlur_px = 0.25;    // below it a pixel grid cannot tell
constexpr double kConvergedStep_px = 2e-3;
constexpr int kIterations = 20;

// Pixels x_begin <= x < x_end of one row.
struct RowSpan {
  int y = 0, x_begin = 0, x_end = 0;
};

// Narrows [low, high] to the x with |offset + slope x| <= 1.
void ClipToUnitBand(double offset, double slope, double* low, double* high) {
  if (std::abs(slope) < 1e-12) {
    if (std::abs(offset) > 1) *high = *low - 1;
    return;
  }
  const double a = (-1 - offset) / slope, b = (1 - offset) / slope;
  *low = std::max(*low, std::min(a, b));
  *high = std::min(*high, std::max(a, b));
}

std::vector<RowSpan> WindowRows(const PixelRegion& region, const SaddleStart& start) {
  const Vector2d u = start.half_axis_u_px, v = start.half_axis_v_px;
  const double det = u.x() * v.y() - u.y() * v.x();
  const double half_height = std::abs(u.y()) + std::abs(v.y());
  const int first = std::max(region.y, static_cast<int>(std::ceil(start.pixel.y() - half_height)));
  const int last = std::min(region.y + region.height - 1,
                            static_cast<int>(std::floor(start.pixel.y() + half_height)));
  std::vector<RowSpan> rows;
  for (int y = first; y <= last; ++y) {
    const double dy = y - start.pixel.y();
    double low = region.x - start.pixel.x();
    double high = region.x + region.width - 1 - start.pixel.x();
    ClipToUnitBand(-v.x() * dy / det, v.y() / det, &low, &high);
    ClipToUnitBand(u.x() * dy / det, -u.y() / det, &low, &high);
    const int begin = static_cast<int>(std::ceil(low + start.pixel.x()));
    const int end = static_cast<int>(std::floor(high + start.pixel.x())) + 1;
    if (begin < end) rows.push_back({y, begin, end});
  }
  return rows;
}

// Sums over the pixels far from both lines, where the model is linear in (1, x, y) and E is +-1.
struct PlainSums {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  double r = 0, rx = 0, ry = 0;

  void Add(double px, double py, double residual) {
    n += 1, x += px, y += py;
    xx += px * px, xy += px * py, yy += py * py;
    r += residual, rx += residual * px, ry += residual * py;
  }
  Eigen::Matrix3d Moments() const {
    Eigen::Matrix3d moments;
    moments << n, x, y, x, xx, xy, y, xy, yy;
    return moments;
  }
};

// The normal equations at one set of parameters.
struct Linearisation {
  Normal normal = Normal::Zero();
  Parameters gradient = Parameters::Zero();  // J^T (I - model)
  double cost = 0;
  int pixels = 0;
};

class SaddleProblem {
 public:
  SaddleProblem(const GrayImage& image, const PixelRegion& region, const SaddleStart& start)
      : image_(image), origin_(start.pixel), rows_(WindowRows(region, start)) {}

  Linearisation At(const Parameters& parameters) const;

 private:
  const GrayImage& image_;
  Vector2d origin_;  // the linear terms and the position count from here
  std::vector<RowSpan> rows_;
};

// The lines' normals, their derivatives by the angles, and the saddle.
struct Lines {
  explicit Lines(const Parameters& p)
      : normal_u(-std::sin(p[8]), std::cos(p[8])),
        normal_v(std::sin(p[9]), -std::cos(p[9])),
        turn_u(-std::cos(p[8]), -std::sin(p[8])),
        turn_v(std::cos(p[9]), std::sin(p[9])),
        inverse_blur(std::exp(-p[10])),
        rho(std::clamp(normal_u.dot(normal_v), -0.99, 0.99)),
        saddle(rho) {}
  Vector2d normal_u, normal_v, turn_u, turn_v;
  double inverse_blur, rho;
  BlurredSaddle saddle;
};

using Row = std::array<double, kParameters>;

// One row of J and the model's value at a pixel near a line; (x, y) count from the origin.
double ModelNearLine(const Parameters& p, const Lines& lines, double x, double y, Row* row) {
  const double dx = x - p[6], dy = y - p[7], scale = lines.inverse_blur;
  const double h = (lines.normal_u.x() * dx + lines.normal_u.y() * dy) * scale;
  const double k = (lines.normal_v.x() * dx + lines.normal_v.y() * dy) * scale;
  const SaddleValue e = lines.saddle.Evaluate(h, k);
  const double contrast = p[3] + p[4] * x + p[5] * y;
  const double by_h = contrast * e.by_h, by_k = contrast * e.by_k, by_rho = contrast * e.by_rho;
  const double h_turn = (lines.turn_u.x() * dx + lines.turn_u.y() * dy) * scale;
  const double k_turn = (lines.turn_v.x() * dx + lines.turn_v.y() * dy) * scale;
  *row = {1,
          x,
          y,
          e.value,
          e.value * x,
          e.value * y,
          -scale * (by_h * lines.normal_u.x() + by_k * lines.normal_v.x()),
          -scale * (by_h * lines.normal_u.y() + by_k * lines.normal_v.y()),
          by_h * h_turn + by_rho * lines.turn_u.dot(lines.normal_v),
          by_k * k_turn + by_rho * lines.turn_v.dot(lines.normal_u),
          -(by_h * h + by_k * k)};
  return p[0] + p[1] * x + p[2] * y + contrast * e.value;
}

void AddRow(const Row& row, double residual, Linearisation* sums) {
  for (int i = 0; i < kParameters; ++i) {
    const double factor = row[static_cast<std::size_t>(i)];
    double* column = sums->normal.data() + i * kParameters;  // lower triangle, column-major
    for (int j = i; j < kParameters; ++j) column[j] += factor * row[static_cast<std::size_t>(j)];
    sums->gradient[i] += factor * residual;
  }
}

void AddPlainSums(const PlainSums& plain, double sign, Linearisation* sums) {
  const Eigen::Matrix3d moments = plain.Moments();
  sums->normal.block<3, 3>(0, 0) += moments;
  sums->normal.block<3, 3>(3, 0) += sign * moments;
  sums->normal.block<3, 3>(3, 3) += moments;
  const Eigen::Vector3d gradient(plain.r, plain.rx, plain.ry);
  sums->gradient.segment<3>(0) += gradient;
  sums->gradient.segment<3>(3) += sign * gradient;
}

Linearisation SaddleProblem::At(const Parameters& p) const {
  const Lines lines(p);
  const double reach = BlurredSaddle::kReach / lines.inverse_blur;
  Linearisation sums;
  std::array<PlainSums, 2> plain;  // E = -1, E = +1
  Row row;
  for (const RowSpan& span : rows_) {
    const float* pixels = image_.pixels.data() + static_cast<std::ptrdiff_t>(span.y) * image_.width;
    const double y = span.y - origin_.y(), dy = y - p[7];
    for (int column = span.x_begin; column < span.x_end; ++column) {
      const double x = column - origin_.x(), dx = x - p[6];
      const double gray = static_cast<double>(pixels[column]);
      const double from_u = lines.normal_u.x() * dx + lines.normal_u.y() * dy;
      const double from_v = lines.normal_v.x() * dx + lines.normal_v.y() * dy;
      double residual;
      if (std::abs(from_u) < reach || std::abs(from_v) < reach) {
        residual = gray - ModelNearLine(p, lines, x, y, &row);
        AddRow(row, residual, &sums);
      } else {
        const bool positive = (from_u > 0) == (from_v > 0);
        const double contrast = p[3] + p[4] * x + p[5] * y;
        residual = gray - (p[0] + p[1] * x + p[2] * y + (positive ? contrast : -contrast));
        plain[positive].Add(x, y, residual);
      }
      sums.cost += residual * residual;
    }
    sums.pixels += span.x_end - span.x_begin;
  }
  AddPlainSums(plain[0], -1, &sums);
  AddPlainSums(plain[1], +1, &sums);
  sums.normal.triangularView<Eigen::StrictlyUpper>() = sums.normal.transpose();
  return sums;
}

bool IsInside(const Parameters& p, const SaddleStart& start) {
  Eigen::Matrix2d axes;
  axes << start.half_axis_u_px, start.half_axis_v_px;
  const Vector2d at = axes.inverse() * p.segment<2>(kLinear);
  return at.allFinite() && at.cwiseAbs().maxCoeff() < 0.75 && p[10] > -3 && p[10] < 4;
}

// The linear parameters for given nonlinear ones.
void SolveLinear(const SaddleProblem& problem, Parameters* p) {
  p->head<kLinear>().setZero();
  const Linearisation at = problem.At(*p);
  p->head<kLinear>() =
      at.normal.topLeftCorner<kLinear, kLinear>().ldlt().solve(at.gradient.head<kLinear>());
}

// Damped Gauss-Newton: full steps while the cost falls. The last step, below the tolerance, is
// taken without another evaluation; what is left is a hundredth of it.
bool Minimise(const SaddleProblem& problem, const SaddleStart& start, Parameters* p,
              Linearisation* at) {
  *at = problem.At(*p);
  if (at->pixels < 2 * kParameters) return false;
  double damping = 0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Normal damped = at->normal;
    damped.diagonal() *= 1 + damping;
    Parameters step = damped.ldlt().solve(at->gradient);
    step[10] = std::clamp(step[10], -0.7, 0.7);
    step.segment<2>(8) = step.segment<2>(8).cwiseMax(-0.3).cwiseMin(0.3);
    Parameters next = *p + step;
    next[10] = std::max(next[10], std::log(kSmallestBlur_px));
    if (!IsInside(next, start)) return false;
    const bool is_small =
        step.segment<2>(kLinear).norm() < kConvergedStep_px && std::abs(step[10]) < 0.01;
    if (is_small && damping < 0.01) {
      *p = next;
      return true;
    }
    const Linearisation trial = problem.At(next);
    if (!(trial.cost <= at->cost * (1 + 1e-9))) {
      damping = std::max(1e-2, damping * 10);
      continue;
    }
    *p = next;
    *at = trial;
    damping = damping > 1e-2 ? damping * 0.1 : 0;
  }
  return false;
}

// Half the window first: a quarter of the pixels for the steps from afar.
SaddleStart HalfWindow(SaddleStart start) {
  constexpr double kLeastHalfAxis_px = 8;
  for (Vector2d* axis : {&start.half_axis_u_px, &start.half_axis_v_px})
    *axis *= std::min(1.0, std::max(0.5, kLeastHalfAxis_px / axis->norm()));
  return start;
}

}  // namespace

std::optional<SaddleFit> FitSaddle(const GrayImage& image, const PixelRegion& region,
                                   const SaddleStart& start) {
  const SaddleStart half = HalfWindow(start);
  const SaddleProblem coarse(image, region, half), fine(image, region, start);
  Parameters p = Parameters::Zero();
  p[8] = std::atan2(start.half_axis_u_px.y(), start.half_axis_u_px.x());
  p[9] = std::atan2(start.half_axis_v_px.y(), start.half_axis_v_px.x());
  p[10] = std::log(start.blur_px);
  SolveLinear(coarse, &p);
  Linearisation at;
  if (!p.allFinite() || !Minimise(coarse, start, &p, &at)) return std::nullopt;
  if (!Minimise(fine, start, &p, &at)) return std::nullopt;
  const Normal inverse = at.normal.ldlt().solve(Normal::Identity());
  SaddleFit fit;
  const double sigma = std::sqrt(at.cost / (at.pixels - kParameters));
  fit.sigma_gray = std::max(sigma, kSmallestSigma_gray);
  fit.point.pixel = start.pixel + p.segment<2>(kLinear);
  fit.point.covariance_px2 =
      fit.sigma_gray * fit.sigma_gray * inverse.block<2, 2>(kLinear, kLinear);
  fit.contrast_gray = p[3] + p[4] * p[6] + p[5] * p[7];
  fit.blur_px = std::exp(p[10]);
  fit.angle_u_rad = p[8];
  fit.angle_v_rad = p[9];
  fit.pixels = at.pixels;
  const bool determined =
      fit.point.covariance_px2.allFinite() && fit.point.covariance_px2.diagonal().minCoeff() > 0;
  return determined ? std::optional(fit) : std::nullopt;
}

}  // namespace telestrain
