#include "measurement/line_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace telestrain {
namespace {

constexpr int kMaxIterations = 100;

// What one pass of York's equations gives for a trial slope.
struct Pass {
  double slope = 0;
  double x_mean = 0, y_mean = 0;
  double sum_of_weights = 0;
  double adjusted_mean = 0;     // of the adjusted x
  double adjusted_squares = 0;  // weighted, about that mean
  double chi2 = 0;              // about the line of the trial slope
};

double Weight(const LinePoint& p, double slope) {
  return 1 / (p.sigma_y * p.sigma_y + slope * slope * p.sigma_x * p.sigma_x);
}

Pass RunPass(const std::vector<LinePoint>& points, double slope) {
  Pass pass;
  double x_sum = 0, y_sum = 0;
  for (const LinePoint& p : points) {
    const double weight = Weight(p, slope);
    pass.sum_of_weights += weight;
    x_sum += weight * p.x;
    y_sum += weight * p.y;
  }
  pass.x_mean = x_sum / pass.sum_of_weights;
  pass.y_mean = y_sum / pass.sum_of_weights;
  double numerator = 0, denominator = 0, beta_sum = 0;
  std::vector<double> betas;
  for (const LinePoint& p : points) {
    const double weight = Weight(p, slope), u = p.x - pass.x_mean, v = p.y - pass.y_mean;
    const double beta = weight * (u * p.sigma_y * p.sigma_y + slope * v * p.sigma_x * p.sigma_x);
    numerator += weight * beta * v;
    denominator += weight * beta * u;
    beta_sum += weight * beta;
    pass.chi2 += weight * std::pow(v - slope * u, 2);
    betas.push_back(beta);
  }
  pass.slope = numerator / denominator;
  const double beta_mean = beta_sum / pass.sum_of_weights;
  pass.adjusted_mean = pass.x_mean + beta_mean;
  for (std::size_t i = 0; i < points.size(); ++i)
    pass.adjusted_squares += Weight(points[i], slope) * std::pow(betas[i] - beta_mean, 2);
  return pass;
}

// Least squares of y on x, all points alike.
double StartSlope(const std::vector<LinePoint>& points) {
  double x_mean = 0, y_mean = 0, xx = 0, xy = 0;
  for (const LinePoint& p : points) {
    x_mean += p.x / static_cast<double>(points.size());
    y_mean += p.y / static_cast<double>(points.size());
  }
  for (const LinePoint& p : points) {
    xx += (p.x - x_mean) * (p.x - x_mean);
    xy += (p.x - x_mean) * (p.y - y_mean);
  }
  return xy / xx;
}

bool CanBeFitted(const std::vector<LinePoint>& points) {
  if (points.size() < 2) return false;
  for (const LinePoint& p : points)
    if (!(p.sigma_x >= 0 && p.sigma_y >= 0 && p.sigma_x + p.sigma_y > 0)) return false;
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  return high->x > low->x;
}

}  // namespace

std::optional<FittedLine> FitLine(const std::vector<LinePoint>& points) {
  if (!CanBeFitted(points)) return {};
  double slope = StartSlope(points);
  for (int i = 0; i < kMaxIterations; ++i) {
    const double next = RunPass(points, slope).slope;
    if (!std::isfinite(next)) return {};
    const bool done = std::abs(next - slope) <= 1e-14 * std::abs(next);
    slope = next;
    if (done) break;
  }
  const Pass pass = RunPass(points, slope);
  if (!(pass.adjusted_squares > 0)) return {};
  FittedLine line;
  line.degrees_of_freedom = static_cast<int>(points.size()) - 2;
  line.chi2 = pass.chi2;
  const double slope_variance = 1 / pass.adjusted_squares;
  line.slope = {slope, std::sqrt(slope_variance), 0};
  line.intercept = {
      pass.y_mean - slope * pass.x_mean,
      std::sqrt(1 / pass.sum_of_weights + std::pow(pass.adjusted_mean, 2) * slope_variance), 0};
  const double degrees = line.degrees_of_freedom;
  if (degrees < 1 || line.chi2 <= degrees + 2 * std::sqrt(2 * degrees)) return line;
  line.scatters_more_than_stated = true;
  for (Estimate* estimate : {&line.slope, &line.intercept}) {
    estimate->standard_uncertainty *= std::sqrt(line.chi2 / degrees);
    estimate->degrees_of_freedom = line.degrees_of_freedom;
  }
  return line;
}

Estimate LeastSquares::Coefficient(Eigen::Index i) const {
  return {coefficients(i), std::sqrt(covariance(i, i)), degrees_of_freedom};
}

std::optional<LeastSquares> FitLeastSquares(const Eigen::MatrixXd& design,
                                            const Eigen::VectorXd& values) {
  if (design.rows() <= design.cols()) return {};
  const Eigen::VectorXd scale = design.colwise().norm();
  if (!(scale.minCoeff() > 0)) return {};
  const Eigen::MatrixXd scaled = design * scale.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& singular = svd.singularValues();
  if (singular(singular.size() - 1) < 1e-10 * singular(0)) return {};
  LeastSquares fit;
  fit.degrees_of_freedom = static_cast<int>(design.rows() - design.cols());
  fit.coefficients = svd.solve(values).cwiseQuotient(scale);
  fit.residuals = values - design * fit.coefficients;
  fit.sigma = std::sqrt(fit.residuals.squaredNorm() / fit.degrees_of_freedom);
  const Eigen::MatrixXd inverse = svd.matrixV() * singular.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd unscaled = scale.cwiseInverse().asDiagonal() * inverse;
  fit.covariance = fit.sigma * fit.sigma * unscaled * unscaled.transpose();
  return fit;
}

}  // namespace telestrain
