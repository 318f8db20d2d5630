#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

#include "correlation/subset_correlation.h"
#include "correlation/subset_moments.h"

namespace telestrain::correlation {

// Parameters of a step: the coefficients of u over the basis, then those of v, in px, with offsets
// in half sides. The basis is 1, x, y, x^2 / 2, x y, y^2 / 2 as far as the order has it.
template <int kOrder>
struct StepAlgebra {
  static constexpr int kBasis = BasisSize(kOrder);
  static constexpr int kSize = 2 * kBasis;
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  static Vector Join(const double (&x)[kLargestBasis], const double (&y)[kLargestBasis]) {
    Vector joined;
    for (int k = 0; k < kBasis; ++k) {
      joined[k] = x[k];
      joined[kBasis + k] = y[k];
    }
    return joined;
  }

  // sum J J^T from the moments of the gradient products.
  static Matrix Hessian(const ReferenceMoments& moments) {
    constexpr int kPowerX[] = {0, 1, 0, 2, 1, 0}, kPowerY[] = {0, 0, 1, 0, 1, 2};
    constexpr double kFactor[] = {1, 1, 1, 0.5, 1, 0.5};
    Matrix sum;
    for (int a = 0; a < kBasis; ++a) {
      for (int b = 0; b < kBasis; ++b) {
        const int i = kPowerX[a] + kPowerX[b], k = kPowerY[a] + kPowerY[b];
        const double factor = kFactor[a] * kFactor[b];
        sum(a, b) = factor * moments.xx[i][k];
        sum(a, kBasis + b) = sum(kBasis + b, a) = factor * moments.xy[i][k];
        sum(kBasis + a, kBasis + b) = factor * moments.yy[i][k];
      }
    }
    return sum;
  }

  // The inverse by L D L^T; false where a pivot is below `smallest` times the largest: a direction
  // without contrast.
  static bool Invert(const Matrix& m, double smallest, Matrix& inverse) {
    Matrix lower = Matrix::Identity();
    Vector pivot;
    for (int i = 0; i < kSize; ++i) {
      for (int k = 0; k <= i; ++k) {
        double rest = m(i, k);
        for (int j = 0; j < k; ++j) rest -= lower(i, j) * lower(k, j) * pivot[j];
        if (k == i)
          pivot[i] = rest;
        else
          lower(i, k) = rest / pivot[k];
      }
    }
    if (!(pivot.minCoeff() > smallest * pivot.maxCoeff())) return false;
    Matrix inverse_lower = Matrix::Identity();
    for (int k = 0; k < kSize; ++k) {
      for (int i = k + 1; i < kSize; ++i) {
        double sum = 0;
        for (int j = k; j < i; ++j) sum += lower(i, j) * inverse_lower(j, k);
        inverse_lower(i, k) = -sum;
      }
    }
    inverse = Product(inverse_lower, pivot);
    return true;
  }

  // shape after the inverse of the step.
  static ShapeFunction Compose(const ShapeFunction& shape, const Vector& step, double half_px);

  // How a step changes (u, v, du/dx, du/dy, dv/dx, dv/dy).
  static Eigen::Matrix<double, 6, kSize> ToShape(const Eigen::Matrix2d& deformation,
                                                 double half_px) {
    Eigen::Matrix<double, 6, kSize> jacobian = Eigen::Matrix<double, 6, kSize>::Zero();
    for (int row = 0; row < 2; ++row) {
      for (int k = 0; k < 2; ++k) {
        jacobian(row, k * kBasis) = deformation(row, k);
        if constexpr (kOrder > 0)
          for (int j = 0; j < 2; ++j)
            jacobian(2 + 2 * row + j, k * kBasis + 1 + j) = deformation(row, k) / half_px;
      }
    }
    return jacobian;
  }

 private:
  // L^-T D^-1 L^-1.
  static Matrix Product(const Matrix& inverse_lower, const Vector& pivot) {
    Matrix product;
    for (int i = 0; i < kSize; ++i) {
      for (int k = 0; k <= i; ++k) {
        double sum = 0;
        for (int j = i; j < kSize; ++j) sum += inverse_lower(j, i) * inverse_lower(j, k) / pivot[j];
        product(i, k) = product(k, i) = sum;
      }
    }
    return product;
  }
};

}  // namespace telestrain::correlation
