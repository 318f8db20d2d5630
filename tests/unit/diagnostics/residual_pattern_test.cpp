#include "diagnostics/residual_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

#include "unit/diagnostics/fitted_array.h"

namespace telestrain {
namespace {

using testing_support::FitArray;
using testing_support::FitOptions;
using testing_support::FittedArray;
using testing_support::ShiftCorners;
using testing_support::SyntheticArray;

constexpr std::size_t kColumns = 13, kRows = 9;

// The verdict on an array that was spoilt so; says it, for whoever reads the log.
ResidualVerdict Judged(const FitOptions& options) {
  const ResidualVerdict verdict = FitArray(options).Judge();
  std::cout << verdict.text << "\n";
  for (std::size_t i = 1; i < verdict.findings.size(); ++i)
    std::cout << "  then: " << verdict.findings[i].text << "\n";
  return verdict;
}

// The first finding, which must be of this kind.
PatternFinding MustFind(const ResidualVerdict& verdict, PatternKind kind) {
  EXPECT_EQ(verdict.kind, ResidualVerdict::Kind::kPattern);
  if (verdict.findings.empty()) {
    ADD_FAILURE() << "nothing found";
    return {};
  }
  EXPECT_EQ(verdict.findings.front().kind, kind) << verdict.text;
  EXPECT_NE(verdict.findings.front().remedy, "");
  EXPECT_EQ(verdict.text.rfind("A pattern remains: looks like ", 0), 0u);
  return verdict.findings.front();
}

void ExpectValue(const PatternFinding& found, double truth) {
  ASSERT_FALSE(found.values.empty());
  EXPECT_NEAR(found.values[0].value, truth, 4 * found.values[0].sigma) << found.text;
}

TEST(JudgeResiduals, PureNoiseIsNoise) {
  // Each with a false alarm in less than 0.9 %: more than 1 of 20 have a chance of 1.4 %.
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    FitOptions options;
    options.synthetic.seed = seed;
    options.synthetic.poses = 6;
    const ResidualVerdict verdict = FitArray(options).Judge();
    alarms += verdict.kind != ResidualVerdict::Kind::kNoise;
    if (verdict.kind != ResidualVerdict::Kind::kNoise) continue;
    EXPECT_EQ(verdict.text, "The residuals are noise.");
  }
  EXPECT_LE(alarms, 1);
}

TEST(JudgeResiduals, DegreesAreScalarsLessParameters) {
  const FittedArray fitted = FitArray({});
  const ResidualVerdict verdict = fitted.Judge();
  // One magnification, 4 x 5 of the views, 18 x 6 of the poses less the gauge.
  EXPECT_EQ(verdict.degrees, 16848 - (1 + 20 + 18 * 6 - 6));
  EXPECT_GT(verdict.patterns_asked, 100);
}

TEST(JudgeResiduals, TheK1OfOneLensIsNamedWithItsValue) {
  constexpr double kK1_per_mm2 = 3e-5;
  FitOptions options;
  options.truth = [&](SyntheticArray& array) {
    array.lens_of_view.assign(4, array.lens);
    array.lens_of_view[2].distortion[0] = kK1_per_mm2;
  };
  const PatternFinding found = MustFind(Judged(options), PatternKind::kRadialK1);
  EXPECT_EQ(found.view, 2);
  ExpectValue(found, kK1_per_mm2);
  EXPECT_NE(found.name.find("view B1"), std::string::npos);
}

TEST(JudgeResiduals, TheK1OfTheCommonLensIsNamedAsThat) {
  constexpr double kK1_per_mm2 = 2e-5;
  FitOptions options;
  options.synthetic.k1_per_mm2 = kK1_per_mm2;
  const PatternFinding found = MustFind(Judged(options), PatternKind::kRadialK1);
  EXPECT_EQ(found.view, -1);
  ExpectValue(found, kK1_per_mm2);
}

TEST(JudgeResiduals, AdjustedParametersAreNotFoundAgain) {
  FitOptions options;
  options.synthetic.k1_per_mm2 = 1e-4;
  options.bundle.model.distortion[0] = true;
  EXPECT_EQ(Judged(options).kind, ResidualVerdict::Kind::kNoise);
}

TEST(JudgeResiduals, TelecentricityAndAspectAreNamed) {
  FitOptions options;
  options.truth = [](SyntheticArray& array) { array.lens.telecentricity_per_mm = 2e-4; };
  ExpectValue(MustFind(Judged(options), PatternKind::kTelecentricity), 2e-4);
  options.truth = [](SyntheticArray& array) { array.lens.aspect = 1.005; };
  ExpectValue(MustFind(Judged(options), PatternKind::kAspect), 5000);
}

TEST(JudgeResiduals, ABoardThatIsNotFlatIsNamed) {
  FitOptions options;
  options.truth = [](SyntheticArray& array) {
    array.shape.boards.resize(2);
    array.shape.boards[1].bow_x_mm = 0.002;
  };
  const PatternFinding found = MustFind(Judged(options), PatternKind::kBoardFlatness);
  EXPECT_EQ(found.board, 1);
  ExpectValue(found, 2);
}

TEST(JudgeResiduals, ADriftingViewIsNamedWithItsDrift) {
  FitOptions options;
  options.corners = [](SyntheticArray& array) {
    for (std::size_t image = 0; image < 18; ++image)
      ShiftCorners(array, image, 1, [&](const Eigen::Vector2d&) {
        return Eigen::Vector2d(0.1 * (static_cast<double>(image) / 17 - 0.5), 0);
      });
  };
  const PatternFinding found = MustFind(Judged(options), PatternKind::kViewDrift);
  EXPECT_EQ(found.view, 1);
  ExpectValue(found, 0.1);
}

TEST(JudgeResiduals, AViewThatWasKnockedLooksLikeADrift) {
  FitOptions options;
  options.corners = [](SyntheticArray& array) {
    for (std::size_t image = 9; image < 18; ++image)
      ShiftCorners(array, image, 2, [](const Eigen::Vector2d&) { return Eigen::Vector2d(0.1, 0); });
  };
  EXPECT_EQ(MustFind(Judged(options), PatternKind::kViewDrift).view, 2);
}

// Every corner of a board has the label of its neighbour; those of the last column are gone.
void MoveLabels(SyntheticArray& array, std::size_t board) {
  auto& corners = array.boards[board].corners;
  for (std::size_t row = 0; row < kRows; ++row)
    for (std::size_t column = 0; column < kColumns; ++column) {
      const std::size_t at = row * kColumns + column;
      corners[at] = column + 1 < kColumns ? corners[at + 1] : std::nullopt;
    }
}

TEST(JudgeResiduals, ABoardThatIsMislabelledByASquareIsNamed) {
  FitOptions options;
  options.corners = [](SyntheticArray& array) { MoveLabels(array, 4 * 5 + 3); };
  const ResidualVerdict verdict = Judged(options);
  const PatternFinding found = MustFind(verdict, PatternKind::kMislabelled);
  EXPECT_EQ(verdict.findings.size(), 1u);  // all else is in order
  EXPECT_EQ(found.image, 5);
  EXPECT_EQ(found.view, 3);
  EXPECT_FALSE(found.labels.turned);
  EXPECT_EQ(found.labels.columns, 1);
  EXPECT_EQ(found.labels.rows, 0);
  EXPECT_NEAR(found.labels.shift_px, 0.3 * 227.7, 4);  // one square
  // The pose is from the other boards: two of them 27.7 mm away fix its turn to 0.1 px / sqrt(234)
  // over their half width of 1.8 mm, so 0.1 px here, beside noise of 0.1 px; 4 sigma.
  EXPECT_LT(found.labels.rms_px, 0.1 + 4 * 0.1);
}

TEST(ExplainLeftOutBoards, NamesABoardThatTheCalibrationRejected) {
  testing_support::SyntheticOptions options;
  options.noise_px = 0.05;
  SyntheticArray array = testing_support::MakeSyntheticArray(options);
  MoveLabels(array, 4 * 5 + 3);
  const auto calibration = Calibrate(array.session, array.boards);
  ASSERT_TRUE(calibration.ok());
  ASSERT_EQ(calibration->data.boards.size(), 71u);
  const CalibrationData all = *CollectCalibrationData(array.session, array.boards);
  const auto findings = ExplainLeftOutBoards(all, calibration->data, calibration->bundle.state);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, PatternKind::kMislabelled);
  EXPECT_EQ(findings[0].name, "a mislabelled board (view B2, image board_2b.png)");
  EXPECT_EQ(findings[0].labels.columns, 1);
  // And without it the residuals are noise.
  EXPECT_EQ(JudgeResiduals(calibration->data, calibration->bundle.state).text,
            "The residuals are noise.");
}

