#include "viz/desk/pick.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "export/small_scene.h"

namespace telestrain::viz {
namespace {

using testing::SmallScene;

DeskModel Model() {
  const Scene scene = SmallScene();
  return {"small", scene, *ChooseValues(scene, "largest", "")};
}

// Straight down at x, y.
SightLine Down(double x_mm, double y_mm) { return {{x_mm, y_mm, 100}, -Eigen::Vector3d::UnitZ()}; }

std::string NameAt(const DeskModel& model, const SightLine& sight, double reach_mm = 0.01) {
  const auto pick = PickAt(model, sight, reach_mm);
  return pick ? model.parts()[pick->part].name : "";
}

std::string FactAt(const DeskModel& model, const Pick& pick, const std::string& name) {
  for (const Fact& fact : FactsOf(model, pick))
    if (fact.name == name) return fact.value;
  return "";
}

TEST(PickAt, LooksThroughTranslucentBoxesAtTheSurfaceAndTellsItsNumbers) {
  const DeskModel model = Model();
  // Beside the view's direction arrow, near the measured point of row 1 and column 3.
  const SightLine sight = Down(-10.45, -0.27);
  EXPECT_EQ(NameAt(model, sight), "state 1 (cycle 1, step 1): surface A");
  const auto pick = PickAt(model, sight, 0.01);
  ASSERT_TRUE(pick && pick->measured_point);
  const Surface& surface = model.scene().pipe->states[1].surface;
  const std::size_t index = 1 * testing::kColumns + 3;
  EXPECT_EQ(pick->point_in_array_mm, surface.points_in_array_mm[index]);
  EXPECT_EQ(FactAt(model, *pick, "axial strain"), "683.0 \u00b5\u03b5");
  EXPECT_EQ(FactAt(model, *pick, "hoop strain"), "\u2212204.9 \u00b5\u03b5");
  EXPECT_EQ(FactAt(model, *pick, "standard uncertainty along the pipe"), "0.1100 \u00b5m");
  EXPECT_EQ(FactAt(model, *pick, "displacement"), "\u22127.17, 0.00, 0.10 \u00b5m");
  EXPECT_TRUE(FactAt(model, *pick, "position").ends_with(" mm"));
}

TEST(PickAt, TellsThatAPointHasNoValue) {
  const DeskModel model = Model();
  const auto pick = PickAt(model, Down(-11.99, -0.99), 0.001);
  ASSERT_TRUE(pick && pick->measured_point);
  EXPECT_EQ(FactAt(model, *pick, "hoop strain"), "none");
}

TEST(PickAt, TakesTheBoxWhereNothingElseIs) {
  DeskModel model = Model();
  model.ShowOnly({Layer::kViews});
  EXPECT_EQ(NameAt(model, Down(-9, 1.5)), "view A1: depth of field");
  EXPECT_EQ(NameAt(model, Down(0, 0)), "");
}

TEST(PickAt, MeetsLinesWithinReach) {
  DeskModel model = Model();
  model.ShowOnly({Layer::kSurface});
  const double edge_x_mm = model.scene().pipe->states[1].surface.points_in_array_mm[0].x();
  EXPECT_EQ(NameAt(model, Down(edge_x_mm - 0.05, 0), 0.1),
            "state 1 (cycle 1, step 1): edge of region A");
  EXPECT_EQ(NameAt(model, Down(edge_x_mm - 0.05, 0), 0.01), "");
}

TEST(PickAt, SeesOnlyWhatIsVisible) {
  DeskModel model = Model();
  model.ShowOnly({Layer::kPipe});
  EXPECT_EQ(NameAt(model, Down(-10.45, -0.27)), "nominal pipe");
  model.ShowOnly({Layer::kSurface});
  model.ShowState(2);
  EXPECT_EQ(NameAt(model, Down(-10.45, -0.27)), "state 2 (cycle 1, step 2): surface A");
  model.ShowOnly({});
  EXPECT_EQ(NameAt(model, Down(-10.45, -0.27)), "");
}

TEST(DeskCamera, PixelAndLineOfSightBelongTogether) {
  DeskCamera desk;
  desk.camera.focal_in_array_mm = {3, -2, 1};
  desk.camera.towards_viewer = Eigen::Vector3d(1, 2, 3).normalized();
  desk.camera.up = Eigen::Vector3d(3, 0, -1).normalized();
  desk.camera.half_height_mm = 12;
  desk.box = {0, 0, 800, 600};
  EXPECT_DOUBLE_EQ(desk.PixelsPerMm(), 25);
  const Eigen::Vector3d point(-4, 5, 2);
  const SightLine sight = desk.SightLineAt(desk.PixelOf(point));
  const Eigen::Vector3d off = point - sight.point_in_array_mm;
  // Rounding of coordinates below 10 mm.
  EXPECT_LT((off - off.dot(sight.away) * sight.away).norm(), 1e-13);
}

}  // namespace
}  // namespace telestrain::viz
