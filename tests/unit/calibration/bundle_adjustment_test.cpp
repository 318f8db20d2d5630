#include "calibration/bundle_adjustment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/outlier_rejection.h"
#include "geometry/rotation.h"
#include "unit/calibration/bundle_scene.h"

namespace telestrain {
namespace {

using testing_support::MakeScene;
using testing_support::MakeSyntheticArray;
using testing_support::MustAdjust;
using testing_support::Random;
using testing_support::Scene;
using testing_support::With;

double LargestError_px(const Scene& scene, const ArrayState& state) {
  double largest = 0;
  for (const BoardData& board : scene.data.boards)
    largest = std::max(largest, ReprojectionErrors_px(state, board).cwiseAbs().maxCoeff());
  return largest;
}

void ExpectEqualLenses(const TelecentricLens& a, const TelecentricLens& b) {
  // Residuals of 1e-12 px of rounding, divided by the weakest sensitivity (k3: 1e-4 px per scaled
  // unit of 1e-6) leave far less than these.
  EXPECT_NEAR(a.magnification_px_per_mm, b.magnification_px_per_mm, 1e-6);
  EXPECT_NEAR(a.aspect, b.aspect, 1e-8);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(a.distortion[i] * std::pow(8.0, i == 4   ? 6
                                                : i == 1 ? 4
                                                : i == 0 ? 2
                                                         : 1),
                b.distortion[i] * std::pow(8.0, i == 4   ? 6
                                                : i == 1 ? 4
                                                : i == 0 ? 2
                                                         : 1),
                1e-6);
  EXPECT_NEAR(a.telecentricity_per_mm, b.telecentricity_per_mm, 1e-9);
}

TEST(AdjustBundle, ExactCornersGiveTheExactLensOfEveryModel) {
  const LensModel all{{true, true, true, true, true}, true, true, false};
  const LensModel aspect{{}, true, false, false}, telecentricity{{}, false, true, false};
  const LensModel per_view{{true, false, false, false, false}, false, false, true};
  for (const LensModel& model : {aspect, telecentricity, all, per_view}) {
    const Scene scene = MakeScene(0, 0.1, [&](Scene& s) {
      TelecentricLens& lens = s.truth.array.lenses.front();
      if (model.aspect) lens.aspect = 1.0007;
      if (model.telecentricity) lens.telecentricity_per_mm = 3e-5;
      if (model.distortion[0]) lens.distortion[0] = 2e-5;
      if (model.distortion[4]) lens.distortion = {2e-5, 3e-8, -1e-6, 2e-6, 4e-10};
      if (!model.per_view) return;
      s.truth.array.lenses.assign(4, lens);
      for (std::size_t i = 0; i < 4; ++i)
        s.truth.array.lenses[i].magnification_px_per_mm *= 1 + 1e-4 * static_cast<double>(i);
    });
    const BundleResult result = MustAdjust(scene, With(model));
    EXPECT_LT(LargestError_px(scene, result.state), 1e-8) << ToText(model);
    ASSERT_EQ(result.state.array.lenses.size(), scene.truth.array.lenses.size());
    for (std::size_t i = 0; i < result.state.array.lenses.size(); ++i)
      ExpectEqualLenses(result.state.array.lenses[i], scene.truth.array.lenses[i]);
  }
}

// Corners of 1e-4 px against priors of 10 um: the priors pull by less than 1e-8 mm.
TEST(AdjustBundle, TheBowsAreFoundAndTheRestOfTheTargetStaysAsCertified) {
  const Scene scene = MakeScene(0, 1e-4, [](Scene& s) {
    s.data.target.sigma_square_um = 1;
    s.data.target.coplanarity_um = 2;
    s.truth.target.boards[0].bow_x_mm = 0.002;
    s.truth.target.boards[1].bow_x_mm = -0.001;
    s.truth.target.boards[1].bow_y_mm = 0.0015;
  });
  BundleOptions options;
  options.estimate_bow = true;
  const BundleResult result = MustAdjust(scene, options);
  const TargetShape& found = result.state.target;
  EXPECT_EQ(found.pitch_relative, 0);
  for (int i = 0; i < 2; ++i) {
    const BoardShape a = found.Board(i), b = scene.truth.target.Board(i);
    EXPECT_EQ(a.height_mm, 0);
    EXPECT_EQ(a.tilt_x_rad, 0);
    EXPECT_EQ(a.tilt_y_rad, 0);
    EXPECT_NEAR(a.bow_x_mm, b.bow_x_mm, 1e-6);
    EXPECT_NEAR(a.bow_y_mm, b.bow_y_mm, 1e-6);
  }
  EXPECT_EQ(result.prior_count, 1 + 2 + 5);  // no uncertainty of the separation is stated
}

TEST(AdjustBundle, MovingTheFrameChangesNoResidual) {
  const auto change = [](Scene& s) { s.data.target.sigma_separation_um = 0.25; };
  Scene scene = MakeScene(0.1, 0.1, change);
  const BundleResult here = MustAdjust(scene, {});
  const Eigen::Matrix3d turn = ExpRotation({0.3, -0.2, 0.5});
  const Eigen::Vector3d shift(3, -2, 5);
  for (TelecentricView& view : scene.start.array.views) {
    view.axes_in_array = (view.axes_in_array * turn.transpose()).eval();
    view.offset_mm -= view.axes_in_array * shift;
  }
  for (TargetPose& pose : scene.start.poses) {
    pose.array_from_target = (turn * pose.array_from_target).eval();
    pose.origin_in_array_mm = (turn * pose.origin_in_array_mm + shift).eval();
  }
  scene.start.stage_axis_in_array = turn * scene.start.stage_axis_in_array;
  const BundleResult there = MustAdjust(scene, {});
  // The minimum is the same; the last step of either leaves less than 1e-9 of it.
  EXPECT_NEAR(there.TotalChi2(), here.TotalChi2(), 1e-9 * here.TotalChi2());
  for (const BoardData& board : scene.data.boards)
    EXPECT_LT((ReprojectionErrors_px(there.state, board) - ReprojectionErrors_px(here.state, board))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-5);
}

// One round of mrcal's rule, by its definition.
TEST(RemoveOutliers, ByMrcalsRuleEverythingBeyondFourSampleSigmasGoes) {
  Scene scene = MakeScene(0.1, 0.1, [](Scene&) {});
  scene.data.boards[0].pixels(0, 5) += 4;
  scene.data.boards[3].pixels(1, 40) -= 0.6;
  double squares = 0;
  for (const BoardData& board : scene.data.boards)
    squares += ReprojectionErrors_px(scene.truth, board).squaredNorm();
  const double sigma_px = std::sqrt(squares / (2 * static_cast<double>(scene.data.CornerCount())));
  int beyond = 0;
  for (const BoardData& board : scene.data.boards) {
    const Eigen::Matrix2Xd errors = ReprojectionErrors_px(scene.truth, board).cwiseAbs();
    beyond += static_cast<int>((errors.colwise().maxCoeff().array() > 4 * sigma_px).count());
  }
  const Eigen::Index before = scene.data.CornerCount();
  OutlierOptions options;
  options.scale = OutlierScale::kMrcal;
  EXPECT_EQ(RemoveOutliers(MakeSyntheticArray({}).session, scene.truth, options, scene.data),
            beyond);
  EXPECT_EQ(scene.data.CornerCount(), before - beyond);
  EXPECT_GE(beyond, 2);
}

TEST(AdjustBundle, GrossOutliersDoNotMoveTheRobustResult) {
  Scene scene = MakeScene(0.1, 0.1, [](Scene&) {});
  BundleOptions options;
  options.want_covariance = true;
  const BundleResult clean = MustAdjust(scene, options);
  Random random(5);
  for (BoardData& board : scene.data.boards)
    for (Eigen::Index i = 0; i < board.Count(); ++i)
      if (random.Uniform(0, 1) < 0.02)
        board.pixels.col(i) += Eigen::Vector2d(random.Uniform(2, 30), random.Uniform(-20, 20));
  options.robust_sigmas = 3;
  const ArrayCalibration& robust = MustAdjust(scene, options).state.array;
  const ArrayCalibration& least = clean.state.array;
  const Eigen::VectorXd sigma = least.covariance.diagonal().cwiseSqrt();
  const auto expect_within = [&](Eigen::Index at, double difference) {
    EXPECT_LT(std::abs(difference), sigma(at)) << least.ParameterNames()[std::size_t(at)];
  };
  expect_within(0, robust.Magnification_px_per_mm() - least.Magnification_px_per_mm());
  for (Eigen::Index i = 0; i < 4; ++i) {
    const TelecentricView &a = robust.views[std::size_t(i)], &b = least.views[std::size_t(i)];
    const Eigen::Vector3d turn = LogRotation(a.Rotation() * b.Rotation().transpose());
    for (int k = 0; k < 3; ++k) expect_within(1 + 5 * i + k, turn(k));
    for (int k = 0; k < 2; ++k) expect_within(4 + 5 * i + k, (a.offset_mm - b.offset_mm)(k));
  }
}

}  // namespace
}  // namespace telestrain
