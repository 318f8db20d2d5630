#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/rotation.h"
#include "optics/telecentric_view.h"
#include "simulation/experiment_truth.h"
#include "simulation/load_plan.h"
#include "simulation/nominal_session.h"
#include "simulation/pipe_image.h"

namespace telestrain {
namespace {

DeformedPipe LoadedPipe() {
  DeformedPipe pipe;
  pipe.radius_mm = 4;
  pipe.poisson_ratio = 0.31;
  pipe.membrane_strain = 750e-6;
  pipe.curvature_per_mm = 40e-6 / 4;
  pipe.array_from_pipe = ExpRotation({0.001, -0.002, 0.0015});
  pipe.origin_in_array_mm = {0.04, -0.03, -4.02};
  return pipe;
}

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
  const double arc = 32 * std::numbers::pi / 180;
  const double expected = 750e-6 - 40e-6 * std::sin(arc) / arc;
  EXPECT_NEAR(strain.long_base, expected, 1e-9);  // midpoint rule on 64 arcs
  EXPECT_NEAR(strain.local_a, expected, 1e-9);
  EXPECT_NEAR(strain.local_b, expected, 1e-9);
  EXPECT_NEAR(StrainOf(reference, reference, -13.85, 13.85).long_base, 0, 1e-12);
}

TEST(PipeRays, FindTheSameMaterialPointInBothViews) {
  const VirtualExperimentOptions options;
  const VirtualInstrument instrument = MakeInstrument(options, NominalSession(options));
  const DeformedPipe pipe = LoadedPipe();
  for (const InstrumentView& view : instrument.views) {
    const double x_mm = view.view.group == "A" ? -13.2 : 14.5;
    const PipeRays rays(pipe, view.viewing_direction);
    for (const double angle : {-0.3, 0.0, 0.25}) {
      const Eigen::Vector3d material = pipe.Material(x_mm, angle);
      const Eigen::Vector2d pixel = Project(instrument.lens, view.view, pipe.InArray(material));
      const Eigen::Vector3d on_ray = view.view.PointOnRay(instrument.lens.IdealFromPixel(pixel));
      Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
      const SurfaceHit hit = rays.Hit(on_ray, displacement);
      EXPECT_LT((hit.material_mm - material).norm(), 1e-9) << view.view.name << ' ' << angle;
      EXPECT_LT(hit.miss_mm, 0);
    }
  }
}

TEST(PipeRays, TellRaysThatMiss) {
  DeformedPipe pipe = LoadedPipe();
  pipe.membrane_strain = pipe.curvature_per_mm = 0;
  pipe.array_from_pipe.setIdentity();
  const PipeRays rays(pipe, {0, 0, -1});
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  const SurfaceHit hit =
      rays.Hit(pipe.origin_in_array_mm + Eigen::Vector3d(0, 4.1, 0), displacement);
  EXPECT_NEAR(hit.miss_mm, 0.1, 1e-12);
  EXPECT_NEAR(hit.cos_incidence, 0, 1e-12);
}

TEST(SpecklePattern, CoversHalfOfTheSurfaceWhateverThePatch) {
  const SurfacePatch wide{{-1, -1}, {1, 1}}, narrow{{-0.2, -0.3}, {0.3, 0.1}};
  const SpecklePattern whole(5, wide, 0.033, 0.0037), part(5, narrow, 0.033, 0.0037);
  double sum = 0;
  int count = 0;
  for (double y = -0.95; y < 0.95; y += 0.0137)
    for (double x = -0.95; x < 0.95; x += 0.0137, ++count) {
      const double paint = whole.Paint({x, y}, 1);
      ASSERT_GE(paint, 0);
      ASSERT_LE(paint, 1);
      sum += paint;
    }
  // A Boolean model of n independent discs' areas: about 4 mm^2 / 0.0012 mm^2 = 3000, sd 0.01.
  EXPECT_NEAR(sum / count, 0.5, 0.04);
  for (double y = -0.29; y < 0.09; y += 0.0173)
    for (double x = -0.19; x < 0.29; x += 0.0173)
      EXPECT_NEAR(part.Paint({x, y}, 1.7), whole.Paint({x, y}, 1.7), 1e-12);
}

TEST(PipeImage, ShowsAMaterialPointWithTheSamePaintInEveryState) {
  VirtualExperimentOptions options;
  options.binning = 4;
  const VirtualInstrument instrument = MakeInstrument(options, NominalSession(options));
  DeformedPipe reference = LoadedPipe();
  reference.membrane_strain = reference.curvature_per_mm = 0;
  const PaintedPipe paint = PaintPipe(instrument, 4, 9);
  // A rigid shift of the pipe by whole pixels of view A1 shifts its image by as many.
  const InstrumentView& view = instrument.views[0];
  DeformedPipe moved = reference;
  VirtualInstrument plain = instrument;
  plain.lens.distortion = {};
  const double px_mm = 1 / plain.lens.magnification_px_per_mm;
  moved.origin_in_array_mm += view.view.axes_in_array.transpose() * Eigen::Vector2d(3, 2) * px_mm;
  plain.views[0].illumination_slope.setZero();
  const GrayImage before = RenderPipe(plain, paint, reference, 2);
  const GrayImage after = RenderPipe(plain, paint, moved, 1);
  for (int y = 40; y < 200; ++y)
    for (int x = 40; x < 280; ++x) ASSERT_NEAR(after.At(x + 3, y + 2), before.At(x, y), 1e-3);
}

TEST(PlanLoads, RisesToTheFullLoadAndReturnsToNone) {
  VirtualExperimentOptions options;
  options.pipe_states = 17;
  options.load_cycles = 2;
  options.gauge_sigma_microstrain = 0;
  PipeSpec spec{8, 0.31, ""};
  const auto states = PlanLoads(options, spec);
  ASSERT_EQ(states.size(), 17U);
  for (const int unloaded : {0, 8, 16}) EXPECT_EQ(states[unloaded].pipe.membrane_strain, 0);
  for (const int full : {4, 12}) EXPECT_NEAR(states[full].pipe.membrane_strain, 750e-6, 1e-15);
  EXPECT_EQ(states[8].state.cycle, "1");
  EXPECT_EQ(states[9].state.cycle, "2");
  EXPECT_EQ(states[9].state.step, "1");
  double gauge_mean = 0;
  for (const auto& gauge : states[12].state.gauges_microstrain) gauge_mean += *gauge / 4;
  EXPECT_NEAR(gauge_mean, 750, 0.005);  // written with two decimals
}

}  // namespace
}  // namespace telestrain
