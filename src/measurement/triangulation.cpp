#include "measurement/triangulation.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "base/check.h"

namespace telestrain {

TriangulatedPoint Triangulate(const ArrayCalibration& array,
                              const std::vector<ViewMeasurement>& measurements) {
  TELESTRAIN_CHECK(measurements.size() >= 2, "two views are needed for a point");
  const double m = array.lens.magnification_px_per_mm;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
  for (const ViewMeasurement& measured : measurements) {
    const TelecentricView& view = array.views[static_cast<std::size_t>(measured.view)];
    const auto& axes = view.axes_in_array;
    normal += axes.transpose() * axes;
    right += axes.transpose() * (array.lens.IdealFromPixel(measured.pixel) - view.offset_mm);
    noise += axes.transpose() * measured.covariance_px2 * axes / (m * m);
  }
  const Eigen::Matrix3d inverse = normal.inverse();
  TELESTRAIN_CHECK(normal.determinant() > 1e-6, "the views look along the same direction");
  TriangulatedPoint point;
  point.in_array_mm = inverse * right;
  point.covariance_mm2 = inverse * noise * inverse;
  for (const ViewMeasurement& measured : measurements) {
    const Eigen::Vector2d predicted = Project(
        array.lens, array.views[static_cast<std::size_t>(measured.view)], point.in_array_mm);
    point.residual_px = std::max(point.residual_px, (predicted - measured.pixel).norm());
  }
  return point;
}

}  // namespace telestrain
