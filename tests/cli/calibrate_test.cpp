// What `calibrate` takes beside a session: corners from a file, an earlier calibration, what
// becomes of outliers, regions.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "base/files.h"
#include "cli/session_copy.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class CalibrateVerb : public SessionCopy {
 protected:
  ProgramRun Calibrate(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"calibrate", session().string(), "--out", results().string()};
    words.insert(words.end(), more.begin(), more.end());
    return RunTelestrain(words);
  }
  // The corners that the detector finds, as a file outside the results folder.
  fs::path CornersFile() const {
    TakeRun({"detect"});
    const fs::path file = scratch() / "given.vnl";
    fs::copy_file(results() / "corners.vnl", file);
    fs::remove_all(results());
    return file;
  }
};

TEST_F(CalibrateVerb, CornersFromAFileNeedNoImages) {
  const fs::path file = CornersFile();
  fs::remove_all(session() / "calibration");
  const ProgramRun run = Calibrate({"--corners", file.string()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(Holds(run.out, "40 of 40 board views used")) << run.out;
  const std::string json = ReadAll(results() / "calibration.json");
  EXPECT_TRUE(Holds(json, "\"corner_noise\": \"from the residuals\""));
  EXPECT_EQ(Run("verify").exit_code, 0);
}

TEST_F(CalibrateVerb, CornersOfAnotherPlaceAreBadInputWithTheLine) {
  const fs::path file = CornersFile();
  std::string text = ReadAll(file);
  const auto row = text.find("#B2 ");
  const auto end = text.find('\n', row);
  text.replace(row, end - row, "#B2 50.5 51.5 0");
  std::ofstream(file) << text;
  const ProgramRun run = Calibrate({"--corners", file.string()});
  EXPECT_EQ(run.exit_code, 3) << run.out;
  EXPECT_TRUE(Holds(run.err, "(50.50, 51.50)")) << run.err;
  EXPECT_TRUE(Holds(run.err, "outside region_px")) << run.err;
}

TEST_F(CalibrateVerb, TheResultsOwnCornersAreNotGivenToItself) {
  TakeRun({"detect"});
  const ProgramRun run = Calibrate({"--corners", (results() / "corners.vnl").string()});
  EXPECT_EQ(run.exit_code, 2) << run.out;
  EXPECT_TRUE(fs::exists(results() / "corners.vnl"));
}

TEST_F(CalibrateVerb, ComparedWithItselfNothingMoved) {
  TakeRun({"detect", "calibrate"});
  const fs::path old_file = results() / "calibration.json";
  const std::string hash = Sha256Hex(ReadAll(old_file));
  const ProgramRun run = Calibrate({"--compare", old_file.string()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(Holds(run.out, "nothing moved beyond chance")) << run.out;
  EXPECT_TRUE(Holds(ReadAll(results() / "comparison.json"), hash));
}

TEST_F(CalibrateVerb, AnEarlierCalibrationThatIsMissingLeavesTheResultsAlone) {
  TakeRun({"detect", "calibrate"});
  const auto before = BytesBelow(results());
  EXPECT_EQ(Calibrate({"--compare", (scratch() / "none.json").string()}).exit_code, 3);
  EXPECT_EQ(BytesBelow(results()), before);
}

TEST_F(CalibrateVerb, WeighingKeepsEveryCorner) {
  TakeRun({"detect"});
  const ProgramRun run = Calibrate({"--outliers", "weigh"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(Holds(ReadAll(results() / "calibration.json"), "weighed down (Cauchy)"));
}

TEST_F(CalibrateVerb, RunTakesTheSameChoices) {
  TakeRun({"detect", "calibrate"});
  const fs::path old_file = scratch() / "earlier.json";
  fs::copy_file(results() / "calibration.json", old_file);
  const ProgramRun run = RunTelestrain({"run", session().string(), "--out", results().string(),
                                        "--outliers", "weigh", "--compare", old_file.string()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(Holds(ReadAll(results() / "calibration.json"), "weighed down (Cauchy)"));
  EXPECT_TRUE(fs::exists(results() / "comparison.json"));
}

TEST_F(CalibrateVerb, CulledRegionsAreLeftOutAndListed) {
  TakeRun({"detect"});
  const ProgramRun run =
      Calibrate({"--cull", "0,0,160,486", "--outliers", "mrcal", "--board-warp"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string json = ReadAll(results() / "calibration.json");
  EXPECT_TRUE(Holds(json, "inside a culled region"));
  EXPECT_TRUE(Holds(json, "removed (mrcal's rule)"));
  EXPECT_TRUE(Holds(json, "\"bow_is_estimated\": true"));
  std::istringstream rows(ReadAll(results() / "residuals.csv"));
  std::string row;
  std::getline(rows, row);
  while (std::getline(rows, row)) {
    std::size_t at = 0;
    for (int comma = 0; comma < 4; ++comma) at = row.find(',', at) + 1;
    EXPECT_GE(std::stod(row.substr(at)), 159.5) << row;
  }
}

TEST_F(CalibrateVerb, ARegionThatIsNoneIsWrongUsage) {
  TakeRun({"detect"});
  for (const char* region : {"0,0,160", "0,0,160,486,7", "0,0,160,wide", "0,0,0,486"}) {
    const ProgramRun run = Calibrate({"--cull", region});
    EXPECT_EQ(run.exit_code, 2) << region << run.out;
    EXPECT_TRUE(Holds(run.err, "X,Y,WIDTH,HEIGHT")) << region << run.err;
  }
}

}  // namespace
}  // namespace telestrain::testing_support
