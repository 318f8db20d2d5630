#include "viz/scene/part.h"

#include <gtest/gtest.h>

#include <set>

#include "visual/results_fixture.h"
#include "viz/scene/scene_colors.h"
#include "viz/scene/scene_parts.h"
#include "viz/scene_from_results.h"

namespace telestrain::viz {
namespace {

using visual_test::FreshFolder;
using visual_test::WriteResults;

class Parts : public testing::Test {
 protected:
  void SetUp() override {
    const auto folder = FreshFolder("Parts");
    WriteResults(folder);
    const auto read = SceneFromResults(folder);
    ASSERT_TRUE(read.ok()) << read.error().message;
    scene_ = *read;
  }

  static const Part* Find(const std::vector<Part>& parts, const std::string& name) {
    for (const Part& part : parts)
      if (part.name == name) return &part;
    return nullptr;
  }

  Scene scene_;
};

TEST_F(Parts, HaveNamesOfTheirOwnAndIndexesWithin) {
  std::set<std::string> names;
  for (const Part& part : PartsOf(scene_).parts) {
    EXPECT_TRUE(names.insert(part.name).second) << part.name;
    const auto points = static_cast<int>(part.mesh.points_in_array_mm.size());
    for (const std::vector<int>& face : part.mesh.faces)
      for (const int index : face) EXPECT_TRUE(index >= 0 && index < points) << part.name;
    for (const auto& line : part.mesh.lines)
      for (const int index : line) EXPECT_TRUE(index >= 0 && index < points) << part.name;
    for (const PointValues& values : part.values)
      EXPECT_EQ(values.values.size(), part.mesh.points_in_array_mm.size()) << part.name;
  }
}

TEST_F(Parts, OnlySurfacesAndDisplacementsBelongToAState) {
  const auto parts = PartsOf(scene_).parts;
  std::set<int> states;
  for (const Part& part : parts) {
    const bool of_state = part.layer == Layer::kSurface || part.layer == Layer::kDisplacements;
    EXPECT_EQ(part.state != kEveryState, of_state) << part.name;
    if (part.layer == Layer::kSurface) states.insert(part.state);
  }
  EXPECT_EQ(states.size(), scene_.pipe->states.size());
}

TEST_F(Parts, DepthOfFieldBoxHoldsTheBoardsThatTheViewUsed) {
  for (const ViewVolume& view : scene_.views) {
    const auto parts = ViewParts(scene_);
    const Part* box = Find(parts, "view " + view.name + ": depth of field");
    ASSERT_NE(box, nullptr);
    // The box's corners lie on the volume's edge: a hair inwards they are inside, outwards not.
    for (const Eigen::Vector3d& corner : box->mesh.points_in_array_mm) {
      const Eigen::Vector3d out = corner - view.center_in_array_mm;
      EXPECT_TRUE(view.Contains(view.center_in_array_mm + (1 - 1e-9) * out));
      EXPECT_FALSE(view.Contains(view.center_in_array_mm + (1 + 1e-9) * out));
    }
    for (const Board& board : scene_.boards) {
      if (board.group != view.group) continue;
      for (const Eigen::Vector3d& corner : board.corner_grid_in_array_mm)
        EXPECT_TRUE(view.Contains(corner)) << board.image << " in " << view.name;
    }
  }
}

TEST_F(Parts, BoardIsDrawnAsItsSquaresBetweenItsCorners) {
  const auto parts = BoardParts(scene_);
  ASSERT_EQ(parts.size(), scene_.boards.size());
  const Board& board = scene_.boards.front();
  const ColorMap colors = ResidualColors(scene_.boards);
  const Rgb wanted = colors.At(board.rms_px);
  EXPECT_EQ(BytesOf(parts.front().color), BytesOf(wanted));
  // Every inner corner is a corner of exactly two dark squares.
  for (const Eigen::Vector3d& corner : board.corners_in_array_mm) {
    int squares = 0;
    for (const std::vector<int>& face : parts.front().mesh.faces)
      for (const int index : face) {
        const auto& point = parts.front().mesh.points_in_array_mm[static_cast<std::size_t>(index)];
        squares += (point - corner).norm() < 1e-9 ? 1 : 0;
      }
    EXPECT_EQ(squares, 2);
  }
}

TEST_F(Parts, BoardThatAllViewsRejectedIsGreyAndCrossedOut) {
  scene_.boards.resize(1);
  scene_.boards[0].views.clear();
  scene_.boards[0].rejected = {"A1: too few corners"};
  const Part part = BoardParts(scene_).front();
  EXPECT_EQ(BytesOf(part.color), BytesOf(kRejectedColor));
  EXPECT_EQ(part.mesh.lines.size(), 6u);  // outline and two diagonals
  EXPECT_EQ(part.facts.back().value, "A1: too few corners");
}

TEST_F(Parts, SurfacesOfTheGroupsHoldAllPointsAndTheirValues) {
  const std::size_t state = scene_.pipe->largest_state;
  const Surface& surface = scene_.pipe->states[state].surface;
  std::size_t points = 0, faces = 0;
  double sum = 0;
  for (const Part& part : SurfaceParts(scene_, state)) {
    if (part.values.empty()) continue;  // an edge
    points += part.mesh.points_in_array_mm.size();
    faces += part.mesh.faces.size();
    for (const double value : part.values.front().values) sum += value;
  }
  EXPECT_EQ(points, surface.points_in_array_mm.size());
  EXPECT_EQ(faces, surface.quads.size());
  double wanted = 0;
  for (const double value : surface.values.front().values) wanted += value;
  EXPECT_NEAR(sum, wanted, 1e-9 * std::abs(wanted));
}

TEST_F(Parts, DisplacementArrowsAreTheStatedNumberOfTimesTheDisplacement) {
  Surface& surface = scene_.pipe->states[0].surface;
  const Eigen::Vector3d moved_mm(0.03, 0.01, 0.02);
  surface.displacement_mm.assign(surface.points_in_array_mm.size(), moved_mm);
  const auto parts = DisplacementParts(scene_, 0, 25);
  ASSERT_EQ(parts.size(), 1u);
  // The last point of an arrow's mesh is its tip; the arrow begins or ends at a measured point.
  const Eigen::Vector3d tip = parts[0].mesh.points_in_array_mm.back();
  double nearest_mm = 1e9;
  for (const Eigen::Vector3d& point : surface.points_in_array_mm)
    nearest_mm = std::min(nearest_mm, (tip - 25 * moved_mm - point).norm());
  EXPECT_LT(nearest_mm, 1e-9);
  EXPECT_NE(parts[0].facts.back().value.find("25 times"), std::string::npos);
}

TEST_F(Parts, TheDrawnFactorsAreRoundAndStated) {
  scene_.boards[0].cov_center_in_array_mm2 = Eigen::Vector3d(1e-8, 4e-8, 9e-8).asDiagonal();
  const PartList list = PartsOf(scene_);
  EXPECT_EQ(list.uncertainty_factor, RoundDown(list.uncertainty_factor));
  const Part* part = Find(list.parts, "uncertainty of board " + scene_.boards[0].group + " of " +
                                          scene_.boards[0].image);
  ASSERT_NE(part, nullptr);
  EXPECT_EQ(part->facts[4].value, "0.300 \u00b5m");  // z: sqrt(9e-8) mm
}

TEST_F(Parts, GaugePlatesLieOnThePipe) {
  Gauge gauge;
  gauge.name = "gauge 7";
  gauge.outward_in_array = Eigen::Vector3d(0, 0.6, 0.8);
  gauge.length_mm = 3;
  gauge.center_in_array_mm =
      scene_.pipe->axis_point_in_array_mm + scene_.pipe->radius_mm * gauge.outward_in_array;
  scene_.pipe->gauges = {gauge};
  const auto parts = GaugeParts(scene_);
  ASSERT_EQ(parts.size(), 1u);
  for (const Eigen::Vector3d& corner : parts[0].mesh.points_in_array_mm) {
    const Eigen::Vector3d from_axis = corner - scene_.pipe->axis_point_in_array_mm;
    const double away_mm =
        (from_axis - from_axis.dot(scene_.pipe->axis_in_array) * scene_.pipe->axis_in_array).norm();
    EXPECT_GE(away_mm, scene_.pipe->radius_mm);
    EXPECT_LE(away_mm, 1.05 * scene_.pipe->radius_mm);
  }
}

}  // namespace
}  // namespace telestrain::viz
