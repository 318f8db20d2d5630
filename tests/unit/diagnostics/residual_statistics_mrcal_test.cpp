// Our residual statistics against mrcal's own Python tools on a pinhole problem that mrcal solved.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "diagnostics/residual_statistics.h"

namespace telestrain {
namespace {

using Json = nlohmann::ordered_json;

// Both sum the same doubles in another order: some thousand roundings of 1e-16 of values near 1 px.
constexpr double kRounding = 1e-12;

// What the script of the same folder writes; null where mrcal is not installed or does not run.
const Json& Reference() {
  static const Json reference = [] {
    if (std::system("/usr/bin/python3 -c 'import mrcal' >/dev/null 2>&1") != 0) return Json();
    const auto path = std::filesystem::path(testing::TempDir()) /
                      ("mrcal_residuals_" + std::to_string(::getpid()) + ".json");
    const std::string script =
        TELESTRAIN_SOURCE_DIR "/tests/unit/diagnostics/residual_mrcal_reference.py";
    const std::string command =
        "/usr/bin/python3 '" + script + "' '" + path.string() + "' >/dev/null 2>&1";
    Json read = Json::object();
    if (std::system(command.c_str()) == 0) read = Json::parse(*ReadFile(path, kMostResultBytes));
    std::filesystem::remove(path);
    return read;
  }();
  return reference;
}

ResidualList Read(const Json& state) {
  const Json& all = Reference();
  const auto grid = all["columns"].get<std::size_t>() * all["rows"].get<std::size_t>();
  const auto x = state["x_px"].get<std::vector<double>>();
  const auto observed = all["observed_px"].get<std::vector<double>>();
  ResidualList residuals;
  for (std::size_t i = 0; 2 * i < x.size(); ++i) {
    CornerResidual r{all["frame"][i / grid].get<int>(), all["camera"][i / grid].get<int>(), 0,
                     static_cast<int>(i % grid)};
    r.observed_px = {observed[2 * i], observed[2 * i + 1]};
    r.residual_px = {-x[2 * i], -x[2 * i + 1]};  // mrcal: predicted minus measured
    r.is_outlier = state["outlier"][i].get<int>() != 0;
    residuals.push_back(r);
  }
  return residuals;
}

void ExpectSame(const std::vector<double>& ours, const Json& theirs, double sign = 1) {
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i)
    EXPECT_NEAR(sign * ours[i], theirs[i].get<double>(), kRounding) << i;
}

void ExpectRmsSigmaAndWorstPointAgree() {
  const ResidualSummary summary = Summarise(Read(Reference()["last"]));
  EXPECT_EQ(summary.outliers, Reference()["outliers"].get<int>());
  EXPECT_GT(summary.outliers, 20);
  EXPECT_NEAR(summary.rms_per_scalar_px, Reference()["rms_reproj_error__pixels"].get<double>(),
              kRounding);
  EXPECT_NEAR(summary.sigma_px, Reference()["observed_pixel_uncertainty"].get<double>(), kRounding);
  EXPECT_NEAR(summary.worst_corner_px, Reference()["worst_point_px"].get<double>(), kRounding);
}

void ExpectBoardsAndTheirOrderAgree() {
  const auto boards = BoardsFromWorst(Read(Reference()["last"]));
  ASSERT_EQ(boards.size(), Reference()["worst_first"].size());
  for (std::size_t i = 0; i < boards.size(); ++i) {
    const auto index = Reference()["worst_first"][i].get<std::size_t>();
    EXPECT_EQ(boards[i].image, Reference()["frame"][index].get<int>());
    EXPECT_EQ(boards[i].view, Reference()["camera"][index].get<int>());
    EXPECT_NEAR(boards[i].rms_per_corner_px, Reference()["rms_per_board_px"][index].get<double>(),
                kRounding);
  }
}

void ExpectRegionsAgree() {
  const PixelRegion imager{0, 0, Reference()["width"].get<int>(), Reference()["height"].get<int>()};
  for (int view = 0; view < 2; ++view) {
    const Json& theirs = Reference()["cameras"][static_cast<std::size_t>(view)];
    const RegionalMap ours = RegionalStatistics(OfView(Read(Reference()["last"]), view), imager);
    EXPECT_EQ(ours.columns, theirs["columns"].get<int>());
    EXPECT_EQ(ours.rows, theirs["rows"].get<int>());
    EXPECT_EQ(ours.scalars, theirs["scalars"].get<std::vector<int>>());
    ExpectSame(ours.mean_px, theirs["mean_px"], -1);
    ExpectSame(ours.sd_px, theirs["sd_px"]);
  }
}

void ExpectHistogramsAndTheirCurvesAgree() {
  for (int view = 0; view < 2; ++view) {
    const Json& theirs = Reference()["cameras"][static_cast<std::size_t>(view)];
    ResidualList residuals = OfView(Read(Reference()["last"]), view);
    for (CornerResidual& r : residuals) r.residual_px *= -1;  // bins are of mrcal's x
    const ResidualHistogram ours = HistogramOfResiduals(residuals);
    EXPECT_EQ(ours.first_bin, theirs["first_bin"].get<int>());
    EXPECT_EQ(ours.counts, theirs["counts"].get<std::vector<int>>());
    EXPECT_NEAR(ours.sigma_px, theirs["sigma_px"].get<double>(), kRounding);
    for (const Json& point : theirs["curve"])
      // mrcal writes the curve with the digits of a double; counts are near 100.
      EXPECT_NEAR(ours.Gaussian(point[0].get<double>()), point[1].get<double>(), 100 * kRounding);
  }
}

void ExpectMagnitudesAndDirectionsAgree() {
  for (int view = 0; view < 2; ++view) {
    const Json& theirs = Reference()["cameras"][static_cast<std::size_t>(view)];
    std::vector<double> magnitudes_px, directions_deg;
    for (CornerResidual r : OfView(Read(Reference()["last"]), view)) {
      if (r.is_outlier) continue;
      r.residual_px *= -1;
      magnitudes_px.push_back(Magnitude_px(r));
      directions_deg.push_back(Direction_rad(r) * 57.29577951308232);
    }
    ExpectSame(magnitudes_px, theirs["magnitude_px"]);
    ExpectSame(directions_deg, theirs["direction_deg"]);
  }
}

void ExpectEveryPassOfTheOutlierRuleMarksTheSameCorners() {
  const Json& passes = Reference()["passes"];
  ASSERT_GE(passes.size(), 3u);  // large mistakes first, then what they hid
  for (std::size_t p = 0; p < passes.size(); ++p) {
    ResidualList residuals = Read(passes[p]);
    const OutlierPass pass = MarkOutliers(residuals);
    for (const std::size_t i : pass.marked) residuals[i].is_outlier = true;
    // mrcal's own set after its last pass.
    const Json& next = p + 1 < passes.size() ? passes[p + 1] : Reference()["last"];
    for (std::size_t i = 0; i < residuals.size(); ++i)
      ASSERT_EQ(residuals[i].is_outlier, next["outlier"][i].get<int>() != 0) << p << " " << i;
  }
  EXPECT_TRUE(MarkOutliers(Read(Reference()["last"])).marked.empty());
}

// One test, as ctest runs every test as a program of its own and mrcal solves only once then.
TEST(ResidualStatisticsAgainstMrcal, EveryFigureAgrees) {
  if (Reference().is_null()) GTEST_SKIP() << "python3-mrcal is not there: import mrcal failed";
  ASSERT_FALSE(Reference().empty()) << "the reference script failed";
  ExpectRmsSigmaAndWorstPointAgree();
  ExpectBoardsAndTheirOrderAgree();
  ExpectRegionsAgree();
  ExpectHistogramsAndTheirCurvesAgree();
  ExpectMagnitudesAndDirectionsAgree();
  ExpectEveryPassOfTheOutlierRuleMarksTheSameCorners();
}

}  // namespace
}  // namespace telestrain
