#include <gtest/gtest.h>

#include <cmath>

#include "geometry/rotation.h"
#include "session/session_record.h"
#include "session/session_rig.h"
#include "simulation/nominal_session.h"
#include "visual/edited_results.h"
#include "visual/results_fixture.h"
#include "viz/scene_from_results.h"

namespace telestrain::viz {
namespace {

using visual_test::EditJson;
using visual_test::FreshFolder;
using visual_test::JsonOf;
using visual_test::WriteResults;
using Json = nlohmann::ordered_json;

constexpr double kRounding_mm = 1e-12;  // a few roundings of some 15 mm

Scene Read(const std::filesystem::path& folder) {
  auto scene = SceneFromResults(folder);
  if (!scene) throw std::runtime_error(scene.error().message);
  return std::move(scene).value();
}

Scene FixtureScene(const std::string& name) {
  const auto folder = FreshFolder(name);
  WriteResults(folder, {.ruler = true, .pipe = false});
  return Read(folder);
}

const Board& BoardOf(const Scene& scene, const std::string& image, const std::string& group) {
  for (const Board& board : scene.boards)
    if (board.image == image && board.group == group) return board;
  throw std::runtime_error("no board " + group + " of " + image);
}

TEST(TargetScene, OutermostCornersAreTheCornerGrid) {
  const Scene scene = FixtureScene("Corners");
  for (const Board& board : scene.boards) {
    const auto& corners = board.corners_in_array_mm;
    ASSERT_EQ(corners.size(), 13u * 9u);
    const std::size_t outermost[] = {0, 12, 8 * 13 + 12, 8 * 13};
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT((corners[outermost[i]] - board.corner_grid_in_array_mm[i]).norm(), kRounding_mm);
    // Row by row: one square to the next corner, and to the one of the next row.
    EXPECT_EQ(board.square_mm, 0.3);
    EXPECT_NEAR((corners[1] - corners[0]).norm(), 0.3, kRounding_mm);
    EXPECT_NEAR((corners[13] - corners[0]).norm(), 0.3, kRounding_mm);
    EXPECT_NEAR((corners[1] - corners[0]).dot(corners[13] - corners[0]), 0, kRounding_mm);
  }
}

TEST(TargetScene, BoardsOfOneImageKeepTheirPoseStageAndSeparation) {
  const Scene scene = FixtureScene("Pose");
  const Board& a = BoardOf(scene, "calibration/5.png", "A");
  const Board& b = BoardOf(scene, "calibration/5.png", "B");
  for (const Board* board : {&a, &b}) {
    EXPECT_EQ(board->pose, "p2");
    EXPECT_EQ(board->stage_mm, 0.5);
  }
  EXPECT_NEAR((b.corners_in_array_mm[0] - a.corners_in_array_mm[0]).norm(), 2 * 13.851,
              kRounding_mm);
}

TEST(TargetScene, RmsOfABoardIsThatOfItsViews) {
  const Scene scene = FixtureScene("Rms");
  const Board& board = BoardOf(scene, "calibration/5.png", "B");
  ASSERT_EQ(board.views.size(), 2u);
  EXPECT_EQ(board.views[0].view, "B1");
  EXPECT_EQ(board.views[1].view, "B2");
  EXPECT_EQ(board.views[0].corners, 117);
  EXPECT_TRUE(board.rejected.empty());
  EXPECT_NEAR(std::pow(board.rms_px, 2),
              0.5 * (std::pow(board.views[0].rms_px, 2) + std::pow(board.views[1].rms_px, 2)),
              1e-15);
}

// The board's middle for a pose that differs by `change`: a rotation about the array's axes in
// front of the pose's own, and a shift (bundle_adjustment.h).
Eigen::Vector3d MiddleFor(const Json& pose, const Eigen::Vector3d& middle_in_target_mm,
                          const Eigen::Matrix<double, 6, 1>& change) {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d origin_mm;
  for (int i = 0; i < 9; ++i)
    rotation(i / 3, i % 3) = pose.at("rotation_array_from_target").at(i).get<double>();
  for (int i = 0; i < 3; ++i) origin_mm[i] = pose.at("origin_in_array_mm").at(i).get<double>();
  return ExpRotation(change.head<3>()) * rotation * middle_in_target_mm + origin_mm +
         change.tail<3>();
}

TEST(TargetScene, CovarianceOfTheMiddleIsThatOfFiniteDifferences) {
  const auto folder = FreshFolder("Covariance");
  WriteResults(folder, {.ruler = false, .pipe = false});
  const Scene scene = Read(folder);
  const Json calibration = JsonOf(folder / "calibration.json");
  ASSERT_EQ(calibration.at("poses").size(), 12u);
  for (const Json& pose : calibration.at("poses"))
    for (const auto& [group, sign] : {std::pair{"A", -1.0}, std::pair{"B", 1.0}}) {
      const Eigen::Vector3d middle_mm(sign * 13.851, 0, 0);
      Eigen::Matrix<double, 3, 6> by_pose;
      Eigen::Matrix<double, 6, 6> covariance;
      constexpr double kStep = 1e-4;
      for (int i = 0; i < 6; ++i) {
        Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
        step[i] = kStep;
        by_pose.col(i) =
            (MiddleFor(pose, middle_mm, step) - MiddleFor(pose, middle_mm, -step)) / (2 * kStep);
        for (int k = 0; k < 6; ++k)
          covariance(i, k) = pose.at("covariance").at(i).at(k).get<double>();
      }
      const Eigen::Matrix3d expected = by_pose * covariance * by_pose.transpose();
      const Board& board = BoardOf(scene, pose.at("image").get<std::string>(), group);
      // A central difference of a rotation by h is right to h^2 / 6.
      EXPECT_LT((board.cov_center_in_array_mm2 - expected).norm(), kStep * kStep * expected.norm());
    }
}

TEST(TargetScene, ACalibrationWithoutCovarianceHasNone) {
  const auto folder = FreshFolder("NoCovariance");
  WriteResults(folder, {.ruler = false, .pipe = false});
  EditJson(folder / "calibration.json", [](Json& json) {
    json.erase("pose_covariance_parameters");
    for (Json& pose : json["poses"]) pose.erase("covariance");
  });
  const Scene scene = Read(folder);
  ASSERT_EQ(scene.boards.size(), 24u);
  for (const Board& board : scene.boards)
    EXPECT_EQ(board.cov_center_in_array_mm2, Eigen::Matrix3d::Zero());
}

TEST(TargetScene, RejectedViewsSayWhy) {
  const Scene scene = FixtureScene("Rejected");
  const Board& board = BoardOf(scene, "calibration/7.png", "B");
  ASSERT_EQ(board.views.size(), 1u);
  EXPECT_EQ(board.views[0].view, "B1");
  EXPECT_EQ(board.rms_px, board.views[0].rms_px);
  EXPECT_EQ(board.rejected, std::vector<std::string>{"B2: 9 corners missing"});
  // Corners that were left out as outliers reject no board.
  EXPECT_TRUE(BoardOf(scene, "calibration/8.png", "A").rejected.empty());
  EXPECT_EQ(scene.rejected_board_views, 1);
}

TEST(TargetScene, ABoardThatNoViewUsedStandsWhereItsPoseIsKnown) {
  const auto folder = FreshFolder("AllRejected");
  WriteResults(folder, {.ruler = false, .pipe = false});
  EditJson(folder / "calibration.json", [](Json& json) {
    json["poses"][7]["boards"].erase(2);  // B1
    for (const auto& [image, view] :
         {std::pair{"calibration/7.png", "B1"}, std::pair{"calibration/99.png", "A1"}})
      json["rejected"].push_back({{"image", image},
                                  {"view", view},
                                  {"reason", "blurred"},
                                  {"corners", 0},
                                  {"whole_board", true}});
  });
  const Scene scene = Read(folder);
  EXPECT_EQ(scene.boards.size(), 24u);
  EXPECT_EQ(scene.rejected_board_views, 3);
  const Board& board = BoardOf(scene, "calibration/7.png", "B");
  EXPECT_TRUE(board.views.empty());
  EXPECT_EQ(board.rms_px, 0);
  EXPECT_EQ(board.rejected, (std::vector<std::string>{"B1: blurred", "B2: 9 corners missing"}));
  EXPECT_EQ(board.corners_in_array_mm.size(), 117u);
}

TEST(TargetScene, RulersCarryTheirErrorAndWhatWasDecided) {
  const Scene scene = FixtureScene("Rulers");
  ASSERT_EQ(scene.rulers.size(), 17u);
  for (std::size_t i = 0; i < scene.rulers.size(); ++i) {
    EXPECT_EQ(scene.rulers[i].error_um, 0.25 * (static_cast<double>(i) - 8));
    EXPECT_EQ(scene.rulers[i].expanded_uncertainty_um, i == 3 ? 2.5 : 1.0);
    EXPECT_EQ(scene.rulers[i].verdict, i == 3 ? "doubt" : i == 4 ? "" : "pass");
  }
  EXPECT_EQ(scene.rejected_rulers, 1);
}

TEST(TargetScene, LimitsSensorAndRegionsAreThoseOfTheSession) {
  const auto folder = FreshFolder("Limits");
  WriteResults(folder, {.ruler = false, .pipe = false});
  EditJson(folder / "inputs.json", [](Json& json) { json["acceptance"]["coverage_factor"] = 2.5; });
  const Scene scene = Read(folder);
  EXPECT_EQ(scene.limits.ruler_mpe_um, 3.0);
  EXPECT_FALSE(scene.limits.reprojection_rms_px.has_value());
  EXPECT_FALSE(scene.limits.strain_error_microstrain.has_value());
  EXPECT_EQ(scene.coverage_factor, 2.5);
  EXPECT_EQ(scene.sensor_px, Eigen::Vector2i(2592, 1944));
  ASSERT_EQ(scene.view_regions_px.size(), 4u);
  EXPECT_EQ(scene.view_regions_px[1], Eigen::Vector4i(0, 972, 1296, 972));
  EXPECT_EQ(scene.view_regions_px[2], Eigen::Vector4i(1296, 0, 1296, 972));
}

TEST(TargetScene, OpticsAreTheRigOfTheSession) {
  VirtualExperimentOptions options;
  options.mirrors = true;
  const Session session = NominalSession(options);
  const OpticalRig rig = RigOfSession(session).value();
  const auto folder = FreshFolder("Optics");
  WriteResults(folder, {.ruler = false, .pipe = false});
  Json inputs = SessionRecord(session);
  inputs["schema"] = "telestrain.inputs/1";
  EditJson(folder / "inputs.json", [&](Json& json) { json = inputs; });
  const Scene scene = Read(folder);
  ASSERT_TRUE(scene.optics.has_value());
  EXPECT_EQ(scene.optics->camera.position_mm, rig.camera.position_mm);
  EXPECT_EQ(scene.optics->pipe_diameter_mm, rig.pipe_diameter_mm);
  EXPECT_EQ(scene.optics->needed_field_mm, rig.needed_field_mm);
  ASSERT_EQ(scene.optics->paths.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_EQ(scene.optics->paths[i].mirrors.size(), rig.paths[i].mirrors.size());
    for (std::size_t m = 0; m < rig.paths[i].mirrors.size(); ++m)
      EXPECT_EQ(scene.optics->paths[i].mirrors[m].normal, rig.paths[i].mirrors[m].normal);
    EXPECT_EQ(FocusPath_mm(*scene.optics, scene.optics->paths[i]), FocusPath_mm(rig, rig.paths[i]));
  }
}

TEST(TargetScene, ASessionWithoutMirrorsHasNoOptics) {
  EXPECT_FALSE(FixtureScene("NoOptics").optics.has_value());
}

}  // namespace
}  // namespace telestrain::viz
