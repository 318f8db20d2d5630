// `diagnose RESULTS` on screen and in the folder.
#include <gtest/gtest.h>

#include "base/files.h"
#include "cli/session_copy.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

class DiagnoseVerb : public SessionCopy {
 protected:
  ProgramRun Diagnose() const { return RunTelestrain({"diagnose", results().string()}); }
};

TEST_F(DiagnoseVerb, SaysTheVerdictAndEveryCheckAndRepeatsItsBytes) {
  TakeRun({"detect", "calibrate"});
  const ProgramRun run = Diagnose();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* part :
       {"The residuals are noise.", "mrcal's optimum, undistorted model", "agrees",
        "mrcal's projection, our solution", "Moran's I", "pinhole at 10 m"})
    EXPECT_NE(run.out.find(part), std::string::npos) << part << " in\n" << run.out;
  EXPECT_EQ(run.out.find("DISAGREES"), std::string::npos) << run.out;
  const std::string bytes = ReadAll(results() / "mrcal.json");
  ASSERT_EQ(Diagnose().exit_code, 0);
  EXPECT_EQ(ReadAll(results() / "mrcal.json"), bytes);
}

TEST_F(DiagnoseVerb, WithoutACalibrationItSaysWhatToRun) {
  TakeRun({"detect"});
  const ProgramRun run = Diagnose();
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("telestrain calibrate"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(results() / "mrcal.json"));
}

TEST_F(DiagnoseVerb, ANewCalibrationTakesTheOldDiagnosisAway) {
  TakeRun({"detect", "calibrate"});
  ASSERT_EQ(Diagnose().exit_code, 0);
  MustRun({"calibrate"});
  EXPECT_FALSE(fs::exists(results() / "mrcal.json"));
}

}  // namespace
}  // namespace telestrain::testing_support
