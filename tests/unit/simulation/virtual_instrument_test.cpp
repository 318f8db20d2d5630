#include "simulation/virtual_instrument.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/nominal_session.h"

namespace telestrain {
namespace {

constexpr double kKappa_per_mm = 2e-4;

VirtualInstrument LeaningInstrument() {
  VirtualExperimentOptions options;
  options.telecentricity_percent_per_mm = 100 * kKappa_per_mm;
  options.distortion_percent = 0.5;
  return MakeInstrument(options, NominalSession(options));
}

TelecentricLens MeasuringLens(const VirtualInstrument& instrument) {
  TelecentricLens lens = instrument.lens;
  lens.telecentricity_per_mm = instrument.telecentricity_per_mm;
  return lens;
}

// The simulator and the measurement have the same model, each by its own formulas.
TEST(VirtualInstrument, SeesAPointWhereTheMeasuringLensDoes) {
  const VirtualInstrument instrument = LeaningInstrument();
  const TelecentricLens lens = MeasuringLens(instrument);
  for (const InstrumentView& view : instrument.views)
    for (double across_mm = -2; across_mm <= 2; across_mm += 0.8)
      for (const double depth_mm : {-3.0, 0.0, 0.7, 5.0}) {
        const Eigen::Vector3d point = view.center_in_array_mm +
                                      Eigen::Vector3d(across_mm, 0.7, -0.3 * across_mm) +
                                      depth_mm * view.viewing_direction;
        // Rounding of 2600 px, some operations.
        EXPECT_LT((Project(lens, view.view, point) - instrument.Project(view, point)).norm(),
                  1e-11);
        EXPECT_NEAR(view.view.Depth_mm(point), view.BeyondFocus_mm(point), 1e-13);
      }
}

TEST(VirtualInstrument, ChiefRaysAreTheRaysOfThePixels) {
  const VirtualInstrument instrument = LeaningInstrument();
  const TelecentricLens lens = MeasuringLens(instrument);
  for (const InstrumentView& view : instrument.views) {
    const Eigen::Vector2d pixel = view.region.Middle() + Eigen::Vector2d(200, -150);
    const ImageRay ray = RayOfPixel(lens, view.view, pixel);
    const ChiefRay chief = instrument.RayOf(view, lens.IdealFromPixel(pixel));
    EXPECT_LT((ray.At(0) - chief.point_in_array_mm).norm(), 1e-13);  // rounding of 20 mm
    EXPECT_LT((ray.direction_in_array - chief.direction_in_array).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace telestrain
