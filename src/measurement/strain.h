#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measurement/strain_budget.h"
#include "measurement/strain_model.h"
#include "measurement/surface_tensor.h"

namespace telestrain {

// What one surface point did, for the map.
struct PointResult {
  bool used = false;
  Eigen::Vector3d displacement_mm = Eigen::Vector3d::Zero();
  double sigma_um = 0;      // of the displacement along the pipe
  double axial_strain = 0;  // over the virtual strain gauge around the point; NaN when unknown
  double hoop_strain = 0;
  SurfaceTensor tensor;  // over the same gauge, valid when axial_strain is
  double zncc = 0;
};

// What the camera says at the place of a strain gauge.
struct GaugeStrain {
  std::string column;
  // What the gauge should read: mechanical strain, or the total one when it reads thermal expansion
  // (or when no temperature is known). Since the reference.
  StrainValue strain;
};

// Strain without the free thermal expansion since the reference.
struct MechanicalStrain {
  double temperature_change_k = 0;
  double thermal_strain = 0;
  double sigma_thermal_strain = 0;  // of the temperatures and of the expansion coefficient
  double axial_strain = 0;          // long base
  double standard_uncertainty = 0;  // of that
  double membrane_strain = 0;
  double membrane_uncertainty = 0;
};

// One state against the reference; strains are plain ratios, engineering unless they say otherwise.
struct StateStrain {
  double axial_strain = 0;  // long base, between the patches of the first two groups
  double standard_uncertainty = 0;
  std::vector<double> local_axial_strain;  // one per group: mean over its patch
  std::vector<double> local_hoop_strain;
  std::vector<double> local_uncertainty;     // standard, of the local axial strains, all sources
  std::vector<SurfaceTensor> patch_tensors;  // one per group: mean over its patch
  double local_sigma = 0;                    // of the local axial strains, from noise; the largest
  // The axial strain at the angle t about the axis (0 faces the instrument) is
  // membrane + bending_0 cos t + bending_90 sin t on the surface.
  StrainValue membrane, bending_0, bending_90;
  StrainValue torsion;  // shear of the surface, positive when it turns to larger angles along x
  StrainValue across;   // uniform, across the pipe
  double beam_chi2_per_freedom = 0;  // above 1: the pipe did more than a beam does
  double beam_misfit_rms_um = 0;     // of the displacements, per coordinate
  // Fibre of the long-base and the local strain, from the axis towards 90 and 0 degrees.
  Eigen::Vector2d fibre_mm = Eigen::Vector2d::Zero();
  std::vector<GaugeStrain> gauges;                           // one per gauge whose place is known
  std::optional<MechanicalStrain> mechanical;                // when the temperature is known
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

// Displacements, patch fields, long-base, local and split strain, rigid motion, gauges and all
// uncertainties (MODEL.md 9). `temperature_change_k` is since the reference, when it is known.
// Fails (kEstimationFailed) when a patch keeps too few points or when they do not determine the
// beam. Some 60 ms for 4,000 points.
Result<StateStrain> AnalyseState(const ArrayCalibration& array, const PipeGrid& grid,
                                 const std::vector<TrackedPoint>& tracked, const StrainModel& model,
                                 std::optional<double> temperature_change_k = {});

// The same with the model that the grid alone gives.
Result<StateStrain> AnalyseState(const ArrayCalibration& array, const PipeGrid& grid,
                                 const std::vector<TrackedPoint>& tracked);

}  // namespace telestrain
