#include "simulation/deformed_pipe.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "geometry/rotation.h"
#include "simulation/load_case.h"
#include "simulation/load_plan.h"
#include "tests/unit/simulation/loaded_pipe.h"

namespace telestrain {
namespace {

using testing_support::LoadedPipe;

TEST(DeformedPipe, MaterialPointsAreStrainedAsAsked) {
  const DeformedPipe pipe = LoadedPipe();
  for (const double angle : {-0.5, 0.0, 0.4, std::numbers::pi / 2, std::numbers::pi})
    for (const double x_mm : {-14.0, 0.0, 13.0}) {
      const double half_mm = 0.5;
      const double length_mm = (pipe.InArray(pipe.Material(x_mm + half_mm, angle)) -
                                pipe.InArray(pipe.Material(x_mm - half_mm, angle)))
                                   .norm();
      // The fibre also turns by k s < 1.5e-4, which lengthens it by half the square: 1e-8.
      EXPECT_NEAR(length_mm - 1, pipe.AxialStrain(angle), 2e-8);
    }
}

TEST(DeformedPipe, ContractsAcrossByPoissonsRatio) {
  DeformedPipe pipe = LoadedPipe();
  pipe.curvature_per_mm = 0;
  const Eigen::Vector3d left = pipe.InArray(pipe.Material(5, -std::numbers::pi / 2));
  const Eigen::Vector3d right = pipe.InArray(pipe.Material(5, std::numbers::pi / 2));
  EXPECT_NEAR((right - left).norm() / 8 - 1, -0.31 * 750e-6, 1e-12);
}

TEST(DeformedPipe, RigidMotionCarriesTheReferenceIntoTheState) {
  const DeformedPipe state = LoadedPipe();
  DeformedPipe unloaded = state, reference = state;
  unloaded.membrane_strain = unloaded.curvature_per_mm = 0;
  reference = unloaded;
  reference.array_from_pipe = ExpRotation({0.01, 0.02, -0.01});
  reference.origin_in_array_mm = {0.1, 0.2, -3.9};
  const Eigen::Vector3d material = state.Material(7, 0.3);
  const Eigen::Vector3d moved = unloaded.RotationFrom(reference) * reference.InArray(material) +
                                unloaded.TranslationFrom_mm(reference);
  EXPECT_LT((moved - unloaded.InArray(material)).norm(), 1e-12);
}

TEST(StrainOf, GivesMembraneStrainMinusTheBendingOfTheVisibleArc) {
  DeformedPipe state = LoadedPipe();
  DeformedPipe reference = state;
  reference.membrane_strain = reference.curvature_per_mm = 0;
  const TrueStrain strain = StrainOf(state, reference, -13.85, 13.85);
  // The arc ends where a view at 30 deg sees the surface 486 px of 4.4 um from its middle.
  const double half_angle = std::numbers::pi / 6;
  double arc = 0;
  while (state.radius_mm *
             (std::sin(arc) * std::cos(half_angle) + (1 - std::cos(arc)) * std::sin(half_angle)) <
         486 * 4.4e-3)
    arc += 1e-6;
  const double expected = 750e-6 - 40e-6 * std::sin(arc) / arc;
  EXPECT_NEAR(strain.long_base, expected, 1e-9);  // midpoint rule on 64 arcs
  // Bent by 1e-5 per mm, the patches lean by 1.4e-4: the square of it over 2 is 1e-8.
  EXPECT_NEAR(strain.local_a, expected, 1e-9 + 1e-8);
  EXPECT_NEAR(strain.local_b, expected, 1e-9 + 1e-8);
  EXPECT_NEAR(StrainOf(reference, reference, -13.85, 13.85).long_base, 0, 1e-12);
}

TEST(StrainOf, AWidePipeShowsItsOutermostFibreOnly) {
  DeformedPipe reference;
  reference.radius_mm = 100;
  DeformedPipe state = reference;
  state.curvature_per_mm = 500e-6 / 100;
  // The views see less than 1.5 deg to either side: cos differs from 1 by 3e-4.
  EXPECT_NEAR(StrainOf(state, reference, -13.85, 13.85).long_base, -500e-6, 500e-6 * 3e-4);
}

DeformedPipe Unloaded(const DeformedPipe& pipe) {
  DeformedPipe unloaded;
  unloaded.radius_mm = pipe.radius_mm;
  unloaded.bend_radius_mm = pipe.bend_radius_mm;
  return unloaded;
}

// Strains of the surface from positions alone: central differences over 20 um, whose error is
// h^2 / 6 times the third derivative, below (0.01 / 4)^2 / 6 of 2e-3 for the fields and, for the
// circle itself, the same in both states.
SurfaceStrain StrainByDifferences(const DeformedPipe& pipe, double x_mm, double angle_rad) {
  constexpr double kHalf_mm = 0.01;
  const auto tangents = [&](const DeformedPipe& state) {
    const double turn = kHalf_mm / state.radius_mm;
    Eigen::Matrix<double, 3, 2> pair;
    pair.col(0) = state.InArray(state.Material(x_mm + kHalf_mm, angle_rad)) -
                  state.InArray(state.Material(x_mm - kHalf_mm, angle_rad));
    pair.col(1) = state.InArray(state.Material(x_mm, angle_rad + turn)) -
                  state.InArray(state.Material(x_mm, angle_rad - turn));
    return pair;
  };
  const auto before = tangents(Unloaded(pipe)), after = tangents(pipe);
  const double cosine = after.col(0).normalized().dot(after.col(1).normalized());
  return {after.col(0).norm() / before.col(0).norm() - 1,
          after.col(1).norm() / before.col(1).norm() - 1, std::asin(cosine)};
}

VirtualExperimentOptions NoLoad() {
  VirtualExperimentOptions options;
  options.strain_max_microstrain = options.bending_max_microstrain = 0;
  return options;
}

constexpr double kPoisson = 0.31;
DeformedPipe FullLoad(const VirtualExperimentOptions& options) {
  return PipeUnderLoad(options, {options.pipe_diameter_mm, kPoisson, ""}, 1);
}

TEST(DeformedPipe, SurfaceStrainsAreThoseOfThePositionsUnderEveryLoad) {
  using Options = VirtualExperimentOptions;
  const std::pair<double Options::*, double> loads[] = {{&Options::strain_max_microstrain, 1500},
                                                        {&Options::bending_max_microstrain, 300},
                                                        {&Options::torsion_max_microstrain, 1200},
                                                        {&Options::pressure_max_mpa, 40},
                                                        {&Options::temperature_change_k, 60}};
  for (const double bend_radius_mm : {0.0, 120.0, -300.0})
    for (int chosen = 0; chosen < 32; ++chosen) {
      VirtualExperimentOptions options = NoLoad();
      options.pipe_bend_radius_mm = bend_radius_mm;
      for (int i = 0; i < 5; ++i)
        if ((chosen >> i) % 2 == 1) options.*loads[i].first = loads[i].second;
      const DeformedPipe pipe = FullLoad(options);
      for (const auto& [x_mm, angle] : {std::pair{-14.0, -0.5}, {0.0, 0.3}, {13.0, 2.0}}) {
        const SurfaceStrain stated = pipe.StrainAt(x_mm, angle);
        const SurfaceStrain found = StrainByDifferences(pipe, x_mm, angle);
        EXPECT_NEAR(found.axial, stated.axial, 5e-9) << chosen << ' ' << bend_radius_mm;
        EXPECT_NEAR(found.hoop, stated.hoop, 5e-9) << chosen << ' ' << bend_radius_mm;
        EXPECT_NEAR(found.shear, stated.shear, 5e-9) << chosen << ' ' << bend_radius_mm;
      }
    }
}

TEST(DeformedPipe, ShearsUnderTorsionAndKeepsItsDiameter) {
  VirtualExperimentOptions options = NoLoad();
  options.torsion_max_microstrain = 1000;
  const SurfaceStrain strain = FullLoad(options).StrainAt(10, 0.4);
  EXPECT_NEAR(strain.shear, std::atan(1e-3), 1e-12);
  EXPECT_NEAR(strain.axial, std::hypot(1, 1e-3) - 1, 1e-12);  // a helix is longer than its axis
  EXPECT_NEAR(strain.hoop, 0, 1e-12);
}

TEST(DeformedPipe, ExpandsUnderPressureLikeAThickWallWithClosedEnds) {
  VirtualExperimentOptions options = NoLoad();
  options.pressure_max_mpa = 20;
  const SurfaceStrain strain = FullLoad(options).StrainAt(3, 0.2);
  EXPECT_NEAR(strain.hoop / strain.axial, (2 - kPoisson) / (1 - 2 * kPoisson), 1e-9);
  // Stress around the pipe, from the strains by Hooke's law: balances the pressure in a cut wall.
  const double modulus_mpa = 106e3, outer_mm = 4, inner_mm = 3.4;
  const double axial_mpa =
      modulus_mpa / (1 - kPoisson * kPoisson) * (strain.axial + kPoisson * strain.hoop);
  const double end_force_n = 20 * std::numbers::pi * inner_mm * inner_mm;
  const double wall_mm2 = std::numbers::pi * (outer_mm * outer_mm - inner_mm * inner_mm);
  EXPECT_NEAR(axial_mpa * wall_mm2, end_force_n, 1e-9 * end_force_n);
  // A thin wall's kettle formula, with a relative error of the order of wall / radius.
  options.wall_thickness_mm = 0.05;
  const double thin = FullLoad(options).StrainAt(3, 0.2).hoop;
  EXPECT_NEAR(thin, 20 * 4 / 0.05 / modulus_mpa * (1 - kPoisson / 2), 0.03 * thin);
}

TEST(DeformedPipe, ExpandsAlikeEverywhereWhenWarmedAndGaugesReadIt) {
  VirtualExperimentOptions options = NoLoad();
  options.temperature_change_k = 25;
  options.gauge_sigma_microstrain = 0;
  const SurfaceStrain strain = FullLoad(options).StrainAt(-8, 1);
  EXPECT_NEAR(strain.axial, 25 * 8.6e-6, 1e-12);
  EXPECT_NEAR(strain.hoop, 25 * 8.6e-6, 1e-12);
  EXPECT_NEAR(strain.shear, 0, 1e-12);
  const auto states = PlanLoads(options, {8, kPoisson, ""});
  EXPECT_EQ(*states[3].state.gauges_microstrain[1], 215);
}

TEST(DeformedPipe, KeepsArcLengthsAndCurvatureWhenBentWithoutLoad) {
  VirtualExperimentOptions options = NoLoad();
  options.pipe_bend_radius_mm = 150;
  const DeformedPipe pipe = FullLoad(options);
  double length_mm = 0;
  const int steps = 1000;
  for (int i = 0; i < steps; ++i)
    length_mm += (pipe.InPipe({-14 + 28.0 * (i + 1) / steps, 0, 0}) -
                  pipe.InPipe({-14 + 28.0 * i / steps, 0, 0}))
                     .norm();
  EXPECT_NEAR(length_mm, 28, 1e-7);  // chords of 1.9e-4 rad: short by a 24th of its square
  const Eigen::Vector3d center(0, 0, 150);
  for (const double x_mm : {-13.0, 0.0, 5.0}) {
    EXPECT_NEAR((pipe.InPipe({x_mm, 0, 0}) - center).norm(), 150, 1e-11);
    EXPECT_NEAR((pipe.InPipe({x_mm, 0, 4}) - center).norm(), 146, 1e-11);
    EXPECT_EQ(pipe.StrainAt(x_mm, 0.3).axial, 0);
  }
}

TEST(StrainOf, ReportsHoopAndShearOfTheSurface) {
  VirtualExperimentOptions options = NoLoad();
  options.pressure_max_mpa = 20;
  options.torsion_max_microstrain = 700;
  const DeformedPipe state = FullLoad(options), reference = FullLoad(NoLoad());
  const TrueStrain strain = StrainOf(state, reference, -13.85, 13.85);
  // The turned section is widened by 2.4e-3 rad squared over 2 less: loads add up linearly.
  EXPECT_NEAR(strain.hoop, state.pressure_hoop_strain, 3e-6 * state.pressure_hoop_strain);
  EXPECT_NEAR(strain.shear, 7e-4, 1e-6);  // strains of second order
  // The line between the patches' middles leans by the shear, less what the arc's middle lies
  // inside the surface (8 % at the most): gamma^2 / 2 of its length.
  const double lean = 0.5 * 7e-4 * 7e-4;
  EXPECT_LT(strain.long_base, state.pressure_axial_strain + lean);
  EXPECT_GT(strain.long_base, state.pressure_axial_strain + 0.84 * lean);
}

}  // namespace
}  // namespace telestrain
