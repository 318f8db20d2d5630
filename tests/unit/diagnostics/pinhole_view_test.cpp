#include "diagnostics/pinhole_view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "geometry/rotation.h"

namespace telestrain {
namespace {

constexpr double kDistance_mm = 200;

// Looks at the array's origin along `axis`, u along x of the array where that is possible.
PinholeView ViewAlong(const Eigen::Vector3d& axis, bool flipped) {
  PinholeView view;
  view.flipped = flipped;
  view.working_distance_mm = kDistance_mm;
  view.scale_px_per_mm = 227;
  view.principal_px = {647.5, 485.5};
  const Eigen::Vector3d z = axis.normalized();
  view.camera_from_array =
      RotationFromRows(Eigen::Vector3d::UnitX(), z.cross(Eigen::Vector3d::UnitX()).normalized());
  view.origin_in_camera_mm = {0.3, -0.2, kDistance_mm};
  return view;
}

std::vector<PinholeView> Pair(bool flipped) {
  std::vector<PinholeView> views{ViewAlong({0, 0.5, -0.866}, flipped),
                                 ViewAlong({0, -0.5, -0.866}, flipped)};
  for (PinholeView& view : views) view.distortion = {1e-5, 2e-7, 3e-5, -2e-5, 1e-9};
  return views;
}

const Eigen::Vector3d kPoint(1.4, -0.7, 0.6);

TEST(PinholeView, ProjectsAsTheTextbookSays) {
  PinholeView view = ViewAlong({0, 0, -1}, false);
  view.distortion[0] = 1e-4;
  // x = 1.4 + 0.3, y = 0.7 - 0.2 (v runs against y), Z = 200 - 0.6.
  const Eigen::Vector2d slope(1.7 / 199.4, 0.5 / 199.4);
  const double k1 = view.DistortionOfOpenCv()[0];
  const Eigen::Vector2d expected =
      view.principal_px + view.FocalLength_px() * slope * (1 + k1 * slope.squaredNorm());
  EXPECT_LT((view.Project(kPoint).value() - expected).norm(), 1e-10);  // rounding of 1000 px
}

TEST(PinholeView, AFlippedViewIsTheMirrorImageInU) {
  const PinholeView plain = ViewAlong({0, 0, -1}, false), flipped = ViewAlong({0, 0, -1}, true);
  const Eigen::Vector2d a = *plain.Project(kPoint), b = *flipped.Project(kPoint);
  EXPECT_DOUBLE_EQ(a.x() - plain.principal_px.x(), plain.principal_px.x() - b.x());
  EXPECT_DOUBLE_EQ(a.y(), b.y());
}

TEST(PinholeView, ALensThatIsNotQuiteTelecentricIsAPinholeFarAway) {
  constexpr double kKappa_per_mm = 2e-4;
  const TelecentricLens lens{
      227, {647.5, 485.5}, {1e-5, 2e-7, 3e-5, -2e-5, 1e-9}, 1, kKappa_per_mm};
  TelecentricView telecentric;
  telecentric.axes_in_array = RotationFromRows({1, 0, 0}, {0, -0.8, -0.6}).topRows<2>();
  telecentric.offset_mm = {0.3, -0.2};
  telecentric.depth_offset_mm = 1.5;
  PinholeView view;
  view.working_distance_mm = 1 / kKappa_per_mm;
  view.scale_px_per_mm = lens.magnification_px_per_mm;
  view.principal_px = lens.center_px;
  view.distortion = lens.distortion;
  view.camera_from_array = telecentric.Rotation();
  view.origin_in_camera_mm = {0.3, -0.2, 1 / kKappa_per_mm + 1.5};
  for (const double x : {-2.0, 0.0, 3.0})
    for (const double z : {-4.0, 0.0, 5.0}) {
      const Eigen::Vector3d point(x, 1 - x, z);
      // Rounding of 1000 px and of 5000 mm, which is 1e-12 of 5 mm, times 227 px/mm.
      EXPECT_LT((*view.Project(point) - Project(lens, telecentric, point)).norm(), 2e-11);
    }
}

TEST(PinholeView, SeesNothingBehindItself) {
  EXPECT_FALSE(ViewAlong({0, 0, -1}, false).Project({0, 0, kDistance_mm + 1}).has_value());
}

TEST(PinholeView, TriangulationInvertsProjection) {
  for (const bool flipped : {false, true}) {
    const auto views = Pair(flipped);
    const auto point =
        Triangulate(views, {{0, *views[0].Project(kPoint)}, {1, *views[1].Project(kPoint)}});
    ASSERT_TRUE(point.has_value());
    // 1e-13 mm of the undistortion and rounding of 200 mm, times 2 for the 60 degree pair.
    EXPECT_LT((*point - kPoint).norm(), 1e-11);
  }
}

TEST(PinholeView, TriangulationIsTheLeastReprojectionError) {
  auto views = Pair(false);
  for (PinholeView& view : views) view.distortion = {};
  views[1].scale_px_per_mm /= 3;  // pixels count alike, not millimetres
  const std::vector<PinholeMeasurement> measured{
      {0, *views[0].Project(kPoint) + Eigen::Vector2d(0.8, -0.5)},
      {1, *views[1].Project(kPoint) + Eigen::Vector2d(-0.7, 0.9)}};
  const auto cost_px2 = [&](const Eigen::Vector3d& point) {
    double sum = 0;
    for (const auto& m : measured)
      sum += (*views[static_cast<std::size_t>(m.view)].Project(point) - m.pixel).squaredNorm();
    return sum;
  };
  const Eigen::Vector3d best = Triangulate(views, measured).value();
  for (int axis = 0; axis < 3; ++axis)
    for (const double step_mm : {-1e-5, 1e-5})  // 0.002 px: above the rounding of the cost
      EXPECT_GT(cost_px2(best + step_mm * Eigen::Vector3d::Unit(axis)), cost_px2(best));
}

// What a fit with a free core leaves: one view has run away, the other has not.
TEST(PinholeView, ViewsFromVeryDifferentDistancesGiveAPoint) {
  constexpr double kFarther = 1e5;
  auto views = Pair(false);
  views[1].origin_in_camera_mm.z() *= kFarther;
  views[1].scale_px_per_mm *= kFarther;
  views[1].distortion = {};
  const auto point = Triangulate(
      views, {{0, views[0].Project(kPoint).value()}, {1, views[1].Project(kPoint).value()}});
  ASSERT_TRUE(point.has_value());
  // Rounding of 2e7 mm is 4e-9 mm.
  EXPECT_LT((*point - kPoint).norm(), 1e-7);
}

TEST(PinholeView, ParallelRaysGiveNoPoint) {
  const PinholeView view = ViewAlong({0, 0, -1}, false);
  EXPECT_FALSE(Triangulate({view, view}, {{0, *view.Project(kPoint)}, {1, *view.Project(kPoint)}})
                   .has_value());
}

}  // namespace
}  // namespace telestrain
