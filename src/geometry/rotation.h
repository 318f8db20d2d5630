#pragma once

#include <Eigen/Core>

namespace telestrain {

// Cross-product matrix: Skew(a) * b == a.cross(b).
Eigen::Matrix3d Skew(const Eigen::Vector3d& vector);

// Rotation by |rotation_vector_rad| about its direction (Rodrigues), and its inverse. LogRotation
// returns the vector of length <= pi; at exactly pi either of the two signs.
Eigen::Matrix3d ExpRotation(const Eigen::Vector3d& rotation_vector_rad);
Eigen::Vector3d LogRotation(const Eigen::Matrix3d& rotation);

// Left Jacobian of the rotation vector: Exp(w + dw) = Exp(LeftJacobian(w) dw) Exp(w) to first
// order, hence d(Exp(w) p)/dw = -Skew(Exp(w) p) LeftJacobian(w).
Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& rotation_vector_rad);

// The rotation nearest to `matrix` in the Frobenius norm; determinant +1.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& matrix);

// Angle between two rotations, in [0, pi].
double AngleBetween_rad(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

// Rotation with the given first two rows after the smallest orthonormalisation of the pair;
// the third row is their cross product.
Eigen::Matrix3d RotationFromRows(const Eigen::Vector3d& row_x, const Eigen::Vector3d& row_y);

}  // namespace telestrain
