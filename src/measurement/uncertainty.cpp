#include "measurement/uncertainty.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace telestrain {
namespace {

double Spread(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& covariance) {
  return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
}

}  // namespace

double Combine(const std::vector<BudgetLine>& budget) {
  double sum = 0;
  for (const BudgetLine& line : budget)
    sum += line.standard_uncertainty * line.standard_uncertainty;
  return std::sqrt(sum);
}

CalibrationParts CalibrationPart(const ArrayCalibration& array,
                                 const std::function<double(const ArrayCalibration&)>& result) {
  const Eigen::Index size = array.ParameterCount();
  TELESTRAIN_CHECK(array.covariance.rows() == size, "the calibration has no covariance");
  TELESTRAIN_CHECK(array.covariance_of_noise.rows() == size,
                   "the calibration has no covariance of its noise");
  Eigen::VectorXd gradient(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const double step = std::sqrt(std::max(0.0, array.covariance(i, i)));
    if (step == 0) {
      gradient(i) = 0;
      continue;
    }
    Eigen::VectorXd delta = Eigen::VectorXd::Zero(size);
    delta(i) = step;
    gradient(i) = (result(array.Perturbed(delta)) - result(array.Perturbed(-delta))) / (2 * step);
  }
  return {Spread(gradient, array.covariance_of_noise),
          Spread(gradient, array.covariance - array.covariance_of_noise)};
}

}  // namespace telestrain