TEST(JudgeResiduals, ABoardThatIsNumberedFromTheOtherEndIsNamed) {
  FitOptions options;
  options.corners = [](SyntheticArray& array) {
    auto& corners = array.boards[4 * 11].corners;
    std::reverse(corners.begin(), corners.end());
  };
  const PatternFinding found = MustFind(Judged(options), PatternKind::kMislabelled);
  EXPECT_EQ(found.image, 11);
  EXPECT_EQ(found.view, 0);
  EXPECT_TRUE(found.labels.turned);
  EXPECT_EQ(found.labels.columns, 0);
}

TEST(JudgeResiduals, ABoardThatIsOffByLessThanASquareDoesNotFit) {
  FitOptions options;
  options.corners = [](SyntheticArray& array) {
    ShiftCorners(array, 7, 2, [](const Eigen::Vector2d&) { return Eigen::Vector2d(0.3, -0.2); });
  };
  const PatternFinding found = MustFind(Judged(options), PatternKind::kBoardMisfit);
  EXPECT_EQ(found.image, 7);
  EXPECT_EQ(found.view, 2);
}

TEST(JudgeResiduals, AnImageInWhichTheTargetMovedIsNamed) {
  FitOptions options;
  options.corners = [](SyntheticArray& array) {
    for (std::size_t view = 0; view < 4; ++view)
      ShiftCorners(array, 9, view, [&](const Eigen::Vector2d& pixel) {
        const double tilt = 2e-4 * (view % 2 ? 1 : -1) * (pixel.y() - 900);
        return Eigen::Vector2d(view % 3 ? 0.5 : -0.5, tilt);
      });
  };
  const PatternFinding found = MustFind(Judged(options), PatternKind::kImageMisfit);
  EXPECT_EQ(found.image, 9);
  EXPECT_NE(found.name.find("board_4b.png"), std::string::npos);
}

