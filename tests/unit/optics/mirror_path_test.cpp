#include "optics/mirror_path.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "unit/optics/paper_rig.h"

namespace telestrain {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

PhysicalCamera Camera() {
  return {{1, -2, 90}, -Vector3d::UnitZ(), Vector3d::UnitY(), Vector3d::UnitX()};
}

Vector3d RandomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal(0, 1);
  const double x = normal(random), y = normal(random), z = normal(random);
  return Vector3d(x, y, z).normalized();
}

// Mirrors that stand in the way of the camera's axis one after another; light falls on each under
// 75 degrees at most, so that rays beside the axis meet them too.
std::vector<Mirror> RandomChain(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> distance(25, 60);
  std::vector<Mirror> chain;
  Vector3d at_mm = Camera().position_mm, direction = Camera().axis;
  while (static_cast<int>(chain.size()) < count) {
    const Vector3d normal = RandomDirection(random);
    if (std::abs(normal.dot(direction)) < std::cos(75 * std::numbers::pi / 180)) continue;
    at_mm += distance(random) * direction;
    chain.push_back({at_mm, normal});
    direction = chain.back().ReflectDirection(direction);
  }
  return chain;
}

class RandomChains : public testing::TestWithParam<int> {};

TEST_P(RandomChains, TracedRaysAreTheRaysOfTheVirtualCamera) {
  std::mt19937 random(static_cast<unsigned>(40 + GetParam()));
  std::uniform_real_distribution<double> beside(-4, 4);
  for (int round = 0; round < 100; ++round) {
    const auto chain = RandomChain(random, GetParam());
    const PhysicalCamera behind = ReflectCamera(Camera(), chain);
    const double u_mm = beside(random), v_mm = beside(random);
    constexpr double kPath_mm = 450;  // behind five mirrors 60 mm apart at most
    const auto ray = TraceRay(Camera(), chain, {u_mm, v_mm}, kPath_mm);
    ASSERT_TRUE(ray.ok()) << ray.error().message;
    const Vector3d start_mm = behind.position_mm + u_mm * behind.image_x + v_mm * behind.image_y;
    // The limit; rounding of 600 mm through five reflections is below 1e-12.
    EXPECT_LT((ray->end_mm - start_mm - kPath_mm * behind.axis).norm(), 1e-9);
    EXPECT_LT((ray->direction - behind.axis).norm(), 1e-12);
    EXPECT_LT((ViewOfCamera(behind).Ideal(ray->end_mm) - Vector2d(u_mm, v_mm)).norm(), 1e-9);
  }
}

TEST_P(RandomChains, HitsLieOnTheirMirrorsAndTheWayAddsUp) {
  std::mt19937 random(static_cast<unsigned>(50 + GetParam()));
  const auto chain = RandomChain(random, GetParam());
  const auto ray = TraceRay(Camera(), chain, {0.7, -1.1}, 450);
  ASSERT_TRUE(ray.ok()) << ray.error().message;
  ASSERT_EQ(ray->hits.size(), chain.size());
  const auto corners = ray->Corners();
  double way_mm = 0;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const RayHit& hit = ray->hits[i];
    way_mm += (corners[i + 1] - corners[i]).norm();
    // Rounding of lengths up to 600 mm.
    EXPECT_NEAR(chain[i].normal.dot(hit.point_mm - chain[i].point_mm), 0, 1e-11);
    EXPECT_NEAR(hit.path_mm, way_mm, 1e-11);
    EXPECT_NEAR(std::cos(hit.incidence_rad), std::abs(chain[i].normal.dot(hit.direction_after)),
                1e-14);
  }
  way_mm += (corners.back() - corners[corners.size() - 2]).norm();
  EXPECT_NEAR(way_mm, 450, 1e-11);
}

TEST_P(RandomChains, EveryMirrorTurnsTheHandednessOver) {
  std::mt19937 random(static_cast<unsigned>(60 + GetParam()));
  const PhysicalCamera behind = ReflectCamera(Camera(), RandomChain(random, GetParam()));
  EXPECT_EQ(Handedness(behind), Handedness(Camera()) * (GetParam() % 2 == 0 ? 1 : -1));
}

INSTANTIATE_TEST_SUITE_P(Mirrors, RandomChains, testing::Range(0, 6));

TEST(TraceRay, OfThePapersArrayMeetsItsVirtualViewsEverywhere) {
  const OpticalRig rig = testing_support::PaperRig();
  for (const OpticalPath& path : rig.paths)
    for (const double u : {0.0, 0.31, 1.0})
      for (const double v : {0.0, 0.77, 1.0}) {
        const Vector2d ideal_mm =
            path.field_mm.min() + Vector2d(u, v).cwiseProduct(path.field_mm.sizes());
        const auto ray = TraceRay(rig.camera, path.mirrors, ideal_mm, FocusPath_mm(rig, path));
        ASSERT_TRUE(ray.ok()) << ray.error().message;
        const TelecentricView view = ViewOfCamera(VirtualCamera(rig, path));
        EXPECT_LT((view.Ideal(ray->end_mm) - ideal_mm).norm(), 1e-9) << path.name;
        const Vector3d on_view_mm = view.PointOnRay(ideal_mm);
        EXPECT_LT((ray->end_mm - on_view_mm).cross(ray->direction).norm(), 1e-9) << path.name;
      }
}

TEST(TraceRay, SaysWhichMirrorItRunsAwayFrom) {
  const std::vector<Mirror> mirrors = {{{0, 0, 40}, {std::sqrt(0.5), 0, std::sqrt(0.5)}},
                                       {{-20, 0, 40}, Vector3d::UnitX()}};
  const auto ray = TraceRay(Camera(), mirrors, {0, 0}, 500);
  ASSERT_FALSE(ray.ok());
  EXPECT_NE(ray.error().message.find("runs away from mirror 2"), std::string::npos)
      << ray.error().message;
  // Hit at x = 1 (the camera's), 21 mm in front of the mirror at -20.
  EXPECT_NE(ray.error().message.find("21.000 mm behind"), std::string::npos) << ray.error().message;
}

TEST(TraceRay, SaysWhichMirrorItRunsParallelTo) {
  const std::vector<Mirror> mirrors = {{{5, 0, 0}, Vector3d::UnitX()}};
  const auto ray = TraceRay(Camera(), mirrors, {0, 0}, 500);
  ASSERT_FALSE(ray.ok());
  EXPECT_NE(ray.error().message.find("parallel to mirror 1"), std::string::npos)
      << ray.error().message;
}

TEST(TraceRay, FailsWhenTheObjectWouldStandBeforeTheLastMirror) {
  const std::vector<Mirror> mirrors = {{{0, 0, 40}, Vector3d::UnitZ()}};
  const auto ray = TraceRay(Camera(), mirrors, {0, 0}, 49.5);
  ASSERT_FALSE(ray.ok());
  EXPECT_NE(ray.error().message.find("50.000 mm away"), std::string::npos) << ray.error().message;
  EXPECT_TRUE(TraceRay(Camera(), mirrors, {0, 0}, 50.5).ok());
}

}  // namespace
}  // namespace telestrain
