// The split of the strain into membrane, bending and torsion, gauges, temperature and the limits of
// the depth of field, against the simulator's loaded pipe. No image involved.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/rotation.h"
#include "measurement/strain.h"
#include "simulation/deformed_pipe.h"
#include "unit/measurement/virtual_pipe.h"

namespace telestrain {
namespace {

using testing_support::VirtualPipe;

constexpr double kMicro = 1e-6;
constexpr double kRadPerDeg = std::numbers::pi / 180;

DeformedPipe LoadedPipe() {
  DeformedPipe pipe;
  pipe.radius_mm = 4;
  pipe.poisson_ratio = 0.31;
  pipe.membrane_strain = 750 * kMicro;
  pipe.curvature_per_mm = 150 * kMicro / 4;
  pipe.curvature_angle_rad = 40 * kRadPerDeg;
  pipe.twist_rad_per_mm = 200 * kMicro / 4;
  pipe.array_from_pipe = ExpRotation(0.2 * kRadPerDeg * Eigen::Vector3d(1, -1, 1));
  pipe.origin_in_array_mm = Eigen::Vector3d(0.15, -0.15, -4 + 0.15);
  return pipe;
}

// The reference of VirtualPipe is a straight pipe with its axis at z = -4 mm.
std::vector<TrackedPoint> Track(const VirtualPipe& pipe, const DeformedPipe& state,
                                double noise_px = 0, std::uint64_t seed = 1) {
  return pipe.Track(
      [&](const Eigen::Vector3d& p) {
        return state.InArray({p.x(), p.y(), p.z() + 4});
      },
      noise_px, seed);
}

StrainModel ModelOf(const VirtualPipe& pipe) {
  StrainModel model = MakeStrainModel(pipe.grid);
  model.poisson_ratio = 0.31;
  return model;
}

StateStrain MustAnalyse(const VirtualPipe& pipe, const StrainModel& model,
                        const std::vector<TrackedPoint>& tracked,
                        std::optional<double> temperature_change_k = {}) {
  auto result = AnalyseState(pipe.array, pipe.grid, tracked, model, temperature_change_k);
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return std::move(result).value();
}

// Exact pixels: what is left is rounding, 1e-12 mm over a few mm.
constexpr double kRounding = 1e-3 * kMicro;

TEST(StrainSplit, TensionBendingAndTorsionAreToldApartWhateverTheMotion) {
  const VirtualPipe pipe;
  const StateStrain state = MustAnalyse(pipe, ModelOf(pipe), Track(pipe, LoadedPipe()));
  EXPECT_NEAR(state.membrane.value, 750 * kMicro, kRounding);
  // The fibre towards which the axis bends is pressed.
  EXPECT_NEAR(state.bending_0.value, -150 * kMicro * std::cos(40 * kRadPerDeg), kRounding);
  EXPECT_NEAR(state.bending_90.value, -150 * kMicro * std::sin(40 * kRadPerDeg), kRounding);
  EXPECT_NEAR(state.torsion.value, 200 * kMicro, kRounding);
  EXPECT_NEAR(state.across.value, -0.31 * 750 * kMicro, kRounding);
  EXPECT_LT(state.beam_misfit_rms_um, 1e-6);
}

TEST(StrainSplit, RigidMotionAloneSplitsIntoNothing) {
  const VirtualPipe pipe;
  DeformedPipe moved = LoadedPipe();
  moved.membrane_strain = moved.curvature_per_mm = moved.twist_rad_per_mm = 0;
  const StateStrain state = MustAnalyse(pipe, ModelOf(pipe), Track(pipe, moved));
  for (const StrainValue* value :
       {&state.membrane, &state.bending_0, &state.bending_90, &state.torsion, &state.across})
    EXPECT_NEAR(value->value, 0, kRounding);
}

TEST(StrainSplit, TheLongBaseRefersToTheStatedFibre) {
  const VirtualPipe pipe;
  StrainModel model = ModelOf(pipe);
  model.fibre_mm = Eigen::Vector2d(0.2, 3.6);
  const DeformedPipe loaded = LoadedPipe();
  const StateStrain state = MustAnalyse(pipe, model, Track(pipe, loaded));
  const double bending = -loaded.curvature_per_mm * (3.6 * std::cos(loaded.curvature_angle_rad) +
                                                     0.2 * std::sin(loaded.curvature_angle_rad));
  // The chord of the bent and twisted base is shorter or longer by squares of its slopes:
  // (curvature x base / 2)^2 / 2 = 1.4e-7 and (twist x radius)^2 / 2 = 2e-8.
  EXPECT_NEAR(state.axial_strain, 750 * kMicro + bending, 0.2 * kMicro);
  for (const double local : state.local_axial_strain)
    EXPECT_NEAR(local, 750 * kMicro + bending, 0.2 * kMicro);
}

TEST(StrainSplit, AGaugeIsComparedWithTheStrainAtItsPlace) {
  const VirtualPipe pipe;
  StrainModel model = ModelOf(pipe);
  for (const double angle_deg : {0.0, 90.0, 200.0}) {
    PipeGauge& gauge = model.gauges.emplace_back();
    gauge.column = "gauge_" + std::to_string(model.gauges.size()) + "_microstrain";
    gauge.angle_rad = angle_deg * kRadPerDeg;
    gauge.sigma_angle_rad = 1 * kRadPerDeg;
  }
  DeformedPipe loaded = LoadedPipe();
  loaded.twist_rad_per_mm = 0;
  const StateStrain state = MustAnalyse(pipe, model, Track(pipe, loaded));
  ASSERT_EQ(state.gauges.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = model.gauges[i].angle_rad;
    EXPECT_EQ(state.gauges[i].column, model.gauges[i].column);
    EXPECT_NEAR(state.gauges[i].strain.value, loaded.AxialStrain(angle), 10 * kRounding);
    ASSERT_EQ(state.gauges[i].strain.budget[4].source, "fibre");
    const double per_radian = 150 * kMicro * std::sin(angle - loaded.curvature_angle_rad);
    EXPECT_NEAR(state.gauges[i].strain.budget[4].standard_uncertainty,
                std::abs(per_radian) * kRadPerDeg, 1e-3 * 150 * kMicro * kRadPerDeg);
  }
}

TEST(StrainSplit, ThermalExpansionIsTakenOffTheTotal) {
  const VirtualPipe pipe;
  StrainModel model = ModelOf(pipe);
  model.thermal_expansion_per_k = 8.6e-6;
  model.sigma_temperature_k = 0.1;
  model.sigma_thermal_expansion_per_k = 0.2e-6;
  model.gauges = {{"gauge_1_microstrain"}, {"gauge_2_microstrain"}};
  model.gauges[1].reads_thermal_strain = true;
  DeformedPipe loaded = LoadedPipe();
  loaded.curvature_per_mm = loaded.twist_rad_per_mm = 0;
  loaded.thermal_strain = 8.6e-6 * 10;
  const auto tracked = Track(pipe, loaded);
  const StateStrain state = MustAnalyse(pipe, model, tracked, 10);
  ASSERT_TRUE(state.mechanical.has_value());
  EXPECT_NEAR(state.axial_strain, 836 * kMicro, kRounding);
  EXPECT_NEAR(state.mechanical->axial_strain, 750 * kMicro, kRounding);
  EXPECT_NEAR(state.mechanical->membrane_strain, 750 * kMicro, kRounding);
  EXPECT_NEAR(state.gauges[0].strain.value, 750 * kMicro, kRounding);
  EXPECT_NEAR(state.gauges[1].strain.value, 836 * kMicro, kRounding);
  const double sigma = std::hypot(8.6e-6 * 0.1 * std::sqrt(2.0), 10 * 0.2e-6);
  EXPECT_NEAR(state.mechanical->sigma_thermal_strain, sigma, 1e-12);
  EXPECT_FALSE(MustAnalyse(pipe, model, tracked).mechanical.has_value());
}

TEST(StrainSplit, PointsOutOfTheDepthOfFieldAreLeftOutAndCounted) {
  const VirtualPipe pipe;
  StrainModel model = ModelOf(pipe);
  const auto tracked = Track(pipe, LoadedPipe());
  const StateStrain all = MustAnalyse(pipe, model, tracked);
  // The pipe came 0.15 mm nearer; the outermost rows of points lie 4 (1 - cos 0.24) = 0.11 mm below
  // the middle one, so that they stay within 0.1 mm of the focus plane and the middle one does not.
  model.half_depth_of_field_mm = 0.1;
  const StateStrain some = MustAnalyse(pipe, model, tracked);
  const auto out = some.points_rejected.find("out of the depth of field");
  ASSERT_NE(out, some.points_rejected.end());
  EXPECT_EQ(some.points_used + out->second, all.points_used);
  EXPECT_NEAR(some.membrane.value, 750 * kMicro, kRounding);
  model.half_depth_of_field_mm = 2;
  EXPECT_EQ(MustAnalyse(pipe, model, tracked).points_used, all.points_used);
}

TEST(StrainSplit, TheMapHoldsTheWholeTensor) {
  const VirtualPipe pipe;
  DeformedPipe loaded = LoadedPipe();
  loaded.curvature_per_mm = 0;
  const StateStrain state = MustAnalyse(pipe, ModelOf(pipe), Track(pipe, loaded));
  const SurfaceStrain truth = loaded.StrainAt(0, 0);
  for (const PointResult& point : state.points) {
    ASSERT_TRUE(point.used);
    // A twist is not linear in space: at the ends of a patch the surface turns by 200e-6 / 4 mm x
    // 1.5 mm = 7.5e-5 against the patch's field. Times the 0.02 rad that a gauge of few rows may
    // lean from the surface these are 1.5 microstrain.
    EXPECT_NEAR(point.tensor.axial, truth.axial, 0.5 * kMicro);
    EXPECT_NEAR(point.tensor.shear, truth.shear, 2 * kMicro);
    EXPECT_NEAR(point.tensor.hoop, truth.hoop, 2 * kMicro);
  }
}

TEST(SurfaceTensor, KnownStretchesAndShearsGiveBothDefinitions) {
  const SurfaceTensor tensor = TensorOf({1.1, 0, 0}, {0, 0.9, 0});
  EXPECT_NEAR(tensor.axial, 0.1, 1e-15);
  EXPECT_NEAR(tensor.green_axial, (1.21 - 1) / 2, 1e-15);
  EXPECT_NEAR(tensor.principal_1, 0.1, 1e-15);
  EXPECT_NEAR(tensor.principal_2, -0.1, 1e-15);
  EXPECT_NEAR(tensor.principal_angle_rad, 0, 1e-15);
  // Pure shear: principal directions at 45 degrees, half the shear each way to first order.
  constexpr double kShear = 1e-6;
  const SurfaceTensor shear = TensorOf({1, kShear, 0}, {0, 1, 0});
  EXPECT_NEAR(shear.shear, kShear, 1e-12);
  EXPECT_NEAR(shear.green_shear, kShear / 2, 1e-12);
  EXPECT_NEAR(shear.principal_1, kShear / 2, 1e-12);
  EXPECT_NEAR(shear.principal_2, -kShear / 2, 1e-12);
  EXPECT_NEAR(shear.principal_angle_rad, std::numbers::pi / 4, 1e-6);
}

}  // namespace
}  // namespace telestrain
