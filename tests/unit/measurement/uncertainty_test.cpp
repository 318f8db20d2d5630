#include "measurement/uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

namespace telestrain {
namespace {

// One view and a lens of which the magnification is estimated: 6 parameters.
ArrayCalibration OneView() {
  ArrayCalibration array;
  array.lenses = {{227, {600, 400}, {}}};
  array.views.resize(1);
  return array;
}

Eigen::MatrixXd SomeCovariance(int size, double scale) {
  Eigen::MatrixXd root(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) root(i, j) = scale * std::sin(1.0 + 3 * i + 7 * j);
  return root * root.transpose();
}

TEST(CalibrationPart, TellsNoiseFromCertificate) {
  ArrayCalibration array = OneView();
  array.covariance_of_noise = SomeCovariance(6, 1e-3);
  const Eigen::MatrixXd of_certificate = SomeCovariance(6, 2e-4);
  array.covariance = array.covariance_of_noise + of_certificate;
  // Linear in the parameters: 2 m + 3 t_x - t_y.
  const auto result = [](const ArrayCalibration& moved) {
    const Eigen::Vector2d& t = moved.views[0].offset_mm;
    return 2 * moved.lenses[0].magnification_px_per_mm + 3 * t.x() - t.y();
  };
  const Eigen::VectorXd gradient = (Eigen::VectorXd(6) << 2, 0, 0, 0, 3, -1).finished();
  const CalibrationParts parts = CalibrationPart(array, result);
  // 454 rounds to 5e-14, over a step of 1e-3.
  const double noise = std::sqrt(gradient.dot(array.covariance_of_noise * gradient));
  EXPECT_NEAR(parts.noise, noise, 1e-9 * noise);
  const double certificate = std::sqrt(gradient.dot(of_certificate * gradient));
  EXPECT_NEAR(parts.certificate, certificate, 1e-8 * certificate);
}

TEST(CalibrationPart, AMissingCovarianceIsABrokenContract) {
  const auto zero = [](const ArrayCalibration&) { return 0.0; };
  ArrayCalibration array = OneView();
  EXPECT_THROW(CalibrationPart(array, zero), std::logic_error);
  array.covariance = SomeCovariance(6, 1);
  EXPECT_THROW(CalibrationPart(array, zero), std::logic_error);
}

TEST(Combine, IsTheRootSumOfSquares) {
  EXPECT_DOUBLE_EQ(Combine({{"a", 3}, {"b", 4}}), 5);
  EXPECT_EQ(Combine({}), 0);
}

}  // namespace
}  // namespace telestrain
