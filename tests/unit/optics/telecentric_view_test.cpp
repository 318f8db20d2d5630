#include "optics/telecentric_view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "geometry/rotation.h"

namespace telestrain {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TelecentricView SampleView() {
  TelecentricView view;
  view.axes_in_array = ExpRotation({0.4, -0.9, 1.3}).topRows<2>();
  view.offset_mm = {0.7, -1.9};
  return view;
}

TelecentricLens SampleLens() { return {227.27, {1295.5, 971.5}, {-1e-3, 1e-6, 2e-4, -1e-4, 0}}; }

TEST(TelecentricViewTest, APointOnTheRayHasTheImageOfTheRay) {
  const TelecentricView view = SampleView();
  for (double x = -5; x <= 5; x += 2.5) {
    const Vector2d ideal(x, 0.3 * x - 1);
    const Vector3d point = view.PointOnRay(ideal);
    EXPECT_LT((view.Ideal(point) - ideal).norm(), 1e-14);
    EXPECT_LT((view.Ideal(point + 17 * view.RayDirection()) - ideal).norm(), 1e-13);
    EXPECT_NEAR(point.dot(view.RayDirection()), 0, 1e-14) << "not the point nearest to the origin";
  }
}

TEST(TelecentricViewTest, DepthHasNoEffectOnThePixel) {
  const TelecentricView view = SampleView();
  const Vector3d point(1, -2, 0.5);
  const Vector2d pixel = Project(SampleLens(), view, point);
  for (const double depth_mm : {-100.0, -1.0, 0.1, 50.0})
    EXPECT_LT((Project(SampleLens(), view, point + depth_mm * view.RayDirection()) - pixel).norm(),
              1e-10);
}

TEST(TelecentricViewTest, MovingSceneAndViewTogetherChangesNothing) {
  const TelecentricView view = SampleView();
  const Eigen::Matrix3d turn = ExpRotation({-0.2, 0.5, 0.9});
  const Vector3d shift_mm(3, -1, 8);
  TelecentricView moved = view;
  moved.axes_in_array = view.axes_in_array * turn.transpose();
  moved.offset_mm = view.offset_mm - moved.axes_in_array * shift_mm;
  for (const Vector3d& point : {Vector3d(0, 0, 0), Vector3d(1, -2, 0.5), Vector3d(-3, 0.1, 2)})
    EXPECT_LT(
        (Project(SampleLens(), moved, turn * point + shift_mm) - Project(SampleLens(), view, point))
            .norm(),
        1e-10);
}

TEST(TelecentricViewTest, JacobianIsTheDerivative) {
  constexpr double kStep_mm = 1e-4;
  const TelecentricView view = SampleView();
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-4, 4);
  for (int round = 0; round < 50; ++round) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vector3d point(x, y, z);
    Eigen::Matrix<double, 2, 3> numeric;
    for (int i = 0; i < 3; ++i) {
      const Vector3d step = kStep_mm * Vector3d::Unit(i);
      numeric.col(i) =
          (Project(SampleLens(), view, point + step) - Project(SampleLens(), view, point - step)) /
          (2 * kStep_mm);
    }
    // Pixels up to 4000 round to 4000 x 2^-53 / step = 5e-9.
    EXPECT_LT((ProjectJacobian(SampleLens(), view, point) - numeric).norm(), 5e-8);
  }
}

// A view of either sense, focused 3 mm off the array's origin, through a lens with every term.
struct LeaningCase {
  TelecentricLens lens = SampleLens();
  TelecentricView view = SampleView();
};

std::vector<LeaningCase> LeaningCases() {
  std::vector<LeaningCase> cases;
  for (const double kappa_per_mm : {0.0, 2e-4, -5e-3})
    for (const double sense : {1.0, -1.0}) {
      LeaningCase leaning;
      leaning.lens.aspect = 1.01;
      leaning.lens.telecentricity_per_mm = kappa_per_mm;
      leaning.view.depth_sense = sense;
      leaning.view.depth_offset_mm = 3;
      cases.push_back(leaning);
    }
  return cases;
}

TEST(TelecentricViewTest, EveryPointOfAPixelsRayIsSeenInThePixel) {
  for (const auto& [lens, view] : LeaningCases())
    for (double u = 0; u < 2592; u += 431)
      for (double v = 0; v < 1944; v += 277) {
        const ImageRay ray = RayOfPixel(lens, view, {u, v});
        for (const double depth_mm : {-20.0, -1.0, 0.0, 0.4, 7.0}) {
          EXPECT_NEAR(view.Depth_mm(ray.At(depth_mm)), depth_mm, 1e-13);  // rounding of 20 mm
          // Undistort's 1e-13 mm and rounding, 8 ulp of 10 mm, times 230 px/mm.
          EXPECT_LT((Project(lens, view, ray.At(depth_mm)) - Vector2d(u, v)).norm(), 5e-11);
        }
      }
}

TEST(TelecentricViewTest, RaysOfATelecentricLensAreParallelAndOthersMeetOnTheAxis) {
  for (const auto& [lens, view] : LeaningCases()) {
    const double kappa = lens.telecentricity_per_mm;
    for (const Vector2d& pixel : {Vector2d(100, 100), Vector2d(2000, 1500)}) {
      const ImageRay ray = RayOfPixel(lens, view, pixel);
      if (kappa == 0)
        EXPECT_EQ(ray.direction_in_array, view.ViewingDirection());
      else  // where the object's side shrinks to nothing: 1 / kappa before the plane of unit scale
        EXPECT_LT(view.Ideal(ray.At(-1 / kappa)).norm(), 1e-11);  // rounding of 5000 mm
    }
  }
}

TEST(TelecentricViewTest, JacobianIsTheDerivativeForEveryLens) {
  constexpr double kStep_mm = 1e-4;
  for (const auto& [lens, view] : LeaningCases())
    for (double x = -3; x <= 3; x += 1.5)
      for (double z = -4; z <= 4; z += 2) {
        const Vector3d point(x, 1 - 0.5 * x, z);
        Eigen::Matrix<double, 2, 3> numeric;
        for (int i = 0; i < 3; ++i) {
          const Vector3d step = kStep_mm * Vector3d::Unit(i);
          numeric.col(i) = (Project(lens, view, point + step) - Project(lens, view, point - step)) /
                           (2 * kStep_mm);
        }
        // As above; the sense and the leaning change 1 px per mm and more.
        EXPECT_LT((ProjectJacobian(lens, view, point) - numeric).norm(), 5e-8);
      }
}

TEST(TelecentricViewTest, RotationIsProper) {
  const Eigen::Matrix3d rotation = SampleView().Rotation();
  EXPECT_NEAR(rotation.determinant(), 1, 1e-14);
  EXPECT_EQ(rotation.topRows<2>(), SampleView().axes_in_array);
}

TEST(TelecentricViewTest, AxisPointOfACameraIsInTheMiddleOfTheImage) {
  PhysicalCamera camera;
  camera.position_mm = {3, -4, 100};
  camera.axis = -Vector3d::UnitZ();
  camera.image_x = Vector3d::UnitY();
  camera.image_y = Vector3d::UnitX();
  const TelecentricView view = ViewOfCamera(camera);
  EXPECT_LT(view.Ideal({3, -4, -7}).norm(), 1e-14);
  EXPECT_LT((view.Ideal({3, -3, 0}) - Vector2d(1, 0)).norm(), 1e-14);
  EXPECT_LT((view.Ideal({4, -4, 0}) - Vector2d(0, 1)).norm(), 1e-14);
}

}  // namespace
}  // namespace telestrain
