#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <variant>

#include "base/console.h"
#include "base/result.h"

namespace telestrain {

// What a virtual experiment is made of. The defaults are the paper's instrument (2592 x 1944 px of
// 2.2 um, lens 0.5x, stereo angle 60 deg) with a calm laboratory around it: every effect beyond
// noise, blur, distortion and small errors of mounting is off. Ranges and a sentence on every field
// stand in VirtualExperimentOptionTable().
struct VirtualExperimentOptions {
  std::uint64_t seed = 1;
  int poses = 12;
  int cut_off_poses = 2;
  double pose_tilt_deg = 8.0;
  int ruler_images = 12;
  int pipe_states = 6;
  int load_cycles = 1;

  int binning = 1;
  int bit_depth = 8;
  double noise_gray = 1.5;
  double full_well_electrons = 0.0;
  double exposure = 1.0;
  double illumination_gradient_percent = 10.0;
  double illumination_falloff_percent = 0.0;
  int dust_specks = 0;
  bool inverted = false;

  double psf_sigma_px = 0.8;
  double numerical_aperture = 0.0;
  double wavelength_um = 0.55;
  double vibration_um = 0.0;
  double distortion_percent = 0.05;
  double telecentricity_percent_per_mm = 0.0;
  double magnification_error_percent = 0.2;
  double mirror_error_mrad = 0.0;
  double mirror_error_um = 0.0;
  double view_error_deg = 0.3;
  double view_error_mm = 0.1;

  double image_interval_s = 20.0;
  double preheat_s = 600.0;
  double warmup_time_s = 200.0;
  double warmup_drift_um = 0.0;
  double warmup_drift_ppm = 0.0;

  double stage_error_deg = 0.2;
  double stage_sigma_mm = 0.002;
  double separation_error_um = 0.0;
  double ruler_error_um = 0.0;

  double pipe_diameter_mm = 8.0;
  double pipe_bend_radius_mm = 0.0;
  double wall_thickness_mm = 0.6;
  double youngs_modulus_gpa = 106.0;
  double expansion_ppm_per_k = 8.6;
  double strain_max_microstrain = 750.0;
  double bending_max_microstrain = 5.0;
  double bending_angle_deg = 0.0;
  double torsion_max_microstrain = 0.0;
  double pressure_max_mpa = 0.0;
  double temperature_change_k = 0.0;
  double gauge_sigma_microstrain = 1.0;
  double rigid_motion_mm = 0.05;
  double rigid_rotation_deg = 0.05;
  bool gauges = true;
  bool mirrors = false;
  int threads = 0;

  std::map<std::string, std::string> document;  // entries of [document] beside those it makes up
};

// One option as the command line, the check and the help page see it.
struct VirtualExperimentOptionInfo {
  const char* name;
  const char* unit;  // "" for counts and switches
  double minimum;
  double maximum;
  const char* help;
  std::variant<int VirtualExperimentOptions::*, double VirtualExperimentOptions::*,
               bool VirtualExperimentOptions::*, std::uint64_t VirtualExperimentOptions::*>
      member;
};
std::span<const VirtualExperimentOptionInfo> VirtualExperimentOptionTable();

// Fails (kUsage) with the first option outside its range, its limits and what to write instead.
Status CheckVirtualExperimentOptions(const VirtualExperimentOptions& options);

// Invents an instrument that deviates from its drawing, moves a target, a ruler and a loaded pipe
// through its field, and writes what the sensor would see: a session folder (images as PNG, tables,
// session.toml last) and, in `truth_file`, everything that the evaluation has to find
// (JSON, schema "telestrain.truth/1"). The same options give the same bytes for any number of
// threads. Fails when an option is out of range, when no pose fits into the field, when `folder`
// already holds a session, or when a file cannot be written.
Status WriteVirtualExperiment(const VirtualExperimentOptions& options,
                              const std::filesystem::path& folder,
                              const std::filesystem::path& truth_file, Console& console);

}  // namespace telestrain
