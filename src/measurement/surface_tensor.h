#pragma once

#include <Eigen/Core>

namespace telestrain {

// Strain of the surface in one place, in the tangent plane: along the pipe (x), towards growing
// angle (t). With the unit vectors of the reference becoming a and b,
//   engineering: axial |a| - 1, hoop |b| - 1, shear asin(a b / (|a| |b|)), the change of the right
//     angle between them (positive when points turn to larger angles with growing x); principal:
//     the largest and the smallest |stretch| - 1 and the direction of the largest
//   Green-Lagrange: E_xx = (a a - 1) / 2, E_tt = (b b - 1) / 2, E_xt = a b / 2, and their principal
//     values. No rigid motion changes any of them.
struct SurfaceTensor {
  double axial = 0, hoop = 0, shear = 0;
  double principal_1 = 0, principal_2 = 0;  // principal_1 >= principal_2
  double principal_angle_rad = 0;           // of the first, from x towards t, in (-pi/2, pi/2]
  double green_axial = 0, green_hoop = 0, green_shear = 0;
  double green_principal_1 = 0, green_principal_2 = 0;
};

SurfaceTensor TensorOf(const Eigen::Vector3d& along, const Eigen::Vector3d& around);

}  // namespace telestrain
