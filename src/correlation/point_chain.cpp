#include "correlation/point_chain.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace telestrain::correlation {
namespace {

using Matrix6 = ChainedPoint::Matrix6;
const Eigen::Matrix2d kIdentity = Eigen::Matrix2d::Identity();

// Gradient of a shape function at an offset from its centre.
Eigen::Matrix2d GradientAt(const ShapeFunction& shape, const Eigen::Vector2d& d) {
  Eigen::Matrix2d gradient = shape.gradient;
  const auto& k = shape.curvature_per_px;
  gradient.col(0) += k.col(0) * d.x() + k.col(1) * d.y();
  gradient.col(1) += k.col(1) * d.x() + k.col(2) * d.y();
  return gradient;
}

Eigen::Vector2d DisplacementAt(const ShapeFunction& shape, const Eigen::Vector2d& d) {
  return shape.displacement_px + shape.gradient * d +
         shape.curvature_per_px *
             Eigen::Vector3d(d.x() * d.x() / 2, d.x() * d.y(), d.y() * d.y() / 2);
}

// How errors of the match pass into the whole: du + dG d, dG F.
Matrix6 MatchJacobian(const ChainedPoint& point) {
  Matrix6 jacobian = Matrix6::Zero();
  const Eigen::Matrix2d deformation = kIdentity + point.from_first.gradient;
  jacobian.topLeftCorner<2, 2>().setIdentity();
  jacobian.block<1, 2>(0, 2) = point.offset_px.transpose();
  jacobian.block<1, 2>(1, 4) = point.offset_px.transpose();
  jacobian.block<2, 2>(2, 2) = deformation.transpose();
  jacobian.block<2, 2>(4, 4) = deformation.transpose();
  return jacobian;
}

// How errors so far pass into the whole: (I + G) dU, (I + G) dF.
Matrix6 ChainJacobian(const Eigen::Matrix2d& gradient) {
  Matrix6 jacobian = Matrix6::Zero();
  const Eigen::Matrix2d step = kIdentity + gradient;
  jacobian.topLeftCorner<2, 2>() = step;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) jacobian.block<2, 2>(2 + 2 * a, 2 + 2 * b) = step(a, b) * kIdentity;
  return jacobian;
}

// Second derivatives of the map after the map before it.
Eigen::Matrix<double, 2, 3> ComposeCurvature(const ShapeFunction& before, const Eigen::Matrix2d& g,
                                             const ShapeFunction& after) {
  const Eigen::Matrix2d f = kIdentity + before.gradient;
  Eigen::Matrix<double, 2, 3> sum = (kIdentity + g) * before.curvature_per_px;
  for (int row = 0; row < 2; ++row) {
    const auto k = after.curvature_per_px.row(row);
    Eigen::Matrix2d second;
    second << k[0], k[1], k[1], k[2];
    const Eigen::Matrix2d turned = f.transpose() * second * f;
    sum.row(row) += Eigen::RowVector3d(turned(0, 0), turned(0, 1), turned(1, 1));
  }
  return sum;
}

}  // namespace

ChainedPoint FirstLink(const Eigen::Vector2i& center_px) {
  ChainedPoint point;
  point.first_center_px = point.center_px = center_px;
  return point;
}

SubsetMatch Compose(const ChainedPoint& point, const SubsetMatch& match) {
  const Eigen::Matrix2d gradient = GradientAt(match.shape, point.offset_px);
  SubsetMatch total = match;
  total.shape.displacement_px = (point.center_px - point.first_center_px).cast<double>() +
                                point.offset_px + DisplacementAt(match.shape, point.offset_px);
  total.shape.gradient =
      gradient + point.from_first.gradient + gradient * point.from_first.gradient;
  total.shape.curvature_per_px = ComposeCurvature(point.from_first, gradient, match.shape);
  const Matrix6 chain = ChainJacobian(gradient), last = MatchJacobian(point);
  const Matrix6 from_match = last * match.covariance * last.transpose();
  total.covariance =
      chain * point.covariance * chain.transpose() + from_match -
      point.shared * (chain * point.target_noise * chain.transpose() + 0.5 * from_match);
  return total;
}

ChainedPoint NextLink(const ChainedPoint& point, const SubsetMatch& match, int subset_px) {
  const SubsetMatch total = Compose(point, match);
  ChainedPoint next = point;
  const Eigen::Vector2d at = point.first_center_px.cast<double>() + total.shape.displacement_px;
  next.known = true;
  next.center_px = at.array().round().cast<int>();
  next.offset_px = at - next.center_px.cast<double>();
  next.from_first = total.shape;
  next.covariance = total.covariance;
  const Matrix6 last = MatchJacobian(point);
  next.target_noise = 0.5 * last * match.covariance * last.transpose();
  next.shared = SharedNoise(GradientAt(match.shape, point.offset_px), next.offset_px, subset_px);
  return next;
}

ShapeFunction StartFor(const ChainedPoint& point, const ShapeFunction& total) {
  const Eigen::Matrix2d before = kIdentity + point.from_first.gradient;
  ShapeFunction start;
  start.gradient = (kIdentity + total.gradient) * before.inverse() - kIdentity;
  start.displacement_px =
      total.displacement_px - point.from_first.displacement_px - start.gradient * point.offset_px;
  return start;
}

double SharedNoise(const Eigen::Matrix2d& gradient, const Eigen::Vector2d& offset_px,
                   int subset_px) {
  constexpr int kSamples = 20;  // along a side; knows the area to half a percent
  const Eigen::Matrix2d deformation = kIdentity + gradient, inverse = deformation.inverse();
  const double half = 0.5 * subset_px, area = std::abs(deformation.determinant());
  int common = 0;
  for (int k = 0; k < kSamples * kSamples; ++k) {
    const Eigen::Vector2d at(((k % kSamples + 0.5) / kSamples - 0.5) * subset_px,
                             ((k / kSamples + 0.5) / kSamples - 0.5) * subset_px);
    common += (inverse * (at - offset_px)).cwiseAbs().maxCoeff() <= half;
  }
  const double share = static_cast<double>(common) / (kSamples * kSamples);
  return std::clamp(share / std::sqrt(std::max(area, 1e-6)), 0.0, 1.0);
}

}  // namespace telestrain::correlation
