#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "correlation/correlation_field.h"
#include "correlation/strain_field.h"
#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

FieldOptions Options(int subset_px, int step_px) {
  FieldOptions options;
  options.correlation.subset_px = subset_px;
  options.step_px = step_px;
  return options;
}

// A field whose displacements are a given map, without images.
CorrelationField MappedField(const ShapeFunction& map, int columns, int rows, int step_px) {
  CorrelationField field;
  field.columns = columns;
  field.rows = rows;
  field.step_px = step_px;
  field.subset_px = 33;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      FieldPoint point;
      point.column = column;
      point.row = row;
      point.center_px = {100 + column * step_px, 200 + row * step_px};
      point.match.status = MatchStatus::kConverged;
      point.match.shape = TruthAt(map, {0, 0}, point.center_px);
      point.match.covariance.setIdentity();
      field.points.push_back(point);
    }
  return field;
}

TEST(Strain, IsGreenLagrangeAndInvariantToRotation) {
  Eigen::Matrix2d stretch, rotation;
  stretch << 1.02, 0.005, 0.005, 0.99;
  rotation << std::cos(0.7), -std::sin(0.7), std::sin(0.7), std::cos(0.7);
  ShapeFunction map;
  map.gradient = rotation * stretch - Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d expected =
      0.5 * (stretch.transpose() * stretch - Eigen::Matrix2d::Identity());
  CorrelationField field = MappedField(map, 9, 7, 8);
  correlation::ComputeStrain(Options(33, 8), field);
  for (const FieldPoint& point : field.points)
    EXPECT_NEAR((point.strain - expected).cwiseAbs().maxCoeff(), 0, 1e-12);
}

TEST(Strain, NeedsEnoughNeighborsThatAreNotOnALine) {
  CorrelationField field = MappedField({}, 9, 9, 8);
  for (FieldPoint& point : field.points)
    if (point.row < 4) point.match.status = MatchStatus::kLowCorrelation;
  FieldOptions options = Options(33, 8);
  options.min_strain_share = 0.6;  // 15 of 25
  correlation::ComputeStrain(options, field);
  EXPECT_TRUE(std::isnan(field.points[3 * 9 + 4].strain(0, 0)));   // failed itself
  EXPECT_FALSE(std::isnan(field.points[4 * 9 + 4].strain(0, 0)));  // 15 in its window
  EXPECT_TRUE(std::isnan(field.points[4 * 9 + 1].strain(0, 0)));   // 12
  for (FieldPoint& point : field.points)
    if (point.row > 4) point.match.status = MatchStatus::kLowCorrelation;
  options.min_strain_share = 0.1;
  correlation::ComputeStrain(options, field);
  EXPECT_TRUE(std::isnan(field.points[4 * 9 + 4].sigma_strain[0]));
}

// Subsets that do not touch: the textbook slope of a straight line.
TEST(Strain, WithoutOverlapTheSlopeIsThatOfIndependentPoints) {
  const correlation::SubsetOverlap overlap(21, 1);
  const Eigen::Matrix2d slopes = correlation::PlaneSlopeCovariance(5, 30, overlap);
  EXPECT_NEAR(slopes(0, 0), 1.0 / (5 * 10 * 900), 1e-15);  // 1 / sum x^2
  EXPECT_NEAR(slopes(0, 1), 0, 1e-18);
}

class CleanField : public testing::Test {
 protected:
  // Mean of the local strains of the whole field.
  static Eigen::Matrix2d MeanStrain(const ShapeFunction& map, unsigned seed) {
    constexpr int kSide = 1000;
    const PixelRegion region{0, 0, kSide, kSide};
    const Speckle speckle(seed, kSide, kSide);
    const GrayImage before = speckle.Render(kSide, kSide);
    const GrayImage after = speckle.Render(kSide, kSide, map, region.Middle());
    FieldOptions options = Options(33, 22);
    options.region = PixelRegion{30, 30, kSide - 60, kSide - 60};  // stays inside when turned
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    double count = 0;
    for (const auto& point :
         Correlate({before, region, options.correlation}, after, options).points) {
      if (std::isnan(point.strain(0, 0))) continue;
      sum += point.strain;
      ++count;
    }
    EXPECT_GT(count, 1000);
    return sum / count;
  }
};

// Without noise: a mean of local strains is the difference of the edges of the field, so that its
// noise (1 microstrain here) would hide what the motion does. With noise, by a plane through the
// whole field: tests/statistical/correlation_bars_test.cpp.
TEST_F(CleanField, TranslationGivesNoStrain) {
  ShapeFunction map;
  map.displacement_px = {3.37, -1.62};
  EXPECT_LT(MeanStrain(map, 41).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(CleanField, RotationByOneDegreeGivesNoStrain) {
  const double angle = M_PI / 180;
  ShapeFunction map;
  map.gradient << std::cos(angle) - 1, -std::sin(angle), std::sin(angle), std::cos(angle) - 1;
  EXPECT_LT(MeanStrain(map, 42).cwiseAbs().maxCoeff(), 1e-6);
}

// Strains at the middles of windows of many noisy pairs.
class StrainScatter {
 public:
  StrainScatter(const FieldOptions& options, int runs) {
    constexpr int kSide = 260;
    const PixelRegion region{0, 0, kSide, kSide};
    const Speckle speckle(51, kSide, kSide);
    ShapeFunction map;
    map.displacement_px = {0.4, 0.3};
    map.gradient << 2e-3, 1e-3, -1e-3, 0;
    std::mt19937 random(7);
    const GrayImage clean = speckle.Render(kSide, kSide);
    const GrayImage moved = speckle.Render(kSide, kSide, map, region.Middle());
    std::vector<std::vector<Eigen::Vector3d>> strains;
    double count = 0;
    for (int run = 0; run < runs; ++run) {
      GrayImage before = clean, after = moved;
      AddNoise(3, random, before);
      AddNoise(3, random, after);
      const auto field = Correlate({before, region, options.correlation}, after, options);
      strains.emplace_back();
      for (const FieldPoint& point : field.points) {
        if (std::isnan(point.strain(0, 0))) continue;
        strains.back().push_back({point.strain(0, 0), point.strain(1, 1), point.strain(0, 1)});
        predicted += point.sigma_strain.cwiseAbs2();
        ++count;
      }
    }
    predicted = (predicted / count).cwiseSqrt();
    const std::size_t points = strains[0].size();
    for (std::size_t i = 0; i < points; ++i) {
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (const auto& run : strains) mean += run.at(i) / runs;
      for (const auto& run : strains)
        observed += (run.at(i) - mean).cwiseAbs2() / ((runs - 1.0) * static_cast<double>(points));
    }
    observed = observed.cwiseSqrt();
  }
  Eigen::Vector3d predicted = Eigen::Vector3d::Zero(), observed = Eigen::Vector3d::Zero();
};

// About 9 windows that do not overlap, 40 runs: 360 values know a standard deviation to 4 %; 15 %
// is the bar of the project.
TEST(Strain, UncertaintyIsHonestWithOverlappingSubsets) {
  const StrainScatter scatter(Options(33, 8), 40);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(scatter.predicted[k] / scatter.observed[k], 1, 0.15) << k;
}

TEST(Strain, UncertaintyIsHonestWithoutOverlap) {
  const StrainScatter scatter(Options(21, 21), 40);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(scatter.predicted[k] / scatter.observed[k], 1, 0.15) << k;
}

}  // namespace
}  // namespace telestrain
