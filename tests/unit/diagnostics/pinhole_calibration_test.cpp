#include "diagnostics/pinhole_calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/rotation.h"
#include "unit/diagnostics/pinhole_array.h"

namespace telestrain {
namespace {

using testing_support::MakeCase;
using testing_support::PinholeCase;
using testing_support::RmsError_um;
using testing_support::SyntheticOptions;

PinholeCase ExactCase(bool mirrored) {
  SyntheticOptions options;
  options.noise_px = 0;
  options.mirrored = mirrored;
  return MakeCase(options);
}

PinholeOptions At(double working_distance_mm) {
  PinholeOptions options;
  options.working_distance_mm = working_distance_mm;
  return options;
}

// Rotations between the views: free of the gauge.
void ExpectSameViews(const std::vector<PinholeView>& found, const std::vector<PinholeView>& truth) {
  for (std::size_t v = 0; v < truth.size(); ++v) {
    EXPECT_EQ(found[v].flipped, truth[v].flipped);
    // 1e-6 px on a board of 200 px radius are 5e-9 rad.
    EXPECT_LT(AngleBetween_rad(found[v].camera_from_array * found[0].camera_from_array.transpose(),
                               truth[v].camera_from_array * truth[0].camera_from_array.transpose()),
              1e-8);
    EXPECT_NEAR(found[v].FocalLength_px() / truth[v].FocalLength_px(), 1, 1e-6);
  }
}

TEST(CalibratePinhole, ExactPinholeCornersGiveTheExactCameras) {
  for (const bool mirrored : {false, true}) {
    PinholeCase made = ExactCase(mirrored);
    const auto truth = PinholeViewsAt(made.array.session, made.data, made.telecentric, At(120));
    EXPECT_EQ(truth[0].flipped, !mirrored);  // three mirrors: odd
    SeeWith(truth, made);
    DisturbStart(made);
    const PinholeCalibration found = made.MustCalibrate(At(120));
    EXPECT_LT(found.all.max_px, 1e-6);
    EXPECT_FALSE(found.hit_iteration_limit);
    ExpectSameViews(found.views, truth);
  }
}

TEST(PinholeViewsAt, TakesEveryViewsOwnLens) {
  PinholeCase made = ExactCase(true);
  ArrayCalibration& array = made.telecentric.array;
  array.lenses.assign(4, array.lenses.front());
  for (std::size_t v = 0; v < 4; ++v)
    array.lenses[v].magnification_px_per_mm *= 1 + 0.002 * static_cast<double>(v);
  constexpr double kDistance_mm = 1e9;
  const auto views =
      PinholeViewsAt(made.array.session, made.data, made.telecentric, At(kDistance_mm));
  const Eigen::Vector3d point(0.3, -0.4, 0.6);
  for (int v = 0; v < 4; ++v)
    // Perspective: 1000 px from the principal point times a depth of 8 mm over D; rounding of D.
    EXPECT_LT((*views[static_cast<std::size_t>(v)].Project(point) - array.Project(v, point)).norm(),
              1e-5);
}

TEST(CalibratePinhole, AFreeCoreFindsTheDistanceThatTheCornersHave) {
  PinholeCase made = ExactCase(true);
  const auto truth = PinholeViewsAt(made.array.session, made.data, made.telecentric, At(120));
  SeeWith(truth, made);
  DisturbStart(made);
  PinholeOptions options = At(150);
  options.lock_core = false;
  options.max_iterations = 300;
  const PinholeCalibration found = made.MustCalibrate(options);
  EXPECT_LT(found.all.max_px, 1e-6);
  EXPECT_NEAR(found.focal_length_growth, 1.0, 1e-12);  // 120 / 150 is no growth
  for (std::size_t v = 0; v < truth.size(); ++v)
    EXPECT_NEAR(found.views[v].FocalLength_px() / truth[v].FocalLength_px(), 1, 1e-5);
}

TEST(CalibratePinhole, DistortionIsFoundWhenItIsFree) {
  PinholeCase made = ExactCase(true);
  auto truth = PinholeViewsAt(made.array.session, made.data, made.telecentric, At(120));
  for (PinholeView& view : truth) view.distortion = {1e-4, 0, 2e-4, -1e-4, 0};
  SeeWith(truth, made);
  DisturbStart(made);
  PinholeOptions options = At(120);
  EXPECT_GT(made.MustCalibrate(options).all.max_px, 0.01);  // k1 r^3 m is 0.2 px at 2 mm
  options.free_distortion = true;
  const PinholeCalibration found = made.MustCalibrate(options);
  EXPECT_LT(found.all.max_px, 1e-6);
}

TEST(CalibratePinhole, DistortionAboutTheSensorsMiddleIsFoundThere) {
  PinholeCase made = ExactCase(true);
  PinholeOptions options = At(120);
  options.principal_at_sensor_middle = true;
  auto truth = PinholeViewsAt(made.array.session, made.data, made.telecentric, options);
  EXPECT_EQ(truth[0].principal_px, made.array.session.sensor.Middle());
  for (PinholeView& view : truth) view.distortion = {1e-4, 0, 0, 0, 0};
  SeeWith(truth, made);
  DisturbStart(made);
  options.free_distortion = true;
  EXPECT_LT(made.MustCalibrate(options).all.max_px, 1e-6);
}

TEST(CalibratePinhole, OnTelecentricCornersTheErrorFallsWithTheDistance) {
  for (const bool mirrored : {false, true}) {
    const PinholeCase made = ExactCase(mirrored);
    const double at_1000_px = made.MustCalibrate(At(1000)).all.rms_px;
    // A board of 1.8 mm by 1.2 mm half size, tilted by 30 degrees, is seen with a perspective of up
    // to m 1.8 (1.2 / 2) / D = 0.25 px at 1 m, its RMS over the board is about half of that.
    EXPECT_GT(at_1000_px, 0.06);
    EXPECT_LT(at_1000_px, 0.25);
    for (const double distance_mm : {100.0, 1e4, 1e5})
      // The next order is the depth of the scene, 3 mm, over the distance.
      EXPECT_NEAR(made.MustCalibrate(At(distance_mm)).all.rms_px * distance_mm / 1000 / at_1000_px,
                  1, 3.0 / std::min(distance_mm, 1000.0));
  }
}

TEST(CalibratePinhole, TheLimitOfLargeDistanceIsTheTelecentricFit) {
  for (const bool mirrored : {false, true}) {
    SyntheticOptions options;
    options.mirrored = mirrored;
    const PinholeCase made = MakeCase(options);
    const PinholeCalibration far = made.MustCalibrate(At(1e7));
    // Beyond the telecentric fit it has 3 magnifications and no stage (27 equations, 2 tilts): the
    // squares fall by chi-square of 28, less than 57 (p = 0.001) of 16848.
    EXPECT_LE(far.all.rms_px, made.telecentric_rms_px * (1 + 1e-6));
    EXPECT_GT(far.all.rms_px, made.telecentric_rms_px * (1 - 57.0 / 16848 / 2));
    EXPECT_EQ(far.all.corners, 72 * 117);
    EXPECT_EQ(far.of_view.size(), 4u);
    EXPECT_EQ(far.errors_px.size(), made.data.boards.size());
  }
}

TEST(CalibratePinhole, AFreeCoreHasNoFiniteOptimumOnTelecentricCorners) {
  const PinholeCase made = MakeCase({});
  PinholeOptions options = At(100);
  options.lock_core = false;
  options.max_iterations = 60;
  const PinholeCalibration found = made.MustCalibrate(options);
  EXPECT_TRUE(found.hit_iteration_limit);
  EXPECT_GT(found.focal_length_growth, 1000);
  EXPECT_LT(found.all.rms_px, made.MustCalibrate(At(1e4)).all.rms_px);
}

TEST(MeasureRulerWithPinhole, ErrorsFallWithTheDistance) {
  PinholeCase made = ExactCase(true);
  const auto crosses = MakeRulers(made.array, 12);
  const auto error_um = [&](double distance_mm) {
    return RmsError_um(MeasureRulerWithPinhole(made.array.session,
                                               made.MustCalibrate(At(distance_mm)).views, crosses));
  };
  const double at_100_um = error_um(100);
  EXPECT_GT(at_100_um, 0.5);
  // The next order is the depth of the scene, 3 mm, over the distance; twice, as the first order
  // of a length between two fields is a difference.
  EXPECT_NEAR(at_100_um / error_um(1000) / 10, 1, 2 * 3.0 / 100);
  EXPECT_LT(error_um(1e7), 1e-4 * at_100_um);
}

TEST(MeasureRulerWithPinhole, AMissingCrossIsRejectedWithAReason) {
  PinholeCase made = ExactCase(false);
  auto crosses = MakeRulers(made.array, 2);
  crosses[1].center.reset();
  const auto lengths =
      MeasureRulerWithPinhole(made.array.session, made.MustCalibrate(At(1000)).views, crosses);
  ASSERT_EQ(lengths.size(), 2u);
  EXPECT_NE(lengths[0].rejected_because, "");
  EXPECT_EQ(lengths[1].rejected_because, "");
}

}  // namespace
}  // namespace telestrain
