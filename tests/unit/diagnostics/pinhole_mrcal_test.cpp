#include "diagnostics/pinhole_mrcal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/rotation.h"
#include "unit/diagnostics/pinhole_array.h"

namespace telestrain {
namespace {

using testing_support::MakeCase;
using testing_support::PinholeCase;
using testing_support::SyntheticOptions;

PinholeOptions At(double working_distance_mm) {
  PinholeOptions options;
  options.working_distance_mm = working_distance_mm;
  return options;
}

PinholeCase CaseWith(double noise_px, bool mirrored) {
  SyntheticOptions options;
  options.noise_px = noise_px;
  options.mirrored = mirrored;
  options.poses = 6;
  return MakeCase(options);
}

PinholeCalibration MustSolve(const PinholeCase& made, const PinholeOptions& options) {
  auto found = CalibratePinholeWithMrcal(made.array.session, made.data, made.telecentric, options);
  EXPECT_TRUE(found.ok()) << (found.ok() ? "" : found.error().message);
  return std::move(found).value();
}

void KeepGroupA(PinholeCase& made) {
  std::erase_if(made.data.boards, [](const BoardData& board) { return board.geometry.board != 0; });
}

double LargestDifference_px(const PinholeCalibration& a, const PinholeCalibration& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.errors_px.size(); ++i)
    largest = std::max(largest, (a.errors_px[i] - b.errors_px[i]).cwiseAbs().maxCoeff());
  return largest;
}

TEST(CalibratePinholeWithMrcal, FindsWhatOurOwnAdjustmentFindsInOneGroup) {
  for (const bool mirrored : {false, true}) {
    PinholeCase made = CaseWith(0.1, mirrored);
    KeepGroupA(made);
    for (const double distance_mm : {100.0, 1000.0, 1e5}) {
      const PinholeCalibration mrcal = MustSolve(made, At(distance_mm));
      const PinholeCalibration ours = made.MustCalibrate(At(distance_mm));
      // Ours stops when the sum of squares stays to 1e-10: errors of 1e-5 of their RMS.
      EXPECT_LT(LargestDifference_px(mrcal, ours), 1e-5 * ours.all.rms_px);
      EXPECT_NEAR(mrcal.all.rms_px, ours.all.rms_px, 1e-9);
      EXPECT_FALSE(mrcal.hit_iteration_limit);
    }
  }
}

TEST(CalibratePinholeWithMrcal, FindsTheSameCoefficients) {
  PinholeCase made = CaseWith(0.1, false);
  KeepGroupA(made);
  PinholeOptions options = At(300);
  options.free_distortion = true;
  const PinholeCalibration mrcal = MustSolve(made, options);
  const PinholeCalibration ours = made.MustCalibrate(options);
  EXPECT_LT(LargestDifference_px(mrcal, ours), 1e-4 * ours.all.rms_px);
  EXPECT_LT(ours.all.rms_px, made.MustCalibrate(At(300)).all.rms_px);
}

TEST(CalibratePinholeWithMrcal, ExactPinholeCornersGiveTheExactCamerasOfBothGroups) {
  for (const bool mirrored : {false, true}) {
    PinholeCase made = CaseWith(0, mirrored);
    const auto truth = PinholeViewsAt(made.array.session, made.data, made.telecentric, At(120));
    SeeWith(truth, made);
    DisturbStart(made);
    const PinholeCalibration found = MustSolve(made, At(120));
    EXPECT_LT(found.all.max_px, 1e-6);
    EXPECT_FALSE(found.hit_iteration_limit);
    for (std::size_t v = 0; v < truth.size(); ++v)
      // 1e-6 px on a board of 200 px radius are 5e-9 rad.
      EXPECT_LT(AngleBetween_rad(
                    found.views[v].camera_from_array * found.views[0].camera_from_array.transpose(),
                    truth[v].camera_from_array * truth[0].camera_from_array.transpose()),
                1e-8);
  }
}

TEST(CalibratePinholeWithMrcal, GroupsWithoutACommonImageCannotBeJoined) {
  PinholeCase made = CaseWith(0.1, false);
  std::erase_if(made.data.boards,
                [](const BoardData& board) { return board.geometry.board != board.image % 2; });
  const auto found =
      CalibratePinholeWithMrcal(made.array.session, made.data, made.telecentric, At(1000));
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().kind, ErrorKind::kEstimationFailed);
}

}  // namespace
}  // namespace telestrain
