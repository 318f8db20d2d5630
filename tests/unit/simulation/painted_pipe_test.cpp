#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/rotation.h"
#include "optics/telecentric_view.h"
#include "simulation/experiment_truth.h"
#include "simulation/load_plan.h"
#include "simulation/nominal_session.h"
#include "simulation/pipe_image.h"
#include "simulation/pipe_rays.h"
#include "tests/unit/simulation/loaded_pipe.h"

namespace telestrain {
namespace {

using testing_support::LoadedPipe;

TEST(PipeRays, FindTheSameMaterialPointInBothViews) {
  const VirtualExperimentOptions options;
  const VirtualInstrument instrument = MakeInstrument(options, NominalSession(options));
  const DeformedPipe pipe = LoadedPipe();
  for (const InstrumentView& view : instrument.views) {
    const double x_mm = view.view.group == "A" ? -13.2 : 14.5;
    const PipeRays rays(pipe);
    for (const double angle : {-0.3, 0.0, 0.25}) {
      const Eigen::Vector3d material = pipe.Material(x_mm, angle);
      const Eigen::Vector2d pixel = Project(instrument.lens, view.view, pipe.InArray(material));
      const ChiefRay ray = instrument.RayOf(view, instrument.lens.IdealFromPixel(pixel));
      const SurfaceHit hit = rays.Hit(ray, {});
      EXPECT_LT((hit.material_mm - material).norm(), 1e-9) << view.view.name << ' ' << angle;
      EXPECT_LT(hit.miss_mm, 0);
    }
  }
}

TEST(PipeRays, FindMaterialPointsOfBentTwistedPipesThroughLeaningRays) {
  VirtualExperimentOptions options;
  options.telecentricity_percent_per_mm = 0.5;
  const VirtualInstrument instrument = MakeInstrument(options, NominalSession(options));
  for (const double bend_radius_mm : {100.0, -100.0, 2000.0}) {
    DeformedPipe pipe = LoadedPipe();
    pipe.bend_radius_mm = bend_radius_mm;
    pipe.twist_rad_per_mm = 1e-3 / 4;
    pipe.thermal_strain = 2e-4;
    const PipeRays rays(pipe);
    for (const InstrumentView& view : instrument.views)
      for (const double angle : {-0.5, 0.0, 0.4}) {
        const double x_mm = view.center_in_array_mm.x() + angle;
        const Eigen::Vector3d material = pipe.Material(x_mm, angle);
        const Eigen::Vector2d ideal_mm = instrument.Ideal(view, pipe.InArray(material));
        const SurfaceHit hit = rays.Hit(instrument.RayOf(view, ideal_mm), {});
        EXPECT_LT((hit.material_mm - material).norm(), 1e-9) << view.view.name << ' ' << angle;
      }
  }
}

TEST(PipeRays, TellRaysThatMiss) {
  DeformedPipe pipe = LoadedPipe();
  pipe.membrane_strain = pipe.curvature_per_mm = 0;
  pipe.array_from_pipe.setIdentity();
  const Eigen::Vector3d beside = pipe.origin_in_array_mm + Eigen::Vector3d(0, 4.1, 0);
  const SurfaceHit hit = PipeRays(pipe).Hit({beside, {0, 0, -1}}, {});
  EXPECT_NEAR(hit.miss_mm, 0.1, 1e-12);
  EXPECT_NEAR(hit.cos_incidence, 0, 1e-12);
}

Eigen::Matrix2d Round(double sigma_mm) { return sigma_mm * sigma_mm * Eigen::Matrix2d::Identity(); }

TEST(SpecklePattern, CoversHalfOfTheSurfaceWhateverThePatch) {
  const SurfacePatch wide{{-1, -1}, {1, 1}}, narrow{{-0.2, -0.3}, {0.3, 0.1}};
  const SpecklePattern whole(5, wide, 0.033), part(5, narrow, 0.033);
  double sum = 0;
  int count = 0;
  for (double y = -0.95; y < 0.95; y += 0.0137)
    for (double x = -0.95; x < 0.95; x += 0.0137, ++count) {
      const double paint = whole.Paint({x, y}, Round(0.0037));
      ASSERT_GE(paint, 0);
      ASSERT_LE(paint, 1);
      sum += paint;
    }
  // A Boolean model of n independent discs' areas: about 4 mm^2 / 0.0012 mm^2 = 3000, sd 0.01.
  EXPECT_NEAR(sum / count, 0.5, 0.04);
  for (double y = -0.29; y < 0.09; y += 0.0173)
    for (double x = -0.19; x < 0.29; x += 0.0173)
      EXPECT_NEAR(part.Paint({x, y}, Round(0.006)), whole.Paint({x, y}, Round(0.006)), 1e-12);
}

TEST(SpecklePattern, BlursDiscsAlongTheMotionOnly) {
  const SpecklePattern pattern(3, {{0, 0}, {1, 1}}, 0.05);
  Eigen::Matrix2d cov;
  cov << 0.0075 * 0.0075, 0, 0, 0.00125 * 0.00125;
  double along = 0, across = 0;
  for (double y = 0.1; y < 0.9; y += 0.0031)
    for (double x = 0.1; x < 0.9; x += 0.0031) {
      const double paint = pattern.Paint({x, y}, cov);
      along += std::pow(pattern.Paint({x + 0.00025, y}, cov) - paint, 2);
      across += std::pow(pattern.Paint({x, y + 0.00025}, cov) - paint, 2);
    }
  // Squared slopes of an edge add up to n_x^2 / sigma and n_y^2 / sigma, sigma = |(6 n_x, n_y)|:
  // over all directions 0.44 to 1, here of some 200 discs.
  EXPECT_LT(along, 0.6 * across);
}

TEST(SpecklePattern, LosesContrastWhenTheBlurIsWiderThanItsDiscs) {
  const SpecklePattern pattern(5, {{-1, -1}, {1, 1}}, 0.033);
  const auto spread = [&](double sigma_mm) {
    double sum = 0, squares = 0;
    int count = 0;
    for (double y = -0.9; y < 0.9; y += 0.0137)
      for (double x = -0.9; x < 0.9; x += 0.0137, ++count) {
        const double paint = pattern.Paint({x, y}, Round(sigma_mm));
        sum += paint;
        squares += paint * paint;
      }
    return std::sqrt(squares / count - sum * sum / count / count);
  };
  EXPECT_GT(spread(0.002), 0.42);  // sharp: 0.5 but for the edges
  // Area weights of a Gaussian: n = 800 discs/mm^2 of a = 8.6e-4 mm^2 each give the variance
  // n a^2 / (4 pi sigma^2 + 2 a) of the coverage, a quarter of it where half is covered already.
  EXPECT_NEAR(spread(0.03), 0.5 * std::sqrt(800 * 8.6e-4 * 8.6e-4 / (0.0113 + 0.0017)), 0.03);
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
