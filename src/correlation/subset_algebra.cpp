#include "correlation/subset_algebra.h"

namespace telestrain::correlation {
namespace {

// Polynomials of second degree as coefficients of 1, x, y, x^2 / 2, x y, y^2 / 2.
using Polynomial = Eigen::Matrix<double, 1, 6>;
using Polynomials = Eigen::Matrix<double, 6, 6>;

// Product without the terms above the second degree.
Polynomial Times(const Polynomial& p, const Polynomial& q) {
  Polynomial product = p[0] * q + q[0] * p;
  product[0] = p[0] * q[0];
  product[3] += 2 * p[1] * q[1];
  product[4] += p[1] * q[2] + p[2] * q[1];
  product[5] += 2 * p[2] * q[2];
  return product;
}

// The basis at the positions x' = p, y' = q, as polynomials of x and y: what turns the coefficients
// of a polynomial of x' and y' into those of one of x and y (Lu and Cary 2000).
Polynomials BasisAt(const Polynomial& p, const Polynomial& q) {
  Polynomials basis;
  basis << 1, 0, 0, 0, 0, 0, p, q, 0.5 * Times(p, p), Times(p, q), 0.5 * Times(q, q);
  return basis;
}

}  // namespace

template <>
ShapeFunction StepAlgebra<0>::Compose(const ShapeFunction& shape, const Vector& step, double) {
  ShapeFunction composed = shape;
  composed.displacement_px -= step;
  return composed;
}

// x + u + G x with x = (I + D)^-1 (x' - d).
template <>
ShapeFunction StepAlgebra<1>::Compose(const ShapeFunction& shape, const Vector& step,
                                      double half_px) {
  const Eigen::Matrix2d identity = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d gradient;
  gradient << step[1], step[2], step[4], step[5];
  const Eigen::Matrix2d product =
      (identity + shape.gradient) * (identity + gradient / half_px).inverse();
  ShapeFunction composed;
  composed.displacement_px = shape.displacement_px - product * Eigen::Vector2d(step[0], step[3]);
  composed.gradient = product - identity;
  return composed;
}

template <>
ShapeFunction StepAlgebra<2>::Compose(const ShapeFunction& shape, const Vector& step,
                                      double half_px) {
  const double to_half = 1 / half_px;
  Polynomial p = to_half * step.head<6>().transpose(), q = to_half * step.tail<6>().transpose();
  p[1] += 1, q[2] += 1;
  Eigen::Matrix<double, 2, 6> warp;  // of offsets in half sides
  warp << to_half * shape.displacement_px, Eigen::Matrix2d::Identity() + shape.gradient,
      half_px * shape.curvature_per_px;
  // W(x) = warp b(x) and b(step(x)) = B b(x): W after the inverse of the step is warp B^-1.
  const Eigen::Matrix<double, 2, 6> composed =
      BasisAt(p, q).transpose().partialPivLu().solve(warp.transpose()).transpose();
  return {half_px * composed.col(0), composed.middleCols<2>(1) - Eigen::Matrix2d::Identity(),
          to_half * composed.rightCols<3>()};
}

}  // namespace telestrain::correlation
