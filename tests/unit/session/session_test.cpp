#include "session/session.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <stdexcept>

#include "tests/unit/session/sample_folder.h"

namespace telestrain {
namespace {

Session ReadOrFail(const std::filesystem::path& folder) {
  const auto session = ReadSession(folder);
  if (!session) throw std::runtime_error(session.error().message);
  return *session;
}

TEST(ReadSessionTest, ReadsEveryKeyOfTheFormat) {
  const SampleFolder sample("every_key");
  const Session session = ReadOrFail(sample.path());
  EXPECT_EQ(session.folder, sample.path());
  EXPECT_EQ(session.title, "Sample");
  EXPECT_EQ(session.sensor.width_px, 2592);
  EXPECT_EQ(session.lens_magnification, 0.5);
  EXPECT_EQ(session.depth_of_field_mm, 3.1);
  ASSERT_EQ(session.views.size(), 2u);
  EXPECT_EQ(session.views[1].name, "B1");
  EXPECT_EQ(session.views[1].region.x, 1296);
  EXPECT_EQ(session.views[1].center_in_array_mm, Eigen::Vector3d(13.85, 0, 0));
  EXPECT_EQ(session.stage_axis_in_array, Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(session.stage_sigma_mm, 0.004);
  EXPECT_EQ(session.target.CornerCount(), 117);
  EXPECT_EQ(session.target.coplanarity_um, 1);
  EXPECT_EQ(session.target.flatness_um, 0.4);
  EXPECT_EQ(session.target.boards[1].rotation_rad, 0.7 * std::numbers::pi / 180);
  EXPECT_EQ(session.ruler.length_mm, 27.6);
  EXPECT_EQ(session.pipe.material, "copper");
  EXPECT_EQ(session.acceptance.ruler_mpe_um, 10);
  EXPECT_EQ(session.acceptance.coverage_factor, 2.5);
  EXPECT_EQ(session.acceptance.decision_rule, DecisionRule::kSimple);
}

TEST(ReadSessionTest, ReadsTheTablesWithMissingGaugeCells) {
  const SampleFolder sample("tables");
  const Session session = ReadOrFail(sample.path());
  ASSERT_EQ(session.calibration_images.size(), 2u);
  EXPECT_EQ(session.calibration_images[1].pose, "p0");
  EXPECT_EQ(session.calibration_images[1].stage_mm, 0.25);
  EXPECT_EQ(session.ruler_images, std::vector<std::string>{"images/r0.png"});
  const std::vector<std::string> gauges{"gauge_1_microstrain", "gauge_back_microstrain"};
  EXPECT_EQ(session.gauge_columns, gauges);
  ASSERT_EQ(session.pipe_states.size(), 2u);
  EXPECT_EQ(session.pipe_states[1].time_s, 12.5);
  EXPECT_EQ(session.pipe_states[1].gauges_microstrain[0], std::nullopt);
  EXPECT_EQ(session.pipe_states[1].gauges_microstrain[1], 101.25);
}

TEST(ReadSessionTest, DocumentValuesBecomeText) {
  const SampleFolder sample("document");
  const Session session = ReadOrFail(sample.path());
  const std::map<std::string, std::string> wanted{{"report_number", "R-17"},
                                                  {"revision", "3"},
                                                  {"checked", "true"},
                                                  {"temperature_degC", "20.5"},
                                                  {"date", "2024-05-17"}};
  EXPECT_EQ(session.document, wanted);
}

TEST(ReadSessionTest, OptionalPartsMayBeAbsent) {
  const SampleFolder sample("optional");
  const std::string text = sample.Read("session.toml");
  const auto stage = text.find("[stage]"), target = text.find("[target]");
  const auto ruler = text.find("[ruler]");
  sample.Write("session.toml", text.substr(0, stage) + text.substr(target, ruler - target));
  sample.Remove("ruler.csv");
  sample.Write("pipe.csv", "image,cycle,step\n");
  const Session session = ReadOrFail(sample.path());
  EXPECT_EQ(session.stage_axis_in_array, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(session.stage_sigma_mm, 0.005);
  EXPECT_TRUE(session.ruler_images.empty());
  EXPECT_TRUE(session.pipe_states.empty());
  EXPECT_FALSE(session.acceptance.ruler_mpe_um.has_value());
  EXPECT_EQ(session.acceptance.coverage_factor, 2.0);
  EXPECT_EQ(session.acceptance.decision_rule, DecisionRule::kGuarded);
  EXPECT_TRUE(session.document.empty());
}

TEST(ReadSessionTest, RoundedDirectionsAreNormalised) {
  const SampleFolder sample("rounded");
  const NominalView view = ReadOrFail(sample.path()).views[0];
  // Tolerance: the rounding of a sum of squares, a root and a division, a few units of 2^-53.
  EXPECT_NEAR(view.image_y_in_array.norm(), 1, 1e-15);
  EXPECT_NEAR(view.axis_in_array.y() / view.axis_in_array.z(), 0.5 / 0.866, 1e-15);
}

TEST(ReadSessionTest, MirroredAndUnmirroredViewsAreTaken) {
  const SampleFolder sample("handedness");
  sample.Replace("session.toml", "axis_in_array    = [0.0, 0.5, 0.866]",
                 "axis_in_array = [0.0, -0.5, -0.866]");
  EXPECT_TRUE(ReadSession(sample.path()).ok());
}

TEST(ReadSessionTest, ViewsOfAGroupMayEncloseSixDegrees) {
  const SampleFolder sample("six_degrees");
  sample.Replace("session.toml", "group = \"B\"\nregion", "group = \"A\"\nregion");
  sample.Replace("session.toml", "[0.0, 0.866, 0.5]", "[0.0, 0.8090, -0.5878]");
  sample.Replace("session.toml", "[0.0, -0.5, 0.866]", "[0.0, 0.5878, 0.8090]");
  EXPECT_EQ(ReadOrFail(sample.path()).views.at(1).group, "A");
}

TEST(ReadSessionTest, ViewsOfDifferentGroupsMayBeParallel) {
  const SampleFolder sample("parallel_groups");
  sample.Replace("session.toml", "[0.0, 0.866, 0.5]", "[0.0, 0.866, -0.5]");
  sample.Replace("session.toml", "[0.0, -0.5, 0.866]", "[0.0, 0.5, 0.866] ");
  const Session session = ReadOrFail(sample.path());
  EXPECT_EQ(session.views.at(0).axis_in_array, session.views.at(1).axis_in_array);
}

TEST(ReadSessionTest, TheStageMayBeObliqueAndIsNormalised) {
  const SampleFolder sample("oblique_stage");
  sample.Replace("session.toml", "[0.0, 0.0, -1.0]", "[0.0, 0.866, -0.52]");
  const Eigen::Vector3d axis = ReadOrFail(sample.path()).stage_axis_in_array;
  EXPECT_NEAR(axis.norm(), 1, 1e-15);
  EXPECT_NEAR(axis.z() / axis.y(), -0.52 / 0.866, 1e-15);
}

TEST(ReadSessionTest, FilesOfOtherSystemsAreRead) {
  const SampleFolder sample("crlf");
  for (const char* file : {"session.toml", "calibration.csv", "pipe.csv"}) {
    std::string text = "\xEF\xBB\xBF";
    for (const char c : sample.Read(file)) {
      if (c == '\n') text += '\r';
      text += c;
    }
    sample.Write(file, text);
  }
  const Session session = ReadOrFail(sample.path());
  EXPECT_EQ(session.calibration_images.at(1).stage_mm, 0.25);
  EXPECT_EQ(session.pipe_states.at(1).gauges_microstrain.at(1), 101.25);
}

TEST(ReadSessionTest, ColumnsMayComeInAnyOrder) {
  const SampleFolder sample("order");
  sample.Write("calibration.csv", "# stage first\nstage_mm,image,pose\n1e-1,images/c0.png,7\n");
  const Session session = ReadOrFail(sample.path());
  EXPECT_EQ(session.calibration_images.at(0).stage_mm, 0.1);
  EXPECT_EQ(session.calibration_images.at(0).image, "images/c0.png");
}

TEST(SessionTest, CornersRunAlongXFromTheSmallestCorner) {
  TargetSpec target;
  target.columns = 4;
  target.rows = 3;
  target.square_mm = 0.5;
  const SubBoard board{"A", {10, 20, 0.1}, 0};
  const Eigen::Matrix3Xd corners = target.CornersInTarget(board);
  ASSERT_EQ(corners.cols(), 12);
  EXPECT_TRUE(corners.col(0).isApprox(Eigen::Vector3d(9.25, 19.5, 0.1)));
  EXPECT_TRUE(corners.col(1).isApprox(Eigen::Vector3d(9.75, 19.5, 0.1)));
  EXPECT_TRUE(corners.col(4).isApprox(Eigen::Vector3d(9.25, 20.0, 0.1)));
  EXPECT_TRUE(corners.rowwise().mean().isApprox(board.center_in_target_mm));
}

TEST(SessionTest, BoardTurnsAboutItsOwnCentre) {
  TargetSpec target;
  target.columns = 4;
  target.rows = 3;
  target.square_mm = 0.5;
  const Eigen::Matrix3Xd turned = target.CornersInTarget({"A", {10, 20, 0}, std::numbers::pi / 2});
  // The x direction of the board has become +y of the target; 20 mm round to 4e-15.
  EXPECT_LT((turned.col(1) - turned.col(0) - Eigen::Vector3d(0, 0.5, 0)).norm(), 1e-14);
  EXPECT_TRUE(turned.rowwise().mean().isApprox(Eigen::Vector3d(10, 20, 0)));
}

TEST(SessionTest, NominalViewProjectsItsCentreToTheMiddleOfTheRegion) {
  const SampleFolder sample("nominal");
  const Session session = ReadOrFail(sample.path());
  const TelecentricLens lens = session.NominalLens();
  EXPECT_DOUBLE_EQ(lens.magnification_px_per_mm, 500 / 2.2);
  for (const NominalView& nominal : session.views) {
    const TelecentricView view = session.NominalTelecentricView(nominal);
    EXPECT_EQ(view.name, nominal.name);
    EXPECT_EQ(view.group, nominal.group);
    const Eigen::Vector2d middle = Project(lens, view, nominal.center_in_array_mm);
    EXPECT_LT((middle - nominal.region.Middle()).norm(), 1e-9);
    // One millimetre along image_x moves u by the magnification and leaves v.
    const Eigen::Vector2d moved =
        Project(lens, view, nominal.center_in_array_mm + nominal.image_x_in_array) - middle;
    EXPECT_LT((moved - Eigen::Vector2d(lens.magnification_px_per_mm, 0)).norm(), 1e-9);
  }
}

TEST(SessionTest, GroupsComeInTheOrderOfTheViews) {
  Session session;
  for (const char* group : {"B", "A", "B", "C", "A"}) session.views.emplace_back().group = group;
  EXPECT_EQ(session.Groups(), (std::vector<std::string>{"B", "A", "C"}));
}

}  // namespace
}  // namespace telestrain
