#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "measurement/estimate.h"

namespace telestrain {

struct LinePoint {
  double x = 0, y = 0;
  double sigma_x = 0, sigma_y = 0;  // standard uncertainties, independent from point to point
};

// y = intercept + slope x.
struct FittedLine {
  Estimate slope, intercept;
  double chi2 = 0;  // weighted square sum of the residuals; expected: the degrees of freedom
  int degrees_of_freedom = 0;
  // The points scatter by more than their uncertainties (chi2 above its mean by two of its standard
  // deviations): those of slope and intercept were then taken from the scatter.
  bool scatters_more_than_stated = false;

  double At(double x) const { return intercept.value + slope.value * x; }
};

// The line through points with errors in both coordinates (York et al., Am. J. Phys. 72, 367
// (2004), without correlations; Deming's for equal ratios), which least squares of y on x flattens.
// With sigma_x = 0 it is weighted least squares. Nothing with fewer than two different x, or a
// point whose both sigmas are 0.
std::optional<FittedLine> FitLine(const std::vector<LinePoint>& points);

// Ordinary least squares with the noise found from the residuals.
struct LeastSquares {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd residuals;
  int degrees_of_freedom = 0;
  double sigma = 0;  // of one value about the fit

  Estimate Coefficient(Eigen::Index i) const;
};

// values (N) from the columns of `design` (N×P). Nothing without a degree of freedom or when the
// columns do not determine the coefficients (reciprocal condition below 1e-10, columns scaled).
std::optional<LeastSquares> FitLeastSquares(const Eigen::MatrixXd& design,
                                            const Eigen::VectorXd& values);

}  // namespace telestrain
