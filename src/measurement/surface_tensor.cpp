#include "measurement/surface_tensor.h"

#include <cmath>

namespace telestrain {

SurfaceTensor TensorOf(const Eigen::Vector3d& along, const Eigen::Vector3d& around) {
  SurfaceTensor tensor;
  const double a = along.norm(), b = around.norm();
  tensor.axial = a - 1;
  tensor.hoop = b - 1;
  tensor.shear = std::asin(along.dot(around) / (a * b));
  tensor.green_axial = 0.5 * tensor.axial * (a + 1);
  tensor.green_hoop = 0.5 * tensor.hoop * (b + 1);
  tensor.green_shear = 0.5 * along.dot(around);
  const double mean = 0.5 * (tensor.green_axial + tensor.green_hoop);
  const double half = 0.5 * (tensor.green_axial - tensor.green_hoop);
  const double radius = std::hypot(half, tensor.green_shear);
  tensor.green_principal_1 = mean + radius;
  tensor.green_principal_2 = mean - radius;
  // sqrt(1 + 2 E) - 1 without the cancellation.
  const auto stretch = [](double green) { return 2 * green / (1 + std::sqrt(1 + 2 * green)); };
  tensor.principal_1 = stretch(tensor.green_principal_1);
  tensor.principal_2 = stretch(tensor.green_principal_2);
  tensor.principal_angle_rad = 0.5 * std::atan2(tensor.green_shear, half);
  return tensor;
}

}  // namespace telestrain
