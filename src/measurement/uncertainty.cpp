#include "measurement/uncertainty.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace telestrain {
double Combine(const std::vector<BudgetLine>& budget) {
  double sum = 0;
  for (const BudgetLine& line : budget)
    sum += line.standard_uncertainty * line.standard_uncertainty;
  return std::sqrt(sum);
}

CalibrationCovariances CalibrationPartsOf(
    const ArrayCalibration& array,
    const std::function<Eigen::VectorXd(const ArrayCalibration&)>& results) {
  const Eigen::Index size = array.ParameterCount();
  TELESTRAIN_CHECK(array.covariance.rows() == size, "the calibration has no covariance");
  TELESTRAIN_CHECK(array.covariance_of_noise.rows() == size,
                   "the calibration has no covariance of its noise");
  Eigen::MatrixXd gradient;
  for (Eigen::Index i = 0; i < size; ++i) {
    const double step = std::sqrt(std::max(0.0, array.covariance(i, i)));
    if (step == 0) continue;
    Eigen::VectorXd delta = Eigen::VectorXd::Zero(size);
    delta(i) = step;
    const Eigen::VectorXd slope =
        (results(array.Perturbed(delta)) - results(array.Perturbed(-delta))) / (2 * step);
    if (gradient.size() == 0) gradient = Eigen::MatrixXd::Zero(slope.size(), size);
    gradient.col(i) = slope;
  }
  if (gradient.size() == 0) gradient = Eigen::MatrixXd::Zero(results(array).size(), size);
  return {gradient * array.covariance_of_noise * gradient.transpose(),
          gradient * (array.covariance - array.covariance_of_noise) * gradient.transpose()};
}

CalibrationParts CalibrationPart(const ArrayCalibration& array,
                                 const std::function<double(const ArrayCalibration&)>& result) {
  const CalibrationCovariances parts = CalibrationPartsOf(array, [&](const auto& perturbed) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, result(perturbed)));
  });
  return {Sigma(parts.noise, 0), Sigma(parts.certificate, 0)};
}

double Sigma(const Eigen::MatrixXd& covariance, Eigen::Index i) {
  return std::sqrt(std::max(0.0, covariance(i, i)));
}

}  // namespace telestrain
