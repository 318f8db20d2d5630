#include "simulation/load_case.h"

#include <numbers>

namespace telestrain {

PressureStrains PressureStrainsAtSurface(const VirtualExperimentOptions& options,
                                         const PipeSpec& spec, double pressure_mpa) {
  const double outer_mm = 0.5 * spec.outer_diameter_mm;
  const double inner_mm = outer_mm - options.wall_thickness_mm;
  const double axial_stress_mpa =
      pressure_mpa * inner_mm * inner_mm / (outer_mm * outer_mm - inner_mm * inner_mm);
  const double strain = axial_stress_mpa / (1e3 * options.youngs_modulus_gpa);
  return {strain * (1 - 2 * spec.poisson_ratio), strain * (2 - spec.poisson_ratio)};
}

DeformedPipe PipeUnderLoad(const VirtualExperimentOptions& options, const PipeSpec& spec,
                           double load_share) {
  DeformedPipe pipe;
  pipe.radius_mm = 0.5 * spec.outer_diameter_mm;
  pipe.poisson_ratio = spec.poisson_ratio;
  pipe.bend_radius_mm = options.pipe_bend_radius_mm;
  pipe.membrane_strain = 1e-6 * options.strain_max_microstrain * load_share;
  pipe.curvature_per_mm = 1e-6 * options.bending_max_microstrain * load_share / pipe.radius_mm;
  pipe.curvature_angle_rad = options.bending_angle_deg * std::numbers::pi / 180;
  pipe.twist_rad_per_mm = 1e-6 * options.torsion_max_microstrain * load_share / pipe.radius_mm;
  const PressureStrains pressure =
      PressureStrainsAtSurface(options, spec, options.pressure_max_mpa * load_share);
  pipe.pressure_axial_strain = pressure.axial;
  pipe.pressure_hoop_strain = pressure.hoop;
  pipe.thermal_strain =
      1e-6 * options.expansion_ppm_per_k * options.temperature_change_k * load_share;
  return pipe;
}

}  // namespace telestrain
