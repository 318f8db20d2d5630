#pragma once

#include <Eigen/Core>
#include <vector>

namespace telestrain {

// A material point in the reference state and how far it moved (array frame).
struct DisplacedPoint {
  Eigen::Vector3d reference_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d displacement_mm = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_mm2 = Eigen::Matrix3d::Zero();  // of the displacement
};

// Displacement of one patch as a field that is linear in space: d(P) = mean + gradient (P -
// center). A rigid motion and a homogeneous strain are represented exactly.
struct PatchField {
  Eigen::Vector3d center_in_array_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d displacement_mm = Eigen::Vector3d::Zero();  // at the centre
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();         // d(displacement)/d(position)
  int points = 0;

  Eigen::Vector3d At(const Eigen::Vector3d& position_mm) const {
    return displacement_mm + gradient * (position_mm - center_in_array_mm);
  }
  // Engineering strain of a fibre along the unit vector `direction`.
  double FibreStrain(const Eigen::Vector3d& direction) const {
    return (direction + gradient * direction).norm() - 1.0;
  }
};

// The field fitted to the points of `index` by least squares (MODEL.md Eq. 15).
struct PatchFit {
  PatchField field;
  std::vector<std::size_t> index;
  Eigen::Matrix4d inverse;  // of the normal matrix, order: mean, gradient's columns

  // Standard deviation, along `direction`, of a linear function of the field: `basis` holds its
  // weights of the displacement and of the gradient's three columns. The larger of what the
  // points' covariances predict and what their scatter about the field shows.
  double Noise(const std::vector<DisplacedPoint>& points, const Eigen::Vector3d& direction,
               const Eigen::Vector4d& basis) const;
  // Of the displacement at a position (mm), and of the strain along `direction`.
  double NoiseAt_mm(const std::vector<DisplacedPoint>& points, const Eigen::Vector3d& direction,
                    const Eigen::Vector3d& position_mm) const;
  double StrainNoise(const std::vector<DisplacedPoint>& points,
                     const Eigen::Vector3d& direction) const;
};

PatchFit FitPatch(const std::vector<DisplacedPoint>& points, const std::vector<std::size_t>& index);

}  // namespace telestrain
