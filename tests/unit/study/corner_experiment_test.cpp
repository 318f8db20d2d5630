#include "study/corner_experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace telestrain {
namespace {

CornerExperiment Small() {
  CornerExperiment experiment;
  experiment.poses = 9;
  experiment.rulers = 120;
  experiment.noise_px = 0.1;
  return experiment;
}

TEST(CornerExperiment, TheRulerScattersByTheNoiseOfItsCrosses) {
  const auto outcome = RunCornerExperiment(Small());
  ASSERT_TRUE(outcome.ok()) << outcome.error().message;
  ASSERT_EQ(outcome->ruler_error_um.size(), 120u);
  const double noise_um =
      1000 * 0.1 / outcome->calibration.bundle.state.array.Magnification_px_per_mm();
  // The sd of 120 values scatters by 1 / sqrt(240); 4 sigma.
  EXPECT_NEAR(FiguresOf(outcome->ruler_error_um).rms / noise_um, 1, 4 / std::sqrt(240.0));
}

TEST(CornerExperiment, WithoutNoiseOfTheCrossesOnlyTheCalibrationIsLeft) {
  const auto outcome = RunCornerExperiment(Small());
  ASSERT_TRUE(outcome.ok());
  // All rulers share one calibration: their errors stay within four of its stated uncertainties.
  for (std::size_t i = 0; i < outcome->ruler_systematic_um.size(); ++i)
    EXPECT_LT(std::abs(outcome->ruler_systematic_um[i]), 4 * outcome->ruler_calibration_part_um[i]);
}

TEST(CornerExperiment, ACertificateErrorReachesTheRulerOneToOne) {
  CornerExperiment experiment = Small();
  const auto plain = RunCornerExperiment(experiment);
  experiment.instrument.separation_error_um = 2;
  const auto shifted = RunCornerExperiment(experiment);
  ASSERT_TRUE(plain.ok() && shifted.ok());
  const double change_um =
      FiguresOf(shifted->ruler_systematic_um).mean - FiguresOf(plain->ruler_systematic_um).mean;
  // Same noise in both; 27.6 of 27.7 mm of it, and poses that differ by 2 um.
  EXPECT_NEAR(change_um, -2, 0.02);
}

TEST(CornerExperiment, RulersReachFromEndToEndOfTheVolume) {
  const auto outcome = RunCornerExperiment(Small());
  ASSERT_TRUE(outcome.ok());
  EXPECT_DOUBLE_EQ(outcome->ruler_position.front(), -1);
  EXPECT_DOUBLE_EQ(outcome->ruler_position.back(), 1);
}

TEST(CornerExperiment, DefocusMakesTheResidualsLarger) {
  CornerExperiment experiment = Small();
  const auto sharp = RunCornerExperiment(experiment);
  experiment.instrument.numerical_aperture = 0.02;
  const auto blurred = RunCornerExperiment(experiment);
  ASSERT_TRUE(sharp.ok() && blurred.ok());
  EXPECT_GT(blurred->calibration.all.rms_px, 1.02 * sharp->calibration.all.rms_px);
}

TEST(CornerExperiment, PosesCanBeRestrictedToWholeBoards) {
  CornerExperiment experiment = Small();
  experiment.use_cut_off_boards = false;
  const auto whole = RunCornerExperiment(experiment);
  ASSERT_TRUE(whole.ok());
  // 9 poses, 2 images, 4 views of 117 corners, less the few that noise makes outliers.
  EXPECT_GE(whole->corner_error_px.size(), 9u * 2 * 4 * 117 - 10);
  experiment.use_cut_off_boards = true;
  const auto cut = RunCornerExperiment(experiment);
  ASSERT_TRUE(cut.ok());
  EXPECT_LT(cut->corner_error_px.size(), whole->corner_error_px.size());
}

}  // namespace
}  // namespace telestrain
