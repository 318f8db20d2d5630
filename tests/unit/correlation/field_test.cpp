// Whole fields about which nothing is known: every point ends with the right status.
#include <gtest/gtest.h>

#include <cmath>

#include "correlation/correlation_field.h"
#include "correlation/field_tracker.h"
#include "tests/unit/correlation/speckle.h"

namespace telestrain {
namespace {

constexpr int kWidth = 420, kHeight = 360;
const PixelRegion kRegion{0, 0, kWidth, kHeight};
const Eigen::Vector2d kAbout = kRegion.Middle();

FieldOptions Options() {
  FieldOptions options;
  options.correlation.subset_px = 33;
  options.step_px = 12;
  return options;
}

ShapeFunction Turn(double angle_deg) {
  const double c = std::cos(angle_deg * M_PI / 180), s = std::sin(angle_deg * M_PI / 180);
  ShapeFunction map;
  map.gradient << c - 1, -s, s, c - 1;
  return map;
}

double Error_px(const FieldPoint& point, const ShapeFunction& map) {
  return (point.match.shape.displacement_px - TruthAt(map, kAbout, point.center_px).displacement_px)
      .norm();
}

// Largest distance of the two centres along one axis.
int Away(const Eigen::Vector2i& a, const Eigen::Vector2i& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

class Field : public testing::Test {
 protected:
  const Speckle speckle_{17, kWidth, kHeight, 1.8};
  const GrayImage before_ = speckle_.Render(kWidth, kHeight);
  const FieldOptions options_ = Options();
  const CorrelationReference reference_{before_, kRegion, options_.correlation};
};

TEST_F(Field, TheGridHoldsWholeSubsetsRowByRow) {
  FieldOptions options = Options();
  options.region = PixelRegion{100, 0, 60, 1000};
  const auto centers = GridCenters(kWidth, kHeight, options);
  ASSERT_FALSE(centers.empty());
  EXPECT_EQ(centers.front(), Eigen::Vector2i(100, 24));  // half a subset and 8 px of border
  EXPECT_EQ(centers[1], Eigen::Vector2i(112, 24));
  EXPECT_EQ(centers.size() % 5, 0u);
  EXPECT_EQ(centers[5], Eigen::Vector2i(100, 36));
  for (const auto& point : Correlate(reference_, before_, options).points)
    EXPECT_TRUE(point.match.ok()) << point.center_px.transpose();
  options.correlation.subset_px = 401;
  EXPECT_TRUE(GridCenters(kWidth, kHeight, options).empty());
}

// Far and turned: only what left the image is lost.
TEST_F(Field, LargeShiftsAndRotationsNeedNoStart) {
  for (const double angle_deg : {0.0, 5.0, -8.0}) {
    ShapeFunction map = Turn(angle_deg);
    map.displacement_px = {71.3, -52.6};
    const GrayImage after = speckle_.Render(kWidth, kHeight, map, kAbout);
    const CorrelationField field = Correlate(reference_, after, options_);
    ASSERT_EQ(field.points.size(), static_cast<std::size_t>(field.columns) * field.rows);
    for (const FieldPoint& point : field.points) {
      const Eigen::Vector2d at =
          point.center_px.cast<double>() + TruthAt(map, kAbout, point.center_px).displacement_px;
      const double inside = std::min({at.x(), at.y(), kWidth - 1 - at.x(), kHeight - 1 - at.y()});
      if (inside > 24) {  // half the diagonal of the subset, turned by 8 deg, and the border
        EXPECT_TRUE(point.match.ok()) << angle_deg << ": " << point.center_px.transpose();
        EXPECT_LT(Error_px(point, map), 2e-3);  // interpolation, without noise
      }
      if (inside < 15) {
        EXPECT_FALSE(point.match.ok());
      }
    }
  }
}

TEST_F(Field, TheNumberOfThreadsChangesNoBit) {
  ShapeFunction map = Turn(3);
  map.displacement_px = {40, 30};
  const GrayImage after = speckle_.Render(kWidth, kHeight, map, kAbout);
  std::vector<CorrelationField> runs;
  for (const int threads : {1, 2, 5}) {
    FieldOptions options = Options();
    options.correlation.threads = threads;
    runs.push_back(Correlate({before_, kRegion, options.correlation}, after, options));
  }
  for (std::size_t i = 0; i < runs[0].points.size(); ++i)
    for (const auto& run : runs) {
      EXPECT_EQ(run.points[i].match.status, runs[0].points[i].match.status);
      EXPECT_EQ(run.points[i].match.zncc, runs[0].points[i].match.zncc);
      EXPECT_EQ(run.points[i].match.shape.displacement_px,
                runs[0].points[i].match.shape.displacement_px);
      EXPECT_EQ(run.points[i].match.covariance, runs[0].points[i].match.covariance);
      if (!std::isnan(runs[0].points[i].strain(0, 0))) {
        EXPECT_EQ(run.points[i].strain, runs[0].points[i].strain);
      }
    }
}

void Paint(const Eigen::Vector2i& middle, int half, const GrayImage& from, GrayImage& image) {
  for (int y = middle.y() - half; y <= middle.y() + half; ++y)
    for (int x = middle.x() - half; x <= middle.x() + half; ++x) image.At(x, y) = from.At(x, y);
}

// A black place of the reference, a covered one and one with another pattern in the image, and a
// masked one: they are reported, and everything around them is measured.
TEST_F(Field, HopelessPlacesAreReportedAndTheirSurroundingsMeasured) {
  const Eigen::Vector2i black(100, 100), covered(300, 100), other(100, 260), masked(300, 260);
  const int half = 32, subset_half = 16;
  const GrayImage nothing{kWidth, kHeight, 255, std::vector<float>(kWidth * kHeight, 0.f)};
  ShapeFunction map;
  map.displacement_px = {4.3, -2.6};
  GrayImage before = before_, after = speckle_.Render(kWidth, kHeight, map);
  Paint(black, half, nothing, before);
  Paint(covered, half, nothing, after);
  Paint(other, half, Speckle(99, kWidth, kHeight, 1.8).Render(kWidth, kHeight), after);
  FieldOptions options = Options();
  options.mask = PixelMask{kWidth, kHeight, std::vector<unsigned char>(kWidth * kHeight, 1)};
  for (int y = masked.y() - half; y <= masked.y() + half; ++y)
    for (int x = masked.x() - half; x <= masked.x() + half; ++x)
      options.mask->inside[static_cast<std::size_t>(y) * kWidth + x] = 0;
  const CorrelationField field = Correlate({before, kRegion, options.correlation}, after, options);
  ASSERT_EQ(field.points.size(), GridCenters(kWidth, kHeight, options).size());
  int measured = 0;
  for (const FieldPoint& point : field.points) {
    const Eigen::Vector2i& c = point.center_px;
    const MatchStatus status = point.match.status;
    if (Away(c, masked) <= half) {
      EXPECT_EQ(status, MatchStatus::kMasked);
    } else if (Away(c, black) < half - subset_half) {
      EXPECT_EQ(status, MatchStatus::kLowContrast);
    } else if (Away(c, covered) < 8) {  // black in the image
      EXPECT_EQ(status, MatchStatus::kSaturated);
    } else if (Away(c, other) < 8) {
      EXPECT_TRUE(status == MatchStatus::kNotConverged || status == MatchStatus::kLowCorrelation)
          << c.transpose() << ": " << ToText(status);
    } else if (std::min({Away(c, black), Away(c, covered), Away(c, other)}) >
                   half + subset_half + 6 &&
               std::min(kWidth - c.x(), c.y()) > 26) {
      EXPECT_TRUE(point.match.ok()) << c.transpose() << ": " << ToText(status);
      EXPECT_LT(Error_px(point, map), 2e-3);
      ++measured;
    }
  }
  EXPECT_GT(measured, 300);
}

// Two places of the image are repainted with what belongs elsewhere: seeds that correlate
// perfectly and are wrong by 100 px.
TEST_F(Field, ABadSeedStopsNothing) {
  GrayImage after = before_;
  const Eigen::Vector2i decoy(210, 180);
  for (int y = -40; y <= 40; ++y)
    for (int x = -40; x <= 40; ++x)
      after.At(decoy.x() + x, decoy.y() + y) = before_.At(310 + x, 180 + y);
  int measured = 0;
  for (const FieldPoint& point : Correlate(reference_, after, options_).points) {
    if (Away(point.center_px, decoy) < 40 + 17) continue;
    ++measured;
    EXPECT_TRUE(point.match.ok()) << point.center_px.transpose();
    EXPECT_LT(Error_px(point, {}), 1e-3) << point.center_px.transpose();
  }
  EXPECT_GT(measured, 400);
}

TEST_F(Field, AnotherPatternLosesAllPoints) {
  const GrayImage other = Speckle(98, kWidth, kHeight, 1.8).Render(kWidth, kHeight);
  FieldOptions options = Options();
  options.step_px = 60;
  for (const FieldPoint& point : Correlate(reference_, other, options).points) {
    EXPECT_FALSE(point.match.ok());
    EXPECT_TRUE(std::isnan(point.strain(0, 0)));
  }
}

// The smallest bands have 64 rows.
TEST_F(Field, ReferencesInBandsGiveTheBitsOfTheWhole) {
  const ShapeFunction map = Turn(1);
  const GrayImage after = speckle_.Render(kWidth, kHeight, map, kAbout);
  FieldOptions options = Options();
  options.correlation.subset_px = 35;
  const CorrelationField whole = (*FieldTracker::Start(before_, options)).Track(after);
  options.max_band_pixels = 1;
  const CorrelationField bands = (*FieldTracker::Start(before_, options)).Track(after);
  ASSERT_EQ(whole.points.size(), bands.points.size());
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    const SubsetMatch &a = whole.points[i].match, &b = bands.points[i].match;
    EXPECT_EQ(a.status, b.status) << i;
    EXPECT_EQ(a.shape.displacement_px, b.shape.displacement_px) << i;
    EXPECT_EQ(a.shape.gradient, b.shape.gradient) << i;
    EXPECT_EQ(a.zncc, b.zncc) << i;
    EXPECT_EQ(a.covariance, b.covariance) << i;
  }
}

}  // namespace
}  // namespace telestrain
