#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "optics/telecentric_view.h"

namespace telestrain {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

PhysicalCamera Camera() {
  PhysicalCamera camera;
  camera.position_mm = {0, 0, 100};
  camera.axis = -Vector3d::UnitZ();
  camera.image_x = Vector3d::UnitY();
  camera.image_y = Vector3d::UnitX();
  return camera;
}

std::vector<Mirror> RandomMirrors(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Mirror> mirrors(static_cast<std::size_t>(count));
  for (Mirror& mirror : mirrors) {
    for (int i = 0; i < 3; ++i) mirror.point_mm[i] = 30 * uniform(random);
    for (int i = 0; i < 3; ++i) mirror.normal[i] = uniform(random);
    mirror.normal.normalize();
  }
  return mirrors;
}

// Light runs backwards through the mirrors: the point as the camera sees it.
Vector3d VirtualPoint(Vector3d point_mm, const std::vector<Mirror>& mirrors) {
  for (auto mirror = mirrors.rbegin(); mirror != mirrors.rend(); ++mirror)
    point_mm = mirror->ReflectPoint(point_mm);
  return point_mm;
}

TEST(MirrorChainTest, VirtualCameraSeesThePixelsOfTheReflectedScene) {
  std::mt19937 random(8);
  const TelecentricLens lens{227.27, {1295.5, 971.5}, {-1e-3, 1e-6, 2e-4, -1e-4, 0}};
  for (int count = 0; count <= 5; ++count) {
    const auto mirrors = RandomMirrors(random, count);
    const PhysicalCamera behind = ReflectCamera(Camera(), mirrors);
    // A point within the field of the virtual camera.
    const Vector3d point =
        behind.position_mm + 110 * behind.axis + 1.3 * behind.image_x - 0.6 * behind.image_y;
    const Vector2d direct = Project(lens, ViewOfCamera(Camera()), VirtualPoint(point, mirrors));
    const Vector2d reflected = Project(lens, ViewOfCamera(behind), point);
    EXPECT_LT((direct - reflected).norm(), 1e-9) << count << " mirrors";
  }
}

TEST(MirrorChainTest, ProperRotationForAnyNumberAndReversedRaysForOddOnes) {
  std::mt19937 random(9);
  for (int count = 0; count <= 5; ++count) {
    const PhysicalCamera behind = ReflectCamera(Camera(), RandomMirrors(random, count));
    const TelecentricView view = ViewOfCamera(behind);
    EXPECT_NEAR(view.Rotation().determinant(), 1, 1e-14);
    // This camera has image_x × image_y along its axis; every mirror turns that over.
    EXPECT_NEAR(view.RayDirection().dot(behind.axis), count % 2 == 0 ? 1 : -1, 1e-14) << count;
  }
}

TEST(MirrorChainTest, TheSameMirrorTwiceIsNoMirror) {
  std::mt19937 random(10);
  auto mirrors = RandomMirrors(random, 1);
  mirrors.push_back(mirrors.front());
  const PhysicalCamera behind = ReflectCamera(Camera(), mirrors);
  EXPECT_LT((behind.position_mm - Camera().position_mm).norm(), 1e-12);
  EXPECT_LT((behind.axis - Camera().axis).norm(), 1e-14);
  EXPECT_LT((behind.image_x - Camera().image_x).norm(), 1e-14);
  EXPECT_LT((behind.image_y - Camera().image_y).norm(), 1e-14);
}

// The designed array (the numbers of its drawing): three mirrors per view, group sx, view sy.
constexpr double kField_x_mm = 5.7024, kField_y_mm = 4.2768;  // one quadrant of the sensor
constexpr double kCenter_mm = 13.851;

std::vector<Mirror> ArrayMirrors(int sx, int sy) {
  const double half = std::sqrt(0.5), lean = std::sqrt(0.75);
  const double column_mm = kField_y_mm / 2 * sx, row_mm = kField_x_mm / 2 * sy;
  const double side_mm = 40 / std::sqrt(3.0);  // where 60 degrees lead from the height to the pipe
  return {{{column_mm, row_mm, 40}, half * Vector3d(sx, 0, 1)},
          {{kCenter_mm * sx, row_mm, 40}, half * Vector3d(-sx, sy, 0)},
          {{kCenter_mm * sx, side_mm * sy, 40}, {0, -lean * sy, -0.5}}};
}

// Where the ray of these image-plane coordinates meets the plane z = 0.
Vector3d OnPipePlane(const PhysicalCamera& camera, const Vector2d& ideal_mm) {
  const Vector3d start =
      camera.position_mm + ideal_mm.x() * camera.image_x + ideal_mm.y() * camera.image_y;
  return start - start.z() / camera.axis.z() * camera.axis;
}

class DesignedArrayTest : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  int sx() const { return GetParam().first; }
  int sy() const { return GetParam().second; }
  PhysicalCamera Virtual() const { return ReflectCamera(Camera(), ArrayMirrors(sx(), sy())); }
};

