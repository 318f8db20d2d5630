#pragma once

#include <Eigen/Core>
#include <vector>

#include "measurement/patch_field.h"
#include "measurement/pipe_shape.h"

namespace telestrain {

// What the pipe did as a beam between the reference and a state, over the whole base: it moved
// rigidly, its axis became longer, it bent with a constant curvature and it was twisted. With
// (s, y, z) of PipeShape, the displacement of the straight pipe is (Saint-Venant; n: Poisson's
// ratio)
//   u_s = (e + g0 z + g90 y) s
//   u_y = h y - n g0 y z - g90 (s^2 + n (y^2 - z^2)) / 2 + turn by twist s, from z to y
//   u_z = h z - n g90 y z - g0 (s^2 + n (z^2 - y^2)) / 2
// so that the axial strain at the angle t of the surface is e + R (g0 cos t + g90 sin t), MODEL.md
// Eq. 18.
struct BeamState {
  enum Parameter {
    kRotation = 0,     // 3, rad, in the array's directions, about the shape's origin
    kTranslation = 3,  // 3, mm, of the shape's origin
    kMembrane = 6,     // e
    kAcross = 7,       // h
    kSlope0 = 8,       // g0, g90: 1/mm
    kSlope90 = 9,
    kTwist = 10,  // rad/mm
    kCount = 11
  };
  using Vector = Eigen::Matrix<double, kCount, 1>;
  using Matrix = Eigen::Matrix<double, kCount, kCount>;

  Vector value = Vector::Zero();
  // From the points' covariances, times chi2_per_freedom where that is above 1.
  Matrix covariance = Matrix::Zero();
  double chi2_per_freedom = 0;
  double misfit_rms_mm = 0;  // of the points' displacements about the beam's, per coordinate
  bool ok = false;           // the points determine all of it
};

// Displacement in (s, y, z) of the straight pipe, without the rigid motion.
Eigen::Vector3d BeamDisplacement_mm(const BeamState::Vector& value, double poisson_ratio,
                                    const Eigen::Vector3d& straight_mm);

// What the points of `index` do beyond the beam: their displacements less the beam's, the rest as
// it is.
std::vector<DisplacedPoint> BeyondBeam(const PipeShape& shape, double poisson_ratio,
                                       const BeamState::Vector& value,
                                       const std::vector<DisplacedPoint>& points,
                                       const std::vector<std::size_t>& index);

// Weighted least squares over the points of `index` (the patches of all groups together), by
// Gauss-Newton from `start`; the rigid motion is finite. Some 5 ms for 4,000 points.
BeamState FitBeam(const PipeShape& shape, double poisson_ratio,
                  const std::vector<DisplacedPoint>& points, const std::vector<std::size_t>& index,
                  const BeamState::Vector& start = BeamState::Vector::Zero());

}  // namespace telestrain
