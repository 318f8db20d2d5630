#include "viz/scene/mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <numbers>

namespace telestrain::viz {
namespace {

// Volume by the divergence theorem: positive when the faces are counter-clockwise from outside.
double Volume_mm3(const Mesh& mesh) {
  double volume = 0;
  for (const std::vector<int>& face : mesh.faces)
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      const auto& at = mesh.points_in_array_mm;
      const Eigen::Vector3d& a = at[static_cast<std::size_t>(face[0])];
      const Eigen::Vector3d& b = at[static_cast<std::size_t>(face[i])];
      const Eigen::Vector3d& c = at[static_cast<std::size_t>(face[i + 1])];
      volume += a.dot(b.cross(c)) / 6;
    }
  return volume;
}

Rectangle RectangleAt(double z_mm, bool turned) {
  Rectangle corners{Eigen::Vector3d(1, 2, z_mm), Eigen::Vector3d(4, 2, z_mm),
                    Eigen::Vector3d(4, 4, z_mm), Eigen::Vector3d(1, 4, z_mm)};
  if (turned) std::swap(corners[1], corners[3]);
  return corners;
}

TEST(Mesh, BoxesFaceOutwardsHoweverTheirRectanglesTurn) {
  for (const bool turned : {false, true})
    for (const double far_mm : {-5.0, 5.0}) {
      const Mesh box = BoxBetween(RectangleAt(0, turned), RectangleAt(far_mm, turned));
      EXPECT_EQ(box.faces.size(), 6u);
      EXPECT_NEAR(Volume_mm3(box), 3 * 2 * 5, 1e-12) << turned << far_mm;
    }
}

TEST(Mesh, ArrowEndsAtItsTipAndIsClosed) {
  const Eigen::Vector3d from(1, -2, 3), to(4, 0, 3.5);
  const Mesh arrow = Arrow({from, to}, 0.2);
  EXPECT_NEAR((arrow.points_in_array_mm.back() - to).norm(), 0, 1e-12);
  // Every edge is used once in either direction: no hole.
  std::map<std::pair<int, int>, int> uses;
  for (const std::vector<int>& face : arrow.faces)
    for (std::size_t i = 0; i < face.size(); ++i) ++uses[{face[i], face[(i + 1) % face.size()]}];
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(uses.count({edge.second, edge.first}), 1u);
  }
  EXPECT_GT(Volume_mm3(arrow), 0);
  EXPECT_TRUE(Arrow({from, from}, 0.2).faces.empty());
}

TEST(Mesh, EllipsoidLiesOnItsQuadric) {
  Eigen::Matrix3d half_axes;
  half_axes << 2, 0.1, 0, 0, 1, 0.2, 0.3, 0, 0.5;
  const Eigen::Vector3d center(5, -1, 2);
  for (const double sign : {1.0, -1.0}) {
    half_axes.col(0) *= sign;
    const Mesh body = Ellipsoid(center, half_axes);
    for (const Eigen::Vector3d& point : body.points_in_array_mm)
      EXPECT_NEAR((half_axes.inverse() * (point - center)).norm(), 1, 1e-12);
    const double exact = 4.0 / 3 * std::numbers::pi * std::abs(half_axes.determinant());
    // 24 by 12 faces inscribed: less volume by about 1 - sinc(2 pi / 24) and 1 - sinc(pi / 12).
    EXPECT_GT(Volume_mm3(body), 0.96 * exact);
    EXPECT_LT(Volume_mm3(body), exact);
  }
}

TEST(Mesh, AppendKeepsBothMeshes) {
  Mesh mesh = Sheet(RectangleAt(0, false));
  mesh.Append(Lines({{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()}}));
  mesh.Append(Sheet(RectangleAt(1, false)));
  EXPECT_EQ(mesh.points_in_array_mm.size(), 10u);
  EXPECT_EQ(mesh.faces, (std::vector<std::vector<int>>{{0, 1, 2, 3}, {6, 7, 8, 9}}));
  EXPECT_EQ(mesh.lines, (std::vector<std::array<int, 2>>{{4, 5}}));
}

}  // namespace
}  // namespace telestrain::viz
