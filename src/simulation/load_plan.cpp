#include "simulation/load_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/rotation.h"
#include "simulation/load_case.h"
#include "simulation/random_keys.h"

namespace telestrain {
namespace {

constexpr int kArcSamples = 64;
// Half the stereo angle and half the height of a view's field (972 px of 4.4 um), of the drawing.
constexpr double kHalfStereo_rad = std::numbers::pi / 6;
constexpr double kHalfField_mm = 2.1384;
// Nearer to the silhouette of the other view nothing can be correlated.
constexpr double kWidestArc_rad = 50 * std::numbers::pi / 180;
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

// A thermometer on the pipe, which is at 20 degrees when it is not loaded; only where it warms.
std::optional<double> ReadTemperature_c(const VirtualExperimentOptions& options, double share) {
  if (options.temperature_change_k == 0) return {};
  return std::round(1000 * (20 + share * options.temperature_change_k)) / 1000;
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

// Half the arc that both views of a group see of a pipe that touches the middle of their field: the
// surface point at the angle t appears R (sin(t - a) + sin a) from the middle, a = half the stereo
// angle. 32 deg for a pipe of 8 mm.
double SeenHalfArc_rad(double radius_mm) {
  const double sine = kHalfField_mm / radius_mm - std::sin(kHalfStereo_rad);
  return std::min(kWidestArc_rad, kHalfStereo_rad + std::asin(std::min(1.0, sine)));
}

// Calls visit(angle) for angles over that arc.
template <typename Visit>
void ForVisibleArc(double radius_mm, const Visit& visit) {
  const double half_arc_rad = SeenHalfArc_rad(radius_mm);
  for (int i = 0; i < kArcSamples; ++i) visit(half_arc_rad * ((2.0 * i + 1) / kArcSamples - 1));
}

// Mean place (pipe frame) of the material points of one cross-section's visible arc.
Eigen::Vector3d MeanInPipe_mm(const DeformedPipe& pipe, double x_mm) {
  Eigen::Vector3d sum_mm = Eigen::Vector3d::Zero();
  ForVisibleArc(pipe.radius_mm,
                [&](double angle_rad) { sum_mm += pipe.InPipe(pipe.Material(x_mm, angle_rad)); });
  return sum_mm / kArcSamples;
}

double StrainBetween(const DeformedPipe& state, const DeformedPipe& reference, double from_mm,
                     double to_mm) {
  const Eigen::Vector3d before_mm =
      MeanInPipe_mm(reference, to_mm) - MeanInPipe_mm(reference, from_mm);
  const Eigen::Vector3d after_mm = MeanInPipe_mm(state, to_mm) - MeanInPipe_mm(state, from_mm);
  return after_mm.norm() / before_mm.norm() - 1;  // of the material line, as a gauge has it
}

double MeanPatchX_mm(const VirtualInstrument& instrument, const std::string& group) {
  double sum = 0;
  int count = 0;
  for (const InstrumentView& view : instrument.views) {
    if (view.view.group != group) continue;
    sum += view.center_in_array_mm.x();
    ++count;
  }
  return sum / count;
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
    DeformedPipe pipe = PipeUnderLoad(options, spec, share);
    MoveRigidly(options, motion, pipe);
    std::string number = std::to_string(i);
    if (number.size() < 3) number.insert(0, 3 - number.size(), '0');
    states.push_back({{"pipe/pipe_" + number + ".png", std::to_string(cycle + 1),
                       std::to_string(step), i * options.image_interval_s,
                       ReadGauges(options, pipe, gauges), ReadTemperature_c(options, share)},
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
  TrueStrain strain{StrainBetween(state, reference, patch_a_x_mm, patch_b_x_mm),
                    local(patch_a_x_mm), local(patch_b_x_mm)};
  for (const double x_mm : {patch_a_x_mm, patch_b_x_mm})
    ForVisibleArc(state.radius_mm, [&](double angle_rad) {
      const SurfaceStrain surface = state.StrainAt(x_mm, angle_rad);
      strain.hoop += surface.hoop / (2 * kArcSamples);
      strain.shear += surface.shear / (2 * kArcSamples);
    });
  return strain;
}

TrueStrain StrainOf(const ExperimentTruth& truth, const PipeTruth& state) {
  return StrainOf(state.pipe, truth.pipe.front().pipe, MeanPatchX_mm(truth.instrument, "A"),
                  MeanPatchX_mm(truth.instrument, "B"));
}

}  // namespace telestrain
