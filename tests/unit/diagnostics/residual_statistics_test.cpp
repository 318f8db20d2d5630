#include "diagnostics/residual_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/calibration/synthetic_array.h"

namespace telestrain {
namespace {

constexpr double kPi = 3.14159265358979323846;
const Eigen::Vector2d kNowhere = Eigen::Vector2d::Zero();

CornerResidual At(int view, int corner, Eigen::Vector2d observed_px, Eigen::Vector2d residual_px) {
  CornerResidual r{0, view, 0, corner};
  r.observed_px = observed_px;
  r.residual_px = residual_px;
  r.whitened = 2 * residual_px;
  return r;
}

// Errors of 5, 1 and 0 px length and an outlier.
ResidualList FourCorners() {
  ResidualList list = {At(0, 0, {0, 0}, {3, 4}), At(0, 1, {10, 0}, {-1, 0}),
                       At(1, 0, {0, 10}, {0, 0}), At(1, 1, {10, 10}, {100, 0})};
  list[3].is_outlier = true;
  return list;
}

TEST(Summarise, CountsScalarsCornersAndOutliersAsMrcalDoes) {
  const ResidualSummary s = Summarise(FourCorners());
  EXPECT_EQ(s.corners, 4);
  EXPECT_EQ(s.outliers, 1);
  EXPECT_DOUBLE_EQ(s.rms_per_scalar_px, std::sqrt(26.0 / 8));  // the outlier's scalars count as 0
  EXPECT_DOUBLE_EQ(s.rms_of_inliers_per_scalar_px, std::sqrt(26.0 / 6));
  EXPECT_DOUBLE_EQ(s.rms_of_inliers_per_corner_px, std::sqrt(26.0 / 3));
  EXPECT_DOUBLE_EQ(s.rms_whitened, 2 * std::sqrt(26.0 / 6));
  EXPECT_DOUBLE_EQ(s.mean_px, 1.0);  // (3 + 4 - 1 + 0 + 0 + 0) / 6
  EXPECT_DOUBLE_EQ(s.sigma_px, std::sqrt(26.0 / 6 - 1));
  EXPECT_DOUBLE_EQ(s.worst_corner_px, 5);
}

TEST(Summarise, OfNothingIsZero) {
  EXPECT_EQ(Summarise({}).rms_per_scalar_px, 0);
  EXPECT_TRUE(HistogramOfResiduals({}).counts.empty());
  EXPECT_TRUE(BoardsFromWorst({}).empty());
}

TEST(ExpectedRms, IsWhatAFitOfHalfTheNumbersLeaves) {
  EXPECT_DOUBLE_EQ(ExpectedRms_px(0.1, 100, 200), 0.1 * std::sqrt(0.5));
}

TEST(HistogramOfResiduals, PutsTheMiddleBinOnZero) {
  const ResidualHistogram h = HistogramOfResiduals(
      {At(0, 0, kNowhere, {-0.0099, 0.0099}), At(0, 1, kNowhere, {0.011, -0.031})}, kMrcalBin_px);
  EXPECT_EQ(h.first_bin, -2);
  EXPECT_EQ(h.counts, (std::vector<int>{1, 0, 2, 1}));
  EXPECT_DOUBLE_EQ(h.Center_px(3), 0.02);
  // At the mean the curve is what a normal distribution has in one bin there.
  EXPECT_NEAR(h.Gaussian(h.mean_px), 4 * std::erf(0.01 / h.sigma_px / std::sqrt(2.0)), 1e-12);
}

TEST(BinFor, IsARoundQuarterOfSigma) {
  EXPECT_NEAR(BinFor_px(0.003), 0.001, 1e-18);
  EXPECT_NEAR(BinFor_px(0.1), 0.02, 1e-16);
  EXPECT_EQ(BinFor_px(0), 0);
}

TEST(BoardsFromWorst, RanksByRmsPerCornerWithoutOutliers) {
  const auto boards = BoardsFromWorst(FourCorners());
  ASSERT_EQ(boards.size(), 2u);
  EXPECT_EQ(boards[0].view, 0);
  EXPECT_DOUBLE_EQ(boards[0].rms_per_corner_px, std::sqrt(26.0 / 2));
  EXPECT_EQ(boards[0].worst_corner, 0);
  EXPECT_DOUBLE_EQ(boards[0].worst_corner_px, 5);
  EXPECT_EQ(boards[1].outliers, 1);
  EXPECT_EQ(boards[1].inliers, 1);
  EXPECT_EQ(boards[1].rms_per_corner_px, 0);
}

TEST(DirectionsOf, FollowTheCircle) {
  const ResidualList list = {At(0, 0, kNowhere, {1, 0}), At(0, 1, kNowhere, {0, 2}),
                             At(0, 2, kNowhere, {-3, 0}), At(0, 3, kNowhere, {0, -4}),
                             At(0, 4, kNowhere, {5, 0})};
  const DirectionHistogram d = DirectionsOf(list, 4);  // sectors from -180, -90, 0, 90 degrees
  EXPECT_EQ(d.counts, (std::vector<int>{0, 1, 2, 2}));
  EXPECT_NEAR(d.mean_direction_rad, 0, 1e-15);
  EXPECT_NEAR(d.mean_resultant, 1.0 / 5, 1e-15);
  EXPECT_DOUBLE_EQ(Direction_rad(list[2]), kPi);
}

TEST(RegionalStatistics, TakesWhatLiesWithinHalfAStep) {
  ResidualList list;
  for (int i = 0; i < 3; ++i) list.push_back(At(0, i, {104, 50.0 + i}, {1.0 * i, 2.0}));
  list.push_back(At(0, 3, {120, 50}, {9, 9}));
  const RegionalMap map = RegionalStatistics(list, {100, 50, 41, 21}, 5);
  EXPECT_EQ(map.columns, 5);  // points 10 px apart
  EXPECT_EQ(map.rows, 3);     // nearest to 21 / 41 * 5
  EXPECT_EQ(map.scalars[0], 6);
  EXPECT_DOUBLE_EQ(map.mean_px[0], 1.5);
  EXPECT_DOUBLE_EQ(map.sd_px[0], std::sqrt((0 + 1 + 4 + 3 * 4) / 6.0 - 1.5 * 1.5));
  EXPECT_EQ(map.scalars[2], 2);  // too few for a mean
  EXPECT_EQ(map.mean_px[2], 0);
}

TEST(ReplayOutlierRule, MarksAboveFourSigmaOnceOneIsAboveFive) {
  ResidualList list;
  for (int i = 0; i < 100; ++i)
    list.push_back(At(0, i, kNowhere, {i % 2 ? 1 : -1, i % 2 ? -1 : 1}));
  EXPECT_TRUE(MarkOutliers(list).marked.empty());
  list[7].residual_px.x() = 4.4;  // above 4 sigma, hidden behind the next one
  EXPECT_TRUE(MarkOutliers(list).marked.empty());
  list[9].residual_px.y() = 60;
  const auto passes = ReplayOutlierRule(list);
  ASSERT_EQ(passes.size(), 2u);
  EXPECT_EQ(passes[0].marked, (std::vector<std::size_t>{9}));
  EXPECT_NEAR(passes[0].sigma_px, std::sqrt((198 + 4.4 * 4.4 + 3600) / 200), 1e-12);
  EXPECT_TRUE(passes[1].marked.empty());  // 4.4 is below 5 sigma of the rest
  list[9].is_outlier = false;
  list[7].residual_px.x() = 5.6;
  EXPECT_EQ(ReplayOutlierRule(list)[1].marked, (std::vector<std::size_t>{7}));
}

TEST(ResidualsOf, AreMeasuredMinusPredictedAndWhitened) {
  const auto array = testing_support::MakeSyntheticArray({});
  const CalibrationData data = *CollectCalibrationData(array.session, array.boards);
  ArrayState truth;
  truth.array.lenses = {array.lens};
  truth.array.views = array.views;
  truth.poses = array.poses;
  const ResidualList list = ResidualsOf(data, truth);
  ASSERT_EQ(list.size(), 72u * 117u);
  const BoardData& board = data.boards[5];
  const CornerResidual& r = list[5 * 117 + 8];
  const Eigen::Vector2d predicted = truth.array.Project(
      r.view, array.poses[1].array_from_target * board.corners_in_target_mm.col(8) +
                  array.poses[1].origin_in_array_mm);
  EXPECT_EQ(r.image, 1);
  EXPECT_EQ(r.view, 1);
  EXPECT_EQ(r.corner, 8);
  EXPECT_LT((r.observed_px - predicted - r.residual_px).norm(), 1e-9);
  EXPECT_LT((board.whitening[8] * r.residual_px - r.whitened).norm(), 1e-12);
  EXPECT_NEAR(Summarise(list).rms_whitened, 1, 4 / std::sqrt(2.0 * 16848));  // 4 sigma
  EXPECT_EQ(OfView(list, 2).size(), 18u * 117u);
}

}  // namespace
}  // namespace telestrain
