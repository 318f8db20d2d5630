#include "simulation/image_conditions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/mirror_errors.h"
#include "simulation/nominal_session.h"

namespace telestrain {
namespace {

TEST(InstrumentAtImage, DriftDiesAwayExponentiallyTowardsTheTruth) {
  VirtualExperimentOptions options;
  options.preheat_s = 100;
  options.warmup_drift_um = 30;
  options.warmup_drift_ppm = 80;
  const VirtualInstrument warm = MakeInstrument(options, NominalSession(options));
  Eigen::Vector2d first_direction = Eigen::Vector2d::Zero();
  for (const int number : {0, 1, 10}) {
    const double cold = std::exp(-(100 + 20.0 * number) / 200);
    const VirtualInstrument now = InstrumentAtImage(options, warm, number);
    EXPECT_NEAR(now.lens.magnification_px_per_mm / warm.lens.magnification_px_per_mm - 1,
                80e-6 * cold, 1e-14);
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d shift = now.views[i].view.offset_mm - warm.views[i].view.offset_mm;
      EXPECT_NEAR(shift.norm(), 0.03 * cold, 1e-13);
      if (i != 0) continue;
      if (number == 0) first_direction = shift.normalized();
      EXPECT_NEAR(shift.normalized().dot(first_direction), 1, 1e-12);
    }
  }
}

TEST(InstrumentAtImage, IsTheTrueInstrumentWithoutDriftAndVibration) {
  const VirtualExperimentOptions options;
  const VirtualInstrument warm = MakeInstrument(options, NominalSession(options));
  const VirtualInstrument now = InstrumentAtImage(options, warm, 3);
  EXPECT_EQ(now.lens.magnification_px_per_mm, warm.lens.magnification_px_per_mm);
  EXPECT_EQ(now.views[2].view.offset_mm, warm.views[2].view.offset_mm);
  EXPECT_EQ(now.vibration_in_array_mm.norm(), 0);
}

TEST(InstrumentAtImage, VibratesAlongAnotherDirectionInEveryImage) {
  VirtualExperimentOptions options;
  options.vibration_um = 2;
  const VirtualInstrument warm = MakeInstrument(options, NominalSession(options));
  const Eigen::Vector3d a = InstrumentAtImage(options, warm, 0).vibration_in_array_mm;
  const Eigen::Vector3d b = InstrumentAtImage(options, warm, 1).vibration_in_array_mm;
  EXPECT_NEAR(a.norm(), 0.002, 1e-15);
  EXPECT_NEAR(b.norm(), 0.002, 1e-15);
  EXPECT_GT((a - b).norm(), 1e-4);
}

Session DrawingWithMirrors() {
  VirtualExperimentOptions options;
  options.mirrors = true;
  return NominalSession(options);
}

TEST(MisalignMirrors, GivesTheViewThatReflectCameraGivesThroughThem) {
  const Session drawing = DrawingWithMirrors();
  RandomStream random(4);
  for (const NominalView& drawn : drawing.views) {
    const NominalView view = MisalignMirrors(drawing, drawn, 2e-3, 0.03, random);
    const PhysicalCamera camera = ReflectCamera(*drawing.camera, view.mirrors);
    EXPECT_LT((view.image_x_in_array - camera.image_x).norm(), 1e-12);
    EXPECT_LT((view.image_y_in_array - camera.image_y).norm(), 1e-12);
    EXPECT_LT((view.axis_in_array - camera.axis).norm(), 1e-12);
    const Eigen::Vector2d pixel =
        Project(drawing.NominalLens(), ViewOfCamera(camera), view.center_in_array_mm);
    EXPECT_LT((pixel - view.region.Middle()).norm(), 1e-9);
    for (std::size_t i = 0; i < 3; ++i) {
      const Mirror &mirror = view.mirrors[i], &was = drawn.mirrors[i];
      const double tilt = std::acos(std::min(1.0, mirror.normal.dot(was.normal)));
      EXPECT_LE(tilt, std::sqrt(2.0) * 2e-3 + 1e-9);
      EXPECT_GT(tilt, 1e-5);
      EXPECT_LE((mirror.point_mm - was.point_mm).norm(), 0.03 + 1e-12);
    }
    // A mirror turns the view by twice its tilt at the most, three mirrors by three times that.
    EXPECT_LE((view.axis_in_array - drawn.axis_in_array).norm(), 6 * std::sqrt(2.0) * 2e-3);
    EXPECT_GT((view.center_in_array_mm - drawn.center_in_array_mm).norm(), 1e-3);
  }
}

TEST(MisalignMirrors, ChangesNothingWithoutErrors) {
  const Session drawing = DrawingWithMirrors();
  RandomStream random(4);
  for (const NominalView& drawn : drawing.views) {
    const NominalView view = MisalignMirrors(drawing, drawn, 0, 0, random);
    EXPECT_LT((view.axis_in_array - drawn.axis_in_array).norm(), 1e-12);
    EXPECT_LT((view.center_in_array_mm - drawn.center_in_array_mm).norm(), 1e-9);
  }
}

TEST(MakeInstrument, SeesThroughMisalignedMirrors) {
  VirtualExperimentOptions options;
  options.view_error_deg = options.view_error_mm = 0;
  const VirtualInstrument drawn = MakeInstrument(options, NominalSession(options));
  options.mirror_error_mrad = 1;
  const VirtualInstrument off = MakeInstrument(options, NominalSession(options));
  for (std::size_t i = 0; i < 4; ++i) {
    const double turn = (off.views[i].viewing_direction - drawn.views[i].viewing_direction).norm();
    EXPECT_GT(turn, 1e-5);
    EXPECT_LT(turn, 6 * std::sqrt(2.0) * 1e-3);
  }
}

}  // namespace
}  // namespace telestrain
