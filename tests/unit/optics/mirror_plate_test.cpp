#include "optics/mirror_plate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "geometry/rotation.h"

namespace telestrain {
namespace {

using Eigen::Vector3d;

// A plate of 4 x 2 mm about its origin.
MirrorPlate Plate(const Vector3d& origin_mm, const Vector3d& axis_x, const Vector3d& axis_y) {
  MirrorPlate plate;
  plate.origin_mm = origin_mm;
  plate.axis_x = axis_x;
  plate.axis_y = axis_y;
  plate.outline_mm = RectangleOutline({-2, -1}, {2, 1});
  return plate;
}

const Vector3d kX = Vector3d::UnitX(), kY = Vector3d::UnitY(), kZ = Vector3d::UnitZ();

// The gap is that of plates 1e-6 smaller: 2e-6 mm per half side.
constexpr double kShrunk_mm = 1e-5;

TEST(GapBetween, IsTheDistanceOfFacesEdgesAndCorners) {
  const MirrorPlate plate = Plate({0, 0, 0}, kX, kY);
  EXPECT_NEAR(GapBetween_mm(plate, Plate({1, 0.5, 3}, kX, kY)), 3, kShrunk_mm);
  EXPECT_NEAR(GapBetween_mm(plate, Plate({7, 0, 0}, kX, kY)), 3, kShrunk_mm);
  EXPECT_NEAR(GapBetween_mm(plate, Plate({7, 6, 0}, kX, kY)), 5, kShrunk_mm);
  EXPECT_NEAR(GapBetween_mm(plate, Plate({0, 0, 3}, kZ, kY)), 1, kShrunk_mm);
}

TEST(GapBetween, IsZeroForPlatesThatCutAndForThoseInOneAnother) {
  const MirrorPlate plate = Plate({0, 0, 0}, kX, kY);
  EXPECT_EQ(GapBetween_mm(plate, Plate({1, 0, 0.5}, kZ, kY)), 0);
  EXPECT_EQ(GapBetween_mm(plate, Plate({3, 1, 0}, kX, kY)), 0);
  EXPECT_EQ(GapBetween_mm(plate, Plate({0, 0, 0}, kY, -kX)), 0);  // a cross, no corner inside
  EXPECT_GT(GapBetween_mm(plate, Plate({4, 0, 0}, kX, kY)), 0) << "a shared edge is no cut";
}

TEST(GapBetween, DoesNotChangeWhenBothPlatesMoveOrSwap) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-3, 3);
  const auto vector = [&] {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return Vector3d(x, y, z);
  };
  int apart = 0;
  for (int round = 0; round < 100; ++round) {
    const Eigen::Matrix3d turn = ExpRotation(vector()), motion = ExpRotation(vector());
    const MirrorPlate a = Plate({0, 0, 0}, kX, kY);
    const MirrorPlate b = Plate(2 * vector(), turn * kX, turn * kY);
    MirrorPlate moved_a = Plate(Vector3d(7, 8, 9), motion * kX, motion * kY);
    MirrorPlate moved_b =
        Plate(motion * b.origin_mm + Vector3d(7, 8, 9), motion * b.axis_x, motion * b.axis_y);
    const double gap_mm = GapBetween_mm(a, b);
    EXPECT_NEAR(GapBetween_mm(b, a), gap_mm, 1e-12);
    EXPECT_NEAR(GapBetween_mm(moved_a, moved_b), gap_mm, 1e-12);
    apart += gap_mm > 0 ? 1 : 0;
  }
  EXPECT_GT(apart, 20);
  EXPECT_LT(apart, 100) << "both cases have to occur";
}

TEST(StandsBetween, CountsWaysThroughThePlateOnly) {
  const MirrorPlate plate = Plate({0, 0, 0}, kX, kY);
  EXPECT_TRUE(StandsBetween(plate, {1.9, 0.9, 5}, {1.9, 0.9, -5}));
  EXPECT_FALSE(StandsBetween(plate, {2.1, 0.9, 5}, {2.1, 0.9, -5}));
  EXPECT_FALSE(StandsBetween(plate, {0, 0, 5}, {0, 0, 1}));
  EXPECT_FALSE(StandsBetween(plate, {0, 0, 5}, {0, 0, 0})) << "ends on it";
}

TEST(PartPlates, PlatesThatCutEachOtherMeetAtTheLineOfTheirPlanes) {
  // A roof whose ridge is the y axis, both sides 1 mm too long.
  const Vector3d down_right = Vector3d(1, 0, -1).normalized();
  const Vector3d down_left = Vector3d(-1, 0, -1).normalized();
  MirrorPlate right = Plate(down_right, down_right, kY), left = Plate(down_left, down_left, -kY);
  ASSERT_EQ(GapBetween_mm(right, left), 0);
  PartPlates(right, left, right.origin_mm, left.origin_mm);
  EXPECT_GT(GapBetween_mm(right, left), 0);
  EXPECT_LT(GapBetween_mm(right, left), kShrunk_mm);
  EXPECT_NEAR(right.Size_mm().x(), 3, 1e-12);
  EXPECT_NEAR(left.Size_mm().x(), 3, 1e-12);
}

TEST(PartPlates, PlatesInOnePlaneMeetHalfWay) {
  MirrorPlate first = Plate({0, 0, 1}, kX, kY), second = Plate({3, 0, 1}, kX, kY);
  PartPlates(first, second, first.origin_mm, second.origin_mm);
  EXPECT_NEAR(first.Size_mm().x(), 3.5, 1e-12);
  EXPECT_NEAR(second.Size_mm().x(), 3.5, 1e-12);
  EXPECT_LT(GapBetween_mm(first, second), kShrunk_mm);
}

}  // namespace
}  // namespace telestrain
