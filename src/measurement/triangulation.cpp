#include "measurement/triangulation.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "base/check.h"

namespace telestrain {
namespace {

// What one pixel says about the point: rows P = value.
struct RayEquations {
  Eigen::Matrix<double, 2, 3> rows;
  Eigen::Vector2d value;
};

RayEquations EquationsOf(const TelecentricLens& lens, const TelecentricView& view,
                         const ViewMeasurement& measured) {
  const double kappa = lens.telecentricity_per_mm;
  const Eigen::Vector2d ideal = lens.IdealFromPixel(measured.pixel);
  return {view.axes_in_array - kappa * ideal * view.ViewingDirection().transpose(),
          ideal * (1 + kappa * view.depth_offset_mm) - view.offset_mm};
}

// Covariance of rows^T value from the pixel's noise. The value's own is the ideal image's times
// 1 + kappa depth.
Eigen::Matrix3d NoiseOf(const TelecentricLens& lens, double depth_mm, const RayEquations& ray,
                        const Eigen::Matrix2d& covariance_px2) {
  const double m = lens.magnification_px_per_mm;
  const double shrink = 1 + lens.telecentricity_per_mm * depth_mm;
  const Eigen::Matrix2d square_pixels =
      shrink * Eigen::Vector2d(1, 1 / lens.aspect).asDiagonal().toDenseMatrix();
  const Eigen::Matrix2d covariance = square_pixels * covariance_px2 * square_pixels;
  return ray.rows.transpose() * covariance * ray.rows / (m * m);
}

}  // namespace

TriangulatedPoint Triangulate(const ArrayCalibration& array,
                              const std::vector<ViewMeasurement>& measurements) {
  TELESTRAIN_CHECK(measurements.size() >= 2, "two views are needed for a point");
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  std::vector<RayEquations> rays;
  for (const ViewMeasurement& measured : measurements) {
    const auto view = static_cast<std::size_t>(measured.view);
    const RayEquations ray = EquationsOf(array.LensOf(view), array.views[view], measured);
    normal += ray.rows.transpose() * ray.rows;
    right += ray.rows.transpose() * ray.value;
    rays.push_back(ray);
  }
  const Eigen::Matrix3d inverse = normal.inverse();
  TELESTRAIN_CHECK(normal.determinant() > 1e-6, "the views look along the same direction");
  TriangulatedPoint point;
  point.in_array_mm = inverse * right;
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto view = static_cast<std::size_t>(measurements[i].view);
    noise += NoiseOf(array.LensOf(view), array.views[view].Depth_mm(point.in_array_mm), rays[i],
                     measurements[i].covariance_px2);
    const Eigen::Vector2d predicted = array.Project(measurements[i].view, point.in_array_mm);
    point.residual_px = std::max(point.residual_px, (predicted - measurements[i].pixel).norm());
  }
  point.covariance_mm2 = inverse * noise * inverse;
  return point;
}

}  // namespace telestrain
