// What `telestrain run` finds against what the simulation knows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/csv.h"
#include "base/numbers.h"
#include "integration/small_run.h"
#include "target/corners_file.h"

namespace telestrain::testing_support {
namespace {

using Json = nlohmann::json;

class RunAccuracy : public SmallRun {
 protected:
  static std::vector<BoardObservation> Boards() {
    auto boards = ReadCornersVnl(Results() / "corners.vnl", 13 * 9);
    EXPECT_TRUE(boards.ok()) << boards.error().message;
    return std::move(boards).value();
  }
  // The true board of an observation.
  static const Json& TrueBoard(const BoardObservation& found) {
    for (const Json& pose : Truth().at("poses"))
      for (const Json& board : pose.at("boards"))
        if (pose.at("image") == found.image && board.at("view") == found.view) return board;
    throw std::out_of_range(found.image + " " + found.view);
  }
  static double MeanSquareCornerError_px2(int& scalars);
};

double RunAccuracy::MeanSquareCornerError_px2(int& scalars) {
  double sum = 0;
  scalars = 0;
  for (const BoardObservation& board : Boards())
    for (std::size_t i = 0; i < board.corners.size(); ++i) {
      if (!board.corners[i]) continue;
      const Json& true_px = TrueBoard(board).at("corners_px").at(i);
      for (int axis = 0; axis < 2; ++axis, ++scalars)
        sum += std::pow(board.corners[i]->pixel(axis) - true_px.at(axis).get<double>(), 2);
    }
  return sum / scalars;
}

// A board that is cut off gives the corners that are left; a wrong label would be 17 px off and
// show in the errors below.
TEST_F(RunAccuracy, EveryBoardIsFoundAndWhollySoWhenItIsWhollyInside) {
  int whole = 0, corners = 0;
  for (const BoardObservation& board : Boards()) {
    EXPECT_EQ(board.rejected_because, "") << board.image << board.view;
    const auto seen = std::count_if(board.corners.begin(), board.corners.end(),
                                    [](const auto& corner) { return corner.has_value(); });
    EXPECT_EQ(seen == 117, TrueBoard(board).at("all_inside").get<bool>())
        << board.image << board.view;
    EXPECT_GE(seen, 13 * 8) << board.image << board.view;  // one row is cut off
    whole += seen == 117;
    corners += static_cast<int>(seen);
  }
  EXPECT_EQ(whole, 39);
  EXPECT_EQ(ResultJson("calibration.json").at("reprojection").at("corners_used"), corners);
}

TEST_F(RunAccuracy, CornersAreAsPreciseAsTheNoiseAllows) {
  int scalars = 0;
  const double rms_px = std::sqrt(MeanSquareCornerError_px2(scalars));
  // An edge of half contrast A and blur s carries 2 A^2 / (sqrt(pi) s) of information per pixel of
  // its length over noise^2 (the integral of its squared gradient). A corner that uses half a
  // square to both sides together, without the blur on both sides of the crossing, must reach
  // noise / (A sqrt(2 L / (sqrt(pi) s))): 0.0057 px here.
  const double noise_gray = Truth().at("options").at("noise_gray");
  const double s_px = Truth().at("blur_sigma_px");
  const double half_contrast_gray = 95;                    // squares of 30 and 220 grey
  const double square_px = 57 * 0.3 * std::cos(M_PI / 6);  // the side that the view foreshortens
  const double length_px = square_px / 2 - 2 * s_px;
  const double bound_px =
      noise_gray / (half_contrast_gray * std::sqrt(2 * length_px / (std::sqrt(M_PI) * s_px)));
  EXPECT_LT(rms_px, bound_px);
  EXPECT_GT(rms_px, bound_px / 2);  // four times the edge length does not exist
}

TEST_F(RunAccuracy, StatedCornerCovariancesAreThoseOfTheErrors) {
  const auto table = ReadCsv(Results() / "corner_covariances.csv");
  ASSERT_TRUE(table.ok()) << table.error().message;
  double stated_px2 = 0;
  for (const CsvTable::Row& row : table->rows)
    stated_px2 += (*ParseDouble(row.cells.at(4)) + *ParseDouble(row.cells.at(6))) / 2;
  stated_px2 /= static_cast<double>(table->rows.size());
  int scalars = 0;
  const double found_px2 = MeanSquareCornerError_px2(scalars);
  // The mean square of n normal errors scatters by sqrt(2 / n); neighbouring corners share pixels,
  // at most two in each direction, so that n / 4 are independent: 4 sigma.
  EXPECT_NEAR(found_px2 / stated_px2, 1, 4 * std::sqrt(2.0 / (scalars / 4.0)));
}

TEST_F(RunAccuracy, TheReprojectionErrorIsTheNoiseLessTheFittedParameters) {
  const Json reprojection = ResultJson("calibration.json").at("reprojection");
  int scalars = 0;
  const double noise_px = std::sqrt(MeanSquareCornerError_px2(scalars));
  // A fit of p parameters takes chi2(p) / n of the mean square: p, 4 sigma = 4 sqrt(2 p) more.
  // 22 of the array, 6 per pose but the fixed one, 2 of the stage.
  const double p = 22 + 6 * 9 + 2;
  const double rms_px = reprojection.at("rms_px");
  EXPECT_LT(rms_px, noise_px);
  EXPECT_GT(rms_px, noise_px * std::sqrt(1 - (p + 4 * std::sqrt(2 * p)) / scalars));
  // A root mean square of m independent errors scatters by 1 / sqrt(2 m); m is n / 4 as above.
  const double expected_px = reprojection.at("expected_rms_px");
  EXPECT_NEAR(rms_px / expected_px, 1, 4 / std::sqrt(2 * scalars / 4.0));
}

TEST_F(RunAccuracy, MagnificationAndDistortionLieWithinFourSigma) {
  const Json calibration = ResultJson("calibration.json");
  const Json &lens = calibration.at("lens"), &truth = Truth().at("lens");
  EXPECT_NEAR(lens.at("magnification_px_per_mm").get<double>(),
              truth.at("magnification_px_per_mm").get<double>(),
              4 * lens.at("sigma_magnification_px_per_mm").get<double>());
  const Json& covariance = calibration.at("covariance");
  ASSERT_EQ(covariance.at("parameters").at(1), "k1_per_mm2");
  EXPECT_NEAR(lens.at("distortion").at("k1_per_mm2").get<double>(),
              truth.at("distortion").at("k1_per_mm2").get<double>(),
              4 * std::sqrt(covariance.at("matrix").at(1).at(1).get<double>()));
}

TEST_F(RunAccuracy, RulerErrorsLieWithinFourStandardUncertainties) {
  const Json ruler = ResultJson("ruler.json");
  double variance_um2 = 0, certificates_um2 = 0;
  for (const Json& line : ruler.at("budget")) {
    const std::string source = line.at("source");
    const double u = line.at("standard_uncertainty_um");
    (source == "cross positions" || source == "calibration" ? variance_um2 : certificates_um2) +=
        u * u;
  }
  const double true_mm = Truth().at("ruler").at("length_mm");
  ASSERT_EQ(ruler.at("images").size(), 3u);
  for (const Json& image : ruler.at("images")) {
    const double u = image.at("standard_uncertainty_um");
    const double error_um = 1000 * (image.at("length_mm").get<double>() - true_mm);
    EXPECT_LT(std::abs(error_um), 4 * u) << image.at("image");
    // Target and ruler are made exactly as certified here, so only the images' part is left.
    EXPECT_LT(std::abs(error_um), 4 * std::sqrt(variance_um2)) << image.at("image");
    EXPECT_NEAR(u * u, variance_um2 + certificates_um2, 0.05 * u * u);  // the budget is the mean
  }
}

TEST_F(RunAccuracy, StrainLiesWithinFourStandardUncertainties) {
  const Json states = ResultJson("strain.json").at("states");
  ASSERT_EQ(states.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& truth = Truth().at("pipe").at(i);
    const auto error = [&](const char* key) {
      return states[i].at(key).get<double>() - truth.at(key).get<double>();
    };
    EXPECT_LT(std::abs(error("axial_microstrain")),
              4 * states[i].at("standard_uncertainty_microstrain").get<double>());
    const double local = states[i].at("local_sigma_microstrain");
    EXPECT_LT(std::abs(error("local_a_microstrain")), 4 * local);
    EXPECT_LT(std::abs(error("local_b_microstrain")), 4 * local);
  }
}

// Noise of 1.5 grey moves a subset of 15 x 15 px by a few hundredths of a pixel of 17.6 um at the
// worst, and about 230 subsets in each group average it: 0.03 px 17.6 um sqrt(2) / sqrt(230) /
// 27.7 mm is 1.8 microstrain. A stated uncertainty above that would make the check above empty.
TEST_F(RunAccuracy, TheStatedStrainUncertaintyIsSmallEnoughToMeanSomething) {
  const Json states = ResultJson("strain.json").at("states");
  for (const Json& state : states)
    EXPECT_LT(state.at("standard_uncertainty_microstrain").get<double>(),
              1e6 * 0.03 * 0.0176 * std::sqrt(2.0 / 230) / 27.7);
}

TEST_F(RunAccuracy, ThePipeIsMeasuredWithinFourSigmaOfItsDiameter) {
  const Json pipe = ResultJson("strain.json").at("pipe");
  EXPECT_NEAR(pipe.at("diameter_mm").get<double>(), 8.0,
              4 * pipe.at("sigma_diameter_mm").get<double>());
}

}  // namespace
}  // namespace telestrain::testing_support