TEST_P(DesignedArrayTest, LooksAtThePipeUnder30Degrees) {
  const Vector3d wanted(0, -0.5 * sy(), -std::sqrt(0.75));
  EXPECT_LT((Virtual().axis - wanted).norm(), 1e-14);
  const Vector2d middle(kField_x_mm / 2 * sy(), kField_y_mm / 2 * sx());
  // The drawing's numbers are rounded to 0.5 um.
  EXPECT_LT((OnPipePlane(Virtual(), middle) - Vector3d(kCenter_mm * sx(), 0, 0)).norm(), 1e-3);
}

TEST_P(DesignedArrayTest, FootprintIsThatOfTheDrawing) {
  double x_min = std::numeric_limits<double>::max(), x_max = 0, y_min = x_min, y_max = -x_min;
  for (const double u : {0.0, 1.0}) {
    for (const double v : {0.0, 1.0}) {
      const Vector2d corner(u * kField_x_mm * sy(), v * kField_y_mm * sx());
      const Vector3d point = OnPipePlane(Virtual(), corner);
      x_min = std::min(x_min, point.x() * sx());
      x_max = std::max(x_max, point.x() * sx());
      y_min = std::min(y_min, point.y());
      y_max = std::max(y_max, point.y());
    }
  }
  // The drawing gives three decimals.
  EXPECT_NEAR(x_min, 11.000, 1e-3);
  EXPECT_NEAR(x_max, 16.702, 1e-3);
  EXPECT_NEAR(y_min, -2.469, 1e-3);
  EXPECT_NEAR(y_max, 2.469, 1e-3);
}

TEST_P(DesignedArrayTest, ThreeReflectionsMirrorTheImage) {
  const PhysicalCamera camera = Virtual();
  EXPECT_NEAR(camera.image_x.cross(camera.image_y).dot(camera.axis), -1, 1e-14);
  EXPECT_NEAR(ViewOfCamera(camera).Rotation().determinant(), 1, 1e-14);
}

TEST_P(DesignedArrayTest, AllPathsAreEquallyLong) {
  // From the lens side of the first mirror, at the camera's position, along all mirrors.
  const auto mirrors = ArrayMirrors(sx(), sy());
  const Vector3d pipe(kCenter_mm * sx(), 0, 0);
  double path_mm = 0;
  for (std::size_t i = 1; i < mirrors.size(); ++i)
    path_mm += (mirrors[i].point_mm - mirrors[i - 1].point_mm).norm();
  path_mm += (pipe - mirrors.back().point_mm).norm();
  // 11.712 + 20.243 + 46.188: the part behind the first mirror, the same for all views.
  EXPECT_NEAR(path_mm, 78.143, 1e-2);
}

INSTANTIATE_TEST_SUITE_P(Views, DesignedArrayTest,
                         testing::Values(std::pair{1, 1}, std::pair{1, -1}, std::pair{-1, 1},
                                         std::pair{-1, -1}));

}  // namespace
}  // namespace telestrain
