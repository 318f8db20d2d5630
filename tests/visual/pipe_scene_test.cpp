#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "visual/edited_results.h"
#include "visual/results_fixture.h"
#include "viz/quantity.h"
#include "viz/scene_from_results.h"

namespace telestrain::viz {
namespace {

using visual_test::Damage;
using visual_test::EditJson;
using visual_test::FreshFolder;
using visual_test::WriteResults;
using Json = nlohmann::ordered_json;

// Of the pipe of the fixture, after `edit` changed strain.json.
Pipe PipeOf(const std::string& name, const std::function<void(Json&)>& edit = {}) {
  const auto folder = FreshFolder(name);
  WriteResults(folder, {.ruler = false});
  if (edit) EditJson(folder / "strain.json", edit);
  const auto scene = SceneFromResults(folder);
  if (!scene) throw std::runtime_error(scene.error().message);
  return *scene->pipe;
}

TEST(PipeScene, HoldsEveryStateInTheOrderOfTheTable) {
  const Pipe pipe = PipeOf("States");
  ASSERT_EQ(pipe.states.size(), 3u);
  EXPECT_EQ(pipe.largest_state, 1u);
  EXPECT_EQ(pipe.nominal_radius_mm, 4.0);
  const double loads[] = {0, 1, 0.5};
  for (std::size_t i = 0; i < 3; ++i) {
    const PipeState& state = pipe.states[i];
    EXPECT_EQ(state.image, "pipe/" + std::to_string(i) + ".png");
    EXPECT_EQ(state.step, std::to_string(i));
    EXPECT_EQ(state.axial_microstrain, 812.4 * loads[i]);
    const PointValues& axial = state.surface.values.front();
    ASSERT_EQ(axial.quantity.key, "axial_microstrain");
    for (std::size_t p = 0; p < axial.values.size(); ++p) {
      const Eigen::Vector3d& point = state.surface.points_in_array_mm[p];
      const double strain = loads[i] * visual_test::PipeStrain_microstrain(point.x(), point.y());
      // The file's numbers are the shortest that read back; VTK's points are floats.
      EXPECT_NEAR(axial.values[p], strain, 1e-2);
      EXPECT_NEAR(state.surface.displacement_mm[p].x(), 1e-6 * strain * point.x(), 1e-6);
    }
    EXPECT_EQ(state.surface.sigma_um,
              std::vector<double>(state.surface.points_in_array_mm.size(), 0.75));
  }
}

TEST(PipeScene, ALargestStrainIsTheFirstOfEquals) {
  const Pipe pipe = PipeOf("Equal", [](Json& json) {
    json["states"][0]["axial_microstrain"] = 500.0;
    json["states"][1]["axial_microstrain"] = -900.0;
    json["states"][2]["axial_microstrain"] = 900.0;
  });
  EXPECT_EQ(pipe.largest_state, 1u);
}

TEST(PipeScene, GaugesStandOnTheSurfaceAtTheirAngleAndPlace) {
  // An axis that leans, given against the array's x, by a point far along it.
  const Eigen::Vector3d along = Eigen::Vector3d(1, 0.02, -0.01).normalized();
  const Eigen::Vector3d middle_mm(0, 0.1, -3.6);
  const auto list = [](const Eigen::Vector3d& v) { return Json{v.x(), v.y(), v.z()}; };
  const Pipe pipe = PipeOf("Gauges", [&](Json& json) {
    json["pipe"]["axis_in_array"] = list(-along);
    json["pipe"]["axis_point_in_array_mm"] = list(middle_mm + 40 * along);
  });
  ASSERT_EQ(pipe.gauges.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Gauge& gauge = pipe.gauges[i];
    EXPECT_EQ(gauge.name, "gauge " + std::to_string(i + 1));
    EXPECT_EQ(gauge.length_mm, 3.0);
    // On the surface: a radius from the axis, which its direction points away from.
    const Eigen::Vector3d from_axis_mm = gauge.center_in_array_mm - middle_mm;
    const Eigen::Vector3d across_mm = from_axis_mm - along * along.dot(from_axis_mm);
    EXPECT_NEAR(across_mm.norm(), pipe.radius_mm, 1e-12);
    EXPECT_LT((gauge.outward_in_array - across_mm.normalized()).norm(), 1e-12);
    // Its place along the axis: from the axis' point nearest to the array's origin, which has the
    // coordinate 0.
    EXPECT_NEAR(along.dot(gauge.center_in_array_mm), visual_test::kGaugeAxial_mm[i], 1e-12);
    // At its angle: 0 faces the instrument (z), 90 degrees the array's y. The axis leans by 1.3
    // degrees, which the directions across it share.
    const double angle_rad = std::atan2(gauge.outward_in_array.y(), gauge.outward_in_array.z());
    EXPECT_NEAR(angle_rad, visual_test::kGaugeAngle_rad[i], 0.023);
  }
  EXPECT_NEAR(pipe.gauges[0].outward_in_array.dot(pipe.gauges[1].outward_in_array),
              std::cos(visual_test::kGaugeAngle_rad[1]), 1e-12);
}

TEST(PipeScene, GaugesReadPerState) {
  const Pipe pipe = PipeOf("Readings");
  ASSERT_EQ(pipe.states[1].gauge_microstrain.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(pipe.states[1].gauge_microstrain[i], 800.0 + static_cast<double>(i));
  EXPECT_EQ(pipe.states[0].gauge_microstrain[1], 1.0);
  EXPECT_FALSE(pipe.states[0].gauge_microstrain[2].has_value());
  EXPECT_EQ(pipe.states[1].gauge_mean_microstrain, 810.0);
}

TEST(PipeScene, ReadsAnOlderFileWithoutReadings) {
  const Pipe pipe = PipeOf("OldReadings", [](Json& json) {
    for (Json& state : json["states"]) {
      state.erase("gauge_readings");
      state["gauge_mean_microstrain"] = nullptr;
    }
  });
  for (const PipeState& state : pipe.states) {
    ASSERT_EQ(state.gauge_microstrain.size(), 3u);
    for (const auto& reading : state.gauge_microstrain) EXPECT_FALSE(reading.has_value());
    EXPECT_FALSE(state.gauge_mean_microstrain.has_value());
  }
}

TEST(PipeScene, ANumberThatIsNotFiniteIsAPointWithoutValue) {
  const auto folder = FreshFolder("NotFinite");
  WriteResults(folder, {.ruler = false});
  Damage(folder / "pipe_001.vtp", "format=\"ascii\">\n0.75\n0.75\n",
         "format=\"ascii\">\n0.75\nnan\n");
  const auto scene = SceneFromResults(folder);
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  const Surface& surface = scene->pipe->states[1].surface;
  const PointValues* sigma = surface.Find("sigma_um");
  ASSERT_NE(sigma, nullptr);
  EXPECT_EQ(sigma->values[0], 0.75);
  EXPECT_TRUE(std::isnan(sigma->values[1]));
  EXPECT_TRUE(std::isnan(surface.sigma_um[1]));
  EXPECT_EQ(surface.sigma_um[2], 0.75);
}

TEST(PipeScene, EveryScalarIsAQuantityTheAxialStrainFirst) {
  const auto folder = FreshFolder("Quantities");
  WriteResults(folder, {.ruler = false});
  // A file whose axial strain is not the first scalar, and one that no table knows.
  for (const auto& [from, to] : {std::pair{"\"hoop_microstrain\"", "\"swap\""},
                                 std::pair{"\"axial_microstrain\"", "\"wear_um\""},
                                 std::pair{"\"swap\"", "\"axial_microstrain\""}})
    Damage(folder / "pipe_000.vtp", from, to);
  const auto scene = SceneFromResults(folder);
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  const auto& values = scene->pipe->states[0].surface.values;
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values[0].quantity.key, "axial_microstrain");
  EXPECT_EQ(values[1].quantity.key, "wear_um");
  EXPECT_EQ(values[1].quantity.name, "wear_um");
  EXPECT_EQ(values[1].quantity.unit, "\u00b5m");
  EXPECT_EQ(values[2].quantity.key, "sigma_um");
}

TEST(Quantity, HasANameAndAUnit) {
  const struct {
    const char *key, *name, *unit;
  } cases[] = {{"axial_microstrain", "axial strain", "\u00b5\u03b5"},
               {"principal_angle_deg", "angle of the first principal strain", "\u00b0"},
               {"radial_deviation_um", "radial deviation from the fitted pipe", "\u00b5m"},
               {"zncc", "correlation coefficient (ZNCC)", ""},
               {"lift_mm", "lift_mm", "mm"},
               {"count", "count", ""}};
  for (const auto& wanted : cases) {
    const Quantity quantity = QuantityOf(wanted.key);
    EXPECT_EQ(quantity.key, wanted.key);
    EXPECT_EQ(quantity.name, wanted.name);
    EXPECT_EQ(quantity.unit, wanted.unit);
  }
}

}  // namespace
}  // namespace telestrain::viz