TEST(JudgeResiduals, AnOldCalibrationOfAViewThatWasMovedIsNamed) {
  FittedArray fitted = FitArray({});
  fitted.state.array.views[3].offset_mm.x() += 0.001;
  const PatternFinding found = MustFind(fitted.Judge(), PatternKind::kViewOffset);
  EXPECT_EQ(found.view, 3);
  ExpectValue(found, -0.001 * 227.7);
}

TEST(JudgeResiduals, AWaveInOneViewIsAPatternOfUnknownCause) {
  FitOptions options;
  options.corners = [](SyntheticArray& array) {
    for (std::size_t image = 0; image < 18; ++image)
      ShiftCorners(array, image, 1, [](const Eigen::Vector2d& pixel) {
        return Eigen::Vector2d(0.06 * std::sin(pixel.x() / 50), 0);
      });
  };
  const PatternFinding found = MustFind(Judged(options), PatternKind::kUnknown);
  EXPECT_EQ(found.view, 1);
}

TEST(JudgeResiduals, LongTailsAreNoPattern) {
  FitOptions options;
  options.corners = [](SyntheticArray& array) {
    testing_support::Random random(5);
    for (std::size_t image = 0; image < 18; ++image)
      for (std::size_t view = 0; view < 4; ++view)
        ShiftCorners(array, image, view, [&](const Eigen::Vector2d&) {
          return random.Uniform(0, 1) < 0.03
                     ? Eigen::Vector2d(random.Normal(0.3), random.Normal(0.3))
                     : Eigen::Vector2d(0, 0);
        });
  };
  EXPECT_EQ(Judged(options).kind, ResidualVerdict::Kind::kNotNormal);
}

TEST(JudgeResiduals, ExactCornersAreNoise) {
  FitOptions options;
  options.synthetic.noise_px = 0;
  EXPECT_EQ(Judged(options).text, "The residuals are noise.");
}

}  // namespace
}  // namespace telestrain
