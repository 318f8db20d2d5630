#include "viz/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "visual/edited_results.h"
#include "visual/results_fixture.h"
#include "viz/label_layout.h"
#include "viz/scene/color_map.h"
#include "viz/scene_from_results.h"

namespace telestrain::viz {
namespace {

using visual_test::Damage;
using visual_test::FreshFolder;
using visual_test::WriteResults;

TEST(Scene, ViewVolumeContainsTheCornersOfItsBoards) {
  const auto folder = FreshFolder("Contains");
  WriteResults(folder);
  const auto scene = SceneFromResults(folder);
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  ASSERT_EQ(scene->boards.size(), 24U);
  for (const ViewVolume& view : scene->views)
    for (const Board& board : scene->boards)
      for (const Eigen::Vector3d& corner : board.corner_grid_in_array_mm)
        EXPECT_EQ(view.Contains(corner), view.group == board.group)
            << view.name << " " << board.image << " " << corner.transpose();
}

TEST(Scene, SectionsAreTheFootprintOfTheRegionAcrossTheAxis) {
  const auto folder = FreshFolder("Sections");
  WriteResults(folder, {.ruler = false, .pipe = false});
  const auto scene = SceneFromResults(folder);
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  for (const ViewVolume& view : scene->views)
    for (const double along_mm : {-20.0, -1.55, 1.55}) {
      const auto corners = view.Section(along_mm);
      // 1296 x 972 px of 4.4 um; a telecentric view does not widen along its axis.
      EXPECT_NEAR((corners[1] - corners[0]).norm(), 5.702, 1e-3);
      EXPECT_NEAR((corners[3] - corners[0]).norm(), 4.277, 1e-3);
      for (const Eigen::Vector3d& corner : corners)
        EXPECT_NEAR((corner - view.center_in_array_mm).dot(view.axis_in_array), along_mm, 1e-12);
    }
}

TEST(Scene, UpPointsToTheCamerasWhicheverWayZDoes) {
  Scene scene;
  for (const double side : {-0.5, 0.5}) {
    ViewVolume view;
    view.axis_in_array = {0, side, std::sqrt(0.75)};  // z points away from the instrument
    scene.views.push_back(view);
  }
  EXPECT_NEAR(AxesOf(scene).up.z(), -1, 1e-12);
  EXPECT_NEAR(AxesOf(scene).across.y(), -1, 1e-12);
}

TEST(Scene, ShowsTheStateWithTheLargestStrain) {
  const auto folder = FreshFolder("LargestState");
  WriteResults(folder);
  const auto scene = SceneFromResults(folder);
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  EXPECT_EQ(scene->pipe->Largest().step, "1");
  EXPECT_EQ(scene->pipe->Largest().axial_microstrain, 812.4);
  EXPECT_EQ(scene->rulers.size(), 17U);
  EXPECT_EQ(scene->rejected_rulers, 1);
}

struct DamageCase {
  const char *file, *from, *to, *named;
};

constexpr DamageCase kDamages[] = {
    {"calibration.json", "{", "[{", "calibration.json"},
    {"calibration.json", "\"magnification_px_per_mm\": 227.2727", "\"magnification_px_per_mm\": -1",
     "lens.magnification_px_per_mm"},
    {"calibration.json", "\"axis_in_array\"", "\"axis\"", "views[0].axis_in_array: is missing"},
    {"calibration.json", "\"view\": \"A1\"", "\"view\": \"C9\"", "C9"},
    {"calibration.json", "\"stage_mm\": -0.5", "\"stage_mm\": null", "poses[0].stage_mm"},
    {"calibration.json", "\"pose\": \"p0\"", "\"pose\": 0", "poses[0].pose"},
    {"calibration.json", "\"whole_board\"", "\"whole\"", "rejected[0].whole_board: is missing"},
    {"calibration.json", "\"reason\": \"9 corners missing\"", "\"reason\": 9",
     "rejected[0].reason"},
    {"calibration.json", "\"rotation_y_rad\"", "\"origin_x_mm\"", "pose_covariance_parameters[1]"},
    {"calibration.json", "\"covariance\": [", "\"covariance\": [[0],", "poses[0].covariance"},
    {"inputs.json", "\"columns\": 13", "\"columns\": 1", "target.columns"},
    {"inputs.json", "\"width_px\"", "\"width\"", "sensor.width_px: is missing"},
    {"inputs.json", "\"ruler_mpe_um\": 3.0", "\"ruler_mpe_um\": 0", "acceptance.ruler_mpe_um"},
    {"inputs.json", "\"axial_mm\": 0.0", "\"axial_mm\": \"0\"", "pipe.gauges[0].axial_mm"},
    {"inputs.json", "\"length_mm\": 3.0", "\"length_mm\": -3", "pipe.gauges[0].length_mm"},
    {"inputs.json", "\"title\"", "\"camera\": {\"position_mm\": [0, 0]},\n\"title\"",
     "camera.position_mm"},
    {"inputs.json", "\"square_mm\": 0.3", "\"square_mm\": null", "target.square_mm"},
    {"ruler.json", "\"ends_in_array_mm\": [", "\"ends_in_array_mm\": [1,", "ends_in_array_mm[0]"},
    {"strain.json", "\"radius_mm\": 4.0", "\"radius_mm\": \"4\"", "pipe.radius_mm"},
    {"ruler.json", "\"error_um\"", "\"error\"", "images[0].error_um: is missing"},
    {"ruler.json", "\"verdict\": \"pass\"", "\"verdict\": \"good\"",
     "acceptance.images[0].verdict"},
    {"ruler.json", "\"expanded_uncertainty_um\": 1.0", "\"expanded_uncertainty_um\": null",
     "acceptance.images[0].expanded_uncertainty_um"},
    {"ruler.json", "\"image\": \"ruler/3.png\"", "\"image\": \"ruler/33.png\"",
     "acceptance.images: has nothing about ruler/33.png"},
    {"strain.json", "\"image\": \"pipe/2.png\"", "\"image\": 2", "states[2].image"},
    {"strain.json", "\"angle_0_in_array\"", "\"angle_0\"", "geometry.angle_0_in_array"},
    {"strain.json", "\"axis_in_array\": [\n      1.0,\n      0.0,\n      0.0",
     "\"axis_in_array\": [0, 0, 1", "geometry.angle_0_in_array: a direction across"},
    {"strain.json", "\"microstrain\": 801.0", "\"microstrain\": \"801\"",
     "states[1].gauge_readings[1].microstrain"},
    {"strain.json", "pipe_000.vtp", "pipe_009.vtp", "pipe_009.vtp"},
    {"pipe_001.vtp", "</VTKFile>", "", "pipe_001.vtp"},
    {"pipe_002.vtp", "Name=\"displacement_mm\"", "Name=\"moved_mm\"", "displacement_mm"},
    {"pipe_001.vtp", "Name=\"group\" NumberOfComponents=\"1\" format=\"ascii\">\n0",
     "Name=\"group\" NumberOfComponents=\"1\" format=\"ascii\">\n2", "'group'"},
    {"pipe_001.vtp", "Name=\"group\" NumberOfComponents=\"1\" format=\"ascii\">\n0",
     "Name=\"group\" NumberOfComponents=\"1\" format=\"ascii\">\n1", "points of two groups"},
    {"pipe_001.vtp", "Name=\"axial_microstrain\"", "Name=\"strain\"", "axial_microstrain"}};

TEST(Scene, NamesTheFieldThatIsWrong) {
  for (const DamageCase& damage : kDamages) {
    const auto folder = FreshFolder("Damage");
    const std::string file = damage.file;
    WriteResults(folder, {.pipe = file == "strain.json" || file.starts_with("pipe_")});
    Damage(folder / damage.file, damage.from, damage.to);
    const auto scene = SceneFromResults(folder);
    ASSERT_FALSE(scene.ok()) << damage.named;
    EXPECT_EQ(scene.error().kind, ErrorKind::kBadInput);
    EXPECT_NE(scene.error().message.find(damage.named), std::string::npos) << scene.error().message;
    EXPECT_NE(scene.error().message.find("telestrain "), std::string::npos);
  }
}

TEST(ColorScale, HasRoundEndsAndLeavesOutliersOut) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(0.1 * i);
  values.push_back(1e6);
  const ColorScale scale = ScaleFor(values, 0.01);
  EXPECT_EQ(scale.low, 0);
  EXPECT_EQ(scale.high, 100);
  EXPECT_TRUE(scale.clipped);
  EXPECT_EQ(scale.ticks.size(), 6U);
}

TEST(ColorScale, OfAConstantIsNotEmpty) {
  for (const double value : {0.0, -3.0, 812.0}) {
    const ColorScale scale = ScaleFor({value, value}, 0.01);
    EXPECT_LT(scale.low, scale.high);
    EXPECT_LE(scale.low, value);
    EXPECT_GE(scale.high, value);
  }
}

TEST(ColorMap, GrowsBrighterAllAlong) {
  const ColorMap maps[] = {ColorMap::Viridis(0, 1), ColorMap::Plasma(0, 1)};
  for (const ColorMap& map : maps) {
    double before = -1;
    for (const Rgb& color : map.table()) {
      const double luma = 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;  // BT.709
      EXPECT_GT(luma, before);
      before = luma;
    }
  }
}

TEST(PlaceLabel, FindsTheFreePlaceNearest) {
  std::vector<std::uint8_t> taken(200 * 100, 0);
  for (std::size_t y = 0; y < 100; ++y)
    for (std::size_t x = 0; x < 100; ++x) taken[y * 200 + x] = 1;
  const Occupancy occupancy(200, 100, taken);
  LabelRequest request{{90, 50}, {30, 10}, std::numbers::pi / 2, 2, 0};
  const auto box = PlaceLabel(request, {0, 0, 200, 100}, occupancy, {});
  ASSERT_TRUE(box.has_value());
  EXPECT_EQ(occupancy.Count(*box), 0);
  EXPECT_GE(box->left, 102);
  EXPECT_LT(box->left, 125);
  request.size_px = {120, 10};
  EXPECT_FALSE(PlaceLabel(request, {0, 0, 200, 100}, occupancy, {}).has_value());
}

}  // namespace
}  // namespace telestrain::viz
