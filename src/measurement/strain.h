#pragma once

#include <map>
#include <string>
#include <vector>

#include "measurement/pipe_points.h"
#include "measurement/uncertainty.h"

namespace telestrain {

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

// What one surface point did, for the map.
struct PointResult {
  bool used = false;
  Eigen::Vector3d displacement_mm = Eigen::Vector3d::Zero();
  double sigma_um = 0;      // of the displacement along the pipe
  double axial_strain = 0;  // over the virtual strain gauge around the point; NaN when unknown
  double hoop_strain = 0;
  double zncc = 0;
};

// One state against the reference; strains are plain ratios.
struct StateStrain {
  double axial_strain = 0;  // long base, between the patches of the first two groups
  double standard_uncertainty = 0;
  std::vector<double> local_axial_strain;  // one per group
  std::vector<double> local_hoop_strain;
  double local_sigma = 0;  // of the local axial strains, from noise
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero();  // of the pipe's centre
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
  std::vector<PointResult> points;  // one per grid point
  int points_used = 0;
  std::map<std::string, int> points_rejected;
  std::vector<BudgetLine> budget;  // strain, of the long-base value
};

// Long-base distance at the reference: between the two patch centres along the pipe.
double BaseLength_mm(const PipeGrid& grid);

// Side of the virtual strain gauge of the point map: grid nodes within this many steps.
inline constexpr int kGaugeReach_steps = 2;

// Displacements, patch fields, long-base and local strain, rigid motion and the uncertainty of the
// long-base value (MODEL.md Eq. 15-17). Fails (kEstimationFailed) when a patch keeps too few
// points.
Result<StateStrain> AnalyseState(const ArrayCalibration& array, const PipeGrid& grid,
                                 const std::vector<TrackedPoint>& tracked);

}  // namespace telestrain
