#include "calibration/branch_screening.h"

#include <gtest/gtest.h>

#include "calibration/array_seed.h"
#include "geometry/rotation.h"
#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

using testing_support::MakeSyntheticArray;
using testing_support::SyntheticArray;
using testing_support::SyntheticOptions;

BranchScreening Screen(const SyntheticArray& array) {
  const auto data = CollectCalibrationData(array.session, array.boards);
  EXPECT_TRUE(data.ok());
  const auto seed = SeedArray(array.session, *data);
  EXPECT_TRUE(seed.ok()) << (seed.ok() ? "" : seed.error().message);
  return seed->screening;
}

// measurement-model section 7: 0.014 deg at 0.1 px as chosen, 5.1 deg with one view flipped, at
// tilts of +-4 deg. The tilt of a view has the noise s / (m p n sin(30 deg)): 0.01 deg.
TEST(BranchScreening, TheRotationBetweenViewsIsConstantOnlyForTheRightBranches) {
  SyntheticOptions options;
  options.poses = 18;
  const BranchScreening screening = Screen(MakeSyntheticArray(options));
  EXPECT_EQ(screening.view_pairs, 6);
  EXPECT_LT(screening.chosen_spread_deg, 0.1);  // the paper's limits, measurement-model section 7
  EXPECT_GT(screening.mixed_spread_deg, 2);
  EXPECT_TRUE(screening.IsDecisive());
}

TEST(BranchScreening, ExactCornersHaveNoSpreadAtAll) {
  SyntheticOptions options;
  options.noise_px = 0;
  const BranchScreening screening = Screen(MakeSyntheticArray(options));
  EXPECT_LT(screening.chosen_spread_deg, 1e-5);  // rounding of arccos near 1: sqrt(1e-16) rad
}

TEST(BranchScreening, PosesOfOneTiltDecideNothing) {
  SyntheticOptions options;
  options.max_tilt_deg = 0;
  options.noise_px = 0.5;
  EXPECT_FALSE(Screen(MakeSyntheticArray(options)).IsDecisive());
}

// Flipping every view is the mirror image: the spreads are those of the choice itself.
TEST(BranchScreening, TheMirrorImageCannotBeTold) {
  std::vector<BranchedBoard> boards;
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, 1, -1).asDiagonal();
  for (int image = 0; image < 5; ++image)
    for (int view = 0; view < 2; ++view) {
      const Eigen::Vector3d turn(0.5 - view, 0.05 * image, 0.02 * image * image);
      const Eigen::Matrix3d rotation = ExpRotation(turn);
      boards.push_back({image, view, {rotation, mirror * rotation * mirror}, 0});
    }
  const BranchScreening chosen = ScreenBranches(boards);
  for (BranchedBoard& board : boards) board.branch = 1;
  const BranchScreening flipped = ScreenBranches(boards);
  EXPECT_NEAR(chosen.chosen_spread_deg, flipped.chosen_spread_deg, 1e-9);
  EXPECT_NEAR(chosen.mixed_spread_deg, flipped.mixed_spread_deg, 1e-9);
}

}  // namespace
}  // namespace telestrain
