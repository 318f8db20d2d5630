// Input that cannot determine the instrument is refused with the cause in words.
#include "calibration/weak_input.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "calibration/calibrate.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::MakeSyntheticArray;
using testing_support::SyntheticArray;
using testing_support::SyntheticOptions;

void ExpectRefused(const SyntheticArray& array, const std::string& words) {
  const auto result = Calibrate(array.session, array.boards);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kEstimationFailed) << result.error().message;
  EXPECT_NE(result.error().message.find(words), std::string::npos) << result.error().message;
}

void Reject(BoardObservation& board) {
  board.corners.clear();
  board.rejected_because = "absent";
}

TEST(WeakInput, OneGroupAloneTiesNothing) {
  SyntheticArray array = MakeSyntheticArray({});
  for (BoardObservation& board : array.boards)
    if (board.view[0] == 'B') Reject(board);
  ExpectRefused(array, "board of group 'B'");
}

TEST(WeakInput, OneBoardInAViewIsTooFew) {
  SyntheticArray array = MakeSyntheticArray({});
  for (std::size_t b = 4; b < array.boards.size(); ++b)
    if (array.boards[b].view == "A2") Reject(array.boards[b]);
  ExpectRefused(array, "view 'A2' sees the target in 1 usable images");
}

TEST(WeakInput, CopiesOfOneImageCountOnce) {
  SyntheticArray array = MakeSyntheticArray({});
  for (std::size_t b = 4; b < array.boards.size(); ++b)
    array.boards[b].corners = array.boards[b % 4].corners;
  ExpectRefused(array, "are copies of others");
}

TEST(WeakInput, OneCopyIsLeftOutAndListed) {
  SyntheticArray array = MakeSyntheticArray({});
  for (std::size_t v = 0; v < 4; ++v) array.boards[8 + v].corners = array.boards[v].corners;
  const auto result = Calibrate(array.session, array.boards);
  ASSERT_TRUE(result.ok()) << result.error().message;
  ASSERT_EQ(result->data.rejected.size(), 4u);
  EXPECT_EQ(result->data.rejected[0].reason,
            "a copy of board_0a.png: the same corners to the last digit");
  EXPECT_EQ(result->data.images.size(), 17u);
}

// The same pose with fresh noise: no copy, but nothing new either.
TEST(WeakInput, OnePoseTakenAgainAndAgainIsNamed) {
  SyntheticArray array = MakeSyntheticArray({});
  testing_support::Random random(3);
  for (std::size_t b = 0; b < array.boards.size(); ++b) {
    const auto* board = array.session.target.FindBoard(array.views[b % 4].group);
    const Eigen::Matrix3Xd corners = array.session.target.CornersInTarget(*board);
    for (Eigen::Index i = 0; i < corners.cols(); ++i)
      array.boards[b].corners[static_cast<std::size_t>(i)] = Observe(
          array, b % 4,
          array.poses[0].array_from_target * corners.col(i) + array.poses[0].origin_in_array_mm,
          0.1, random);
  }
  for (auto& image : array.session.calibration_images) image.stage_mm = 0;
  ExpectRefused(array, "1 different pose");
}

// Views that look along the target's normal, which is never tilted.
TEST(WeakInput, TargetsThatFaceTheViewsAreNamed) {
  const SyntheticArray array = MakeSyntheticArray({});
  CalibrationData data;
  data.boards.resize(1);
  std::vector<TargetPose> poses(3);
  for (std::size_t k = 0; k < poses.size(); ++k)
    poses[k].origin_in_array_mm.x() = static_cast<double>(k);
  Session session = array.session;
  session.views.resize(1);
  session.views[0].axis_in_array = {0, 0, -1};
  const std::string text = ExplainWeakInput(session, data, poses, "?");
  EXPECT_NE(text.find("faces view A1 squarely in every image"), std::string::npos) << text;
  poses[1].array_from_target = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()).matrix();
  data.boards.push_back(data.boards.front());
  data.boards.back().image = 1;
  const std::string plain = ExplainWeakInput(session, data, poses, "k3 is open");
  EXPECT_NE(plain.find("k3 is open"), std::string::npos) << plain;
}

TEST(WeakInput, SixPosesAreEnough) {
  SyntheticOptions options;
  options.poses = 6;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    options.seed = seed;
    const SyntheticArray array = MakeSyntheticArray(options);
    const auto result = Calibrate(array.session, array.boards);
    ASSERT_TRUE(result.ok()) << result.error().message;
    EXPECT_NEAR(result->bundle.state.array.Magnification_px_per_mm(),
                array.lens.magnification_px_per_mm,
                4 * std::sqrt(result->bundle.state.array.covariance(0, 0)));  // 4 sigma
  }
}

}  // namespace
}  // namespace telestrain
