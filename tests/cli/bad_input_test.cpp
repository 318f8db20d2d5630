// Exit code 3: the message names the place and the remedy, and nothing is written.
#include <gtest/gtest.h>

#include "cli/session_copy.h"

namespace telestrain::testing_support {
namespace {

using BadInput = SessionCopy;

TEST_F(BadInput, AMissingFolder) {
  std::filesystem::remove_all(session());
  ExpectBadInput({"session.toml: does not exist", "give a session folder"});
}

TEST_F(BadInput, AnUnknownKeyIsNamedWithItsLineAndTheNearestKey) {
  Replace("session.toml", "pixel_pitch_um", "pixel_pich_um");
  ExpectBadInput({"session.toml:10: ", "'pixel_pich_um'", "'pixel_pitch_um'", "rename or remove"});
}

TEST_F(BadInput, AMissingImageIsNamedWithTheLineOfItsTable) {
  Remove("ruler/ruler_002.png");
  ExpectBadInput({"ruler.csv:3: ", "'ruler/ruler_002.png'", "copy it there"});
}

TEST_F(BadInput, AnImageOfAnotherSizeIsNamedWithBothSizes) {
  MakeBlank("ruler/ruler_002.png", 200, 100);
  ExpectBadInput({"ruler/ruler_002.png: ", "200 x 100 px", "648 x 486 px"});
}

TEST_F(BadInput, AnImageCutShortIsNamedBeforeAnythingIsWritten) {
  for (const std::string file : {"pipe/pipe_002.png", "calibration/pose_004_stage_1.png"}) {
    KeepBytes(file, 90000);
    ExpectBadInput({file + ": ", "breaks off", "copy it again"});
    std::filesystem::copy_file(SmallSession() / file, session() / file,
                               std::filesystem::copy_options::overwrite_existing);
  }
}

TEST_F(BadInput, ARulerThatIsACopyOfACalibrationImageIsNamedWithIt) {
  std::filesystem::copy_file(session() / "calibration/pose_004_stage_1.png",
                             session() / "ruler/ruler_002.png",
                             std::filesystem::copy_options::overwrite_existing);
  ExpectBadInput({"ruler.csv: ", "'ruler/ruler_002.png'", "'calibration/pose_004_stage_1.png'",
                  "remove it from one of the tables"});
}

TEST_F(BadInput, AnEmptyImageIsNamed) {
  KeepBytes("ruler/ruler_001.png", 0);
  ExpectBadInput({"ruler/ruler_001.png: ", "empty", "PNG"});
}

TEST_F(BadInput, AMalformedNumberOfATableIsNamedWithItsLine) {
  Replace("calibration.csv", "pose_003_stage_1.png,P003,1", "pose_003_stage_1.png,P003,1mm");
  ExpectBadInput({"calibration.csv:7: ", "'stage_mm'", "'1mm'", "correct it"});
}

TEST_F(BadInput, AMalformedNumberOfTheDescriptionIsNamedWithItsLine) {
  Replace("session.toml", "length_mm = 27.6", "length_mm = 27,6");
  ExpectBadInput({"session.toml:73: ", "correct this line"});
}

TEST_F(BadInput, AValueOfTheWrongKindIsNamedWithItsLine) {
  Replace("session.toml", "width_px = 648", "width_px = \"wide\"");
  ExpectBadInput({"session.toml:8: ", "'wide'", "whole number", "correct the value"});
}

TEST_F(BadInput, LeavesEarlierResultsAsTheyAre) {
  TakeRun({"detect"});
  const auto before = BytesBelow(results());
  KeepBytes("ruler/ruler_002.png", 90000);
  EXPECT_EQ(Run("run").exit_code, 3);
  EXPECT_EQ(BytesBelow(results()), before);
}

TEST_F(BadInput, ResultsOfAnotherSessionAreStale) {
  TakeRun({"detect"});
  const auto before = BytesBelow(results());
  Replace("session.toml", "sigma_mm = 0.005", "sigma_mm = 0.006");
  for (const std::string verb : {"calibrate", "verify", "measure"}) {
    const ProgramRun run = Run(verb);
    EXPECT_EQ(run.exit_code, 3) << verb;
    EXPECT_NE(run.err.find("was made from another session.toml"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("run 'telestrain detect' again"), std::string::npos) << run.err;
  }
  EXPECT_EQ(BytesBelow(results()), before);
}

TEST_F(BadInput, ResultsOfAnotherImageAreStale) {
  TakeRun({"detect", "calibrate"});
  MakeBlank("pipe/pipe_001.png");
  for (const std::string verb : {"calibrate", "measure"}) {
    const ProgramRun run = Run(verb);
    EXPECT_EQ(run.exit_code, 3) << verb;
    EXPECT_NE(run.err.find("was made from another pipe/pipe_001.png"), std::string::npos)
        << run.err;
  }
}

TEST_F(BadInput, AStepWithoutTheStepBeforeSaysWhichOneIsMissing) {
  const ProgramRun early = Run("calibrate");
  EXPECT_EQ(early.exit_code, 3);
  EXPECT_NE(early.err.find("run 'telestrain detect' first"), std::string::npos) << early.err;
  EXPECT_FALSE(std::filesystem::exists(results()));
  TakeRun({"detect"});
  for (const std::string verb : {"verify", "measure"}) {
    const ProgramRun run = Run(verb);
    EXPECT_EQ(run.exit_code, 3) << verb;
    EXPECT_NE(run.err.find("telestrain calibrate"), std::string::npos) << run.err;
  }
  for (const std::string verb : {"render", "report", "review"}) {
    const ProgramRun run = RunTelestrain({verb, (scratch() / "nowhere").string()});
    EXPECT_EQ(run.exit_code, 3) << verb;
    EXPECT_NE(run.err.find("does not exist"), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace telestrain::testing_support
