#include "simulation/load_plan.h"

#include <cmath>
#include <numbers>

#include "geometry/rotation.h"
#include "simulation/random_keys.h"

namespace telestrain {
namespace {

constexpr double kHalfArc_rad = 32 * std::numbers::pi / 180;
constexpr int kArcSamples = 64;
constexpr double kSeconds_per_state = 20;
constexpr int kGauges = 4;

// Share of the full load at step `step` (from 1) of a cycle of `steps`: up to 1 and down to 0.
double LoadShare(int step, int steps) {
  const int up = (steps + 1) / 2;
  return step <= up ? static_cast<double>(step) / up
                    : static_cast<double>(steps - step) / (steps - up);
}

void MoveRigidly(const VirtualExperimentOptions& options, RandomStream& random,
                 DeformedPipe& pipe) {
  const double angle_rad = options.rigid_rotation_deg * std::numbers::pi / 180;
  Eigen::Vector3d turn, shift;
  for (int axis = 0; axis < 3; ++axis) {
    turn[axis] = random.Uniform(-angle_rad, angle_rad);
    shift[axis] = random.Uniform(-options.rigid_motion_mm, options.rigid_motion_mm);
  }
  pipe.array_from_pipe = ExpRotation(turn);
  pipe.origin_in_array_mm = Eigen::Vector3d(0, 0, -pipe.radius_mm) + shift;
}

std::vector<std::optional<double>> ReadGauges(const VirtualExperimentOptions& options,
                                              const DeformedPipe& pipe, RandomStream& random) {
  std::vector<std::optional<double>> readings;
  for (int gauge = 0; gauge < kGauges && options.gauges; ++gauge) {
    const double angle_rad = 2 * std::numbers::pi * gauge / kGauges;
    const double reading =
        1e6 * pipe.AxialStrain(angle_rad) + options.gauge_sigma_microstrain * random.Normal();
    readings.push_back(std::round(100 * reading) / 100 + 0.0);
  }
  return readings;
}

// Mean position along the pipe of the material points of one cross-section's visible arc.
double MeanAlong_mm(const DeformedPipe& pipe, double x_mm) {
  double sum_mm = 0;
  for (int i = 0; i < kArcSamples; ++i) {
    const double angle_rad = kHalfArc_rad * ((2.0 * i + 1) / kArcSamples - 1);
    const Eigen::Vector3d material_mm = pipe.Material(x_mm, angle_rad);
    sum_mm += x_mm + pipe.Displacement_mm(material_mm).x();
  }
  return sum_mm / kArcSamples;
}

double StrainBetween(const DeformedPipe& state, const DeformedPipe& reference, double from_mm,
                     double to_mm) {
  const double length_mm = MeanAlong_mm(state, to_mm) - MeanAlong_mm(state, from_mm);
  return length_mm / (MeanAlong_mm(reference, to_mm) - MeanAlong_mm(reference, from_mm)) - 1;
}

}  // namespace

std::vector<PipeTruth> PlanLoads(const VirtualExperimentOptions& options, const PipeSpec& spec) {
  RandomStream motion(RandomKey(options.seed, RandomPurpose::kPipe));
  RandomStream gauges(RandomKey(options.seed, RandomPurpose::kGauges));
  const int loaded = options.pipe_states - 1;
  std::vector<PipeTruth> states;
  for (int i = 0; i < options.pipe_states; ++i) {
    // The states after the reference are shared among the cycles as evenly as they can be.
    const int cycle = i == 0 ? 0 : (i - 1) * options.load_cycles / loaded;
    const auto first_of = [&](int c) {
      return (c * loaded + options.load_cycles - 1) / options.load_cycles;
    };
    const int step = i == 0 ? 0 : i - first_of(cycle);
    const double share = i == 0 ? 0 : LoadShare(step, first_of(cycle + 1) - first_of(cycle));
    DeformedPipe pipe;
    pipe.radius_mm = 0.5 * spec.outer_diameter_mm;
    pipe.poisson_ratio = spec.poisson_ratio;
    pipe.membrane_strain = 1e-6 * options.strain_max_microstrain * share;
    pipe.curvature_per_mm = 1e-6 * options.bending_max_microstrain * share / pipe.radius_mm;
    MoveRigidly(options, motion, pipe);
    std::string number = std::to_string(i);
    if (number.size() < 3) number.insert(0, 3 - number.size(), '0');
    states.push_back(
        {{"pipe/pipe_" + number + ".png", std::to_string(cycle + 1), std::to_string(step),
          i * kSeconds_per_state, ReadGauges(options, pipe, gauges)},
         pipe});
  }
  return states;
}

TrueStrain StrainOf(const DeformedPipe& state, const DeformedPipe& reference, double patch_a_x_mm,
                    double patch_b_x_mm) {
  constexpr double kHalfPatch_mm = 2.5;
  const auto local = [&](double x_mm) {
    return StrainBetween(state, reference, x_mm - kHalfPatch_mm, x_mm + kHalfPatch_mm);
  };
  return {StrainBetween(state, reference, patch_a_x_mm, patch_b_x_mm), local(patch_a_x_mm),
          local(patch_b_x_mm)};
}

}  // namespace telestrain
