#include "correlation/field_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "base/csv.h"
#include "base/numbers.h"
#include "correlation/expected_noise.h"
#include "correlation/field_summary.h"

namespace telestrain {
namespace {

// 3 x 3 points, step 10 px, u = 1 + 0.001 x; the point in the middle of the right column failed.
CorrelationField SmallField() {
  CorrelationField field;
  field.columns = field.rows = 3;
  field.step_px = 10;
  field.subset_px = 21;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      FieldPoint point;
      point.column = column;
      point.row = row;
      point.center_px = {20 + 10 * column, 30 + 10 * row};
      point.match.status = MatchStatus::kConverged;
      point.match.shape.displacement_px = {1 + 0.001 * point.center_px.x(), -0.5};
      point.match.zncc = 0.99;
      point.match.covariance(0, 0) = 4e-6;
      point.match.covariance(1, 1) = 9e-6;
      point.strain << 1e-3, 2e-4, 2e-4, 0;
      point.sigma_strain = {3e-5, 4e-5, 5e-5};
      field.points.push_back(point);
    }
  field.points[5].match.status = MatchStatus::kLowCorrelation;
  field.points[0].strain.setConstant(std::numeric_limits<double>::quiet_NaN());
  return field;
}

TEST(FieldCsv, HasExactlyTheColumnsAndKeepsWhatFailed) {
  const std::string text = FieldCsv(SmallField());
  EXPECT_TRUE(text.starts_with(
      "x_px,y_px,u_px,v_px,exx,eyy,exy,zncc,sigma_u_px,sigma_v_px,status\n"
      "20,30,1.020000,-0.500000,,,,0.990000,0.002000,0.003000,ok\n"
      "30,30,1.030000,-0.500000,0.001000000,0.000000000,0.000200000,0.990000,0.002000,0.003000,"
      "ok\n"))
      << text;
  EXPECT_NE(text.find("\n40,40,,,,,,,,,low correlation\n"), std::string::npos) << text;
  const auto table = ParseCsv("field", text);
  ASSERT_TRUE(table.ok()) << table.error().message;
  EXPECT_EQ(table->rows.size(), 9U);
}

TEST(FieldVtp, JoinsConvergedNeighboursAndLeavesTheOthersAsVertices) {
  const std::string text = FieldVtp(SmallField(), {"u: displacement"});
  // The failed point takes both quads at its side away, and their other corners stand alone.
  EXPECT_NE(text.find("NumberOfPoints=\"9\" NumberOfVerts=\"3\" NumberOfPolys=\"2\""),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("\n0 1 4 3\n3 4 7 6\n"), std::string::npos) << text;
  EXPECT_NE(text.find("<!--\nu: displacement\nstatus: 0 ok, 1 low contrast, "), std::string::npos);
}

TEST(FieldVtp, WithPointsOutsideAMaskMissingStillJoinsTheRightOnes) {
  PixelMask mask{60, 60, std::vector<unsigned char>(3600, 1)};
  mask.inside[30 * 60 + 20] = 0;  // the first point
  const CorrelationField field = PointsInside(SmallField(), mask);
  ASSERT_EQ(field.points.size(), 8U);
  const std::string text = FieldVtp(field, {});
  // Left over is the lower left quad; the first row's two and the right column's two stand alone.
  EXPECT_NE(text.find("NumberOfPoints=\"8\" NumberOfVerts=\"4\" NumberOfPolys=\"1\""),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("\n2 3 6 5\n"), std::string::npos) << text;
}

TEST(FieldSummary, CountsEveryPointOnceAndAveragesWhatIsThere) {
  const FieldSummary summary = Summarize(SmallField());
  EXPECT_EQ(summary.points, 9U);
  EXPECT_EQ(summary.converged(), 8U);
  EXPECT_EQ(summary.count_of_status[static_cast<int>(MatchStatus::kLowCorrelation)], 1U);
  EXPECT_EQ(summary.points_with_strain, 7U);
  // Eight points: x = 20, 30, 40 three times each without one 40.
  EXPECT_NEAR(summary.mean_displacement_px.x(), 1 + 0.001 * 230 / 8, 1e-12);
  EXPECT_NEAR(summary.mean_strain(0, 0), 1e-3, 1e-15);
  EXPECT_NEAR(summary.median_sigma_px.x(), 2e-3, 1e-15);
  EXPECT_NEAR(summary.median_sigma_strain.y(), 4e-5, 1e-15);
}

TEST(FieldSummary, OfNothingIsNaNAndNoZero) {
  CorrelationField field = SmallField();
  for (FieldPoint& point : field.points) point.match.status = MatchStatus::kOutside;
  const FieldSummary summary = Summarize(field);
  EXPECT_EQ(summary.converged(), 0U);
  EXPECT_TRUE(std::isnan(summary.mean_displacement_px.x()));
  EXPECT_TRUE(std::isnan(summary.median_sigma_px.y()));
}

PatternAssessment Assessed() {
  PatternAssessment pattern;
  pattern.noise_gray = 2;
  pattern.gradient_gray_per_px = 20;
  pattern.recommended_subset_px = 25;
  pattern.expected_sigma_px = 0.01;
  return pattern;
}

// A sin(kx) + A sin(ky) has the fourth-order differences A cos(kx) (8 sin k - sin 2k) / 6: over
// whole periods the sum of their squares is half the subset's area times the square of the factor.
TEST(ExpectedNoise, FollowsTheGradientOfAWave) {
  constexpr int kPeriod_px = 8, kSubset_px = 2 * kPeriod_px + 1;
  constexpr double kAmplitude = 50, k = 2 * std::numbers::pi / kPeriod_px;
  GrayImage image{64, 64, 255, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      image.pixels.push_back(
          static_cast<float>(128 + kAmplitude * (std::sin(k * x) + std::sin(k * y))));
  PixelMask mask{64, 64, std::vector<unsigned char>(64 * 64, 1)};
  // Takes the 17th row and column away, so that whole periods are left.
  for (int i = 0; i < 64; ++i) mask.inside[40 * 64 + i] = mask.inside[i * 64 + 40] = 0;
  const auto sigma_px = ExpectedSigma_px(image, {{32, 32}}, kSubset_px, Assessed(), &mask);
  const double pixels = 4 * kPeriod_px * kPeriod_px;
  const double slope = kAmplitude * (8 * std::sin(k) - std::sin(2 * k)) / 6;
  const double sssig = pixels * (0.5 * slope * slope - 2.0 * 2.0 * 130 / 144);
  // Grey levels are floats, rounded to 1e-7 of themselves; their differences are a fifth of them.
  EXPECT_NEAR(sigma_px.at(0), 0.01 * 25 * 20 / std::sqrt(sssig), 1e-6 * sigma_px.at(0));
}

TEST(ExpectedNoise, IsNoNumberWhereNoiseHidesTheTexture) {
  const GrayImage flat{64, 64, 255, std::vector<float>(64 * 64, 100.0F)};
  EXPECT_TRUE(std::isnan(ExpectedSigma_px(flat, {{32, 32}}, 21, Assessed()).at(0)));
}

}  // namespace
}  // namespace telestrain
