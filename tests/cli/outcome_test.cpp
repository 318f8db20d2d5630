// Exit codes 1, 4 and 5, and what is shown while a command works.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "cli/session_copy.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;
using Outcome = SessionCopy;

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Outcome, ALimitThatIsNotMetGivesOneAndAReport) {
  Replace("session.toml", "reprojection_rms_px = 0.1", "reprojection_rms_px = 0.0001");
  Remove("pipe.csv");
  MustRun({"detect", "calibrate", "verify"});
  const ProgramRun run = RunTelestrain({"report", results().string()});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_TRUE(Holds(run.out, "verdict    fail")) << run.out;
  EXPECT_TRUE(ReadAll(results() / "report.pdf").starts_with("%PDF-"));
  EXPECT_TRUE(Holds(ReadAll(results() / "results.json"), "\"verdict\": \"fail\""));
}

TEST_F(Outcome, ALimitThatCannotBeDecidedDoesNotPass) {
  for (const char* image : {"ruler/ruler_001.png", "ruler/ruler_002.png", "ruler/ruler_003.png"})
    MakeBlank(image);
  Remove("pipe.csv");
  Replace("session.toml", "strain_error_microstrain = 20.0\n", "");
  MustRun({"detect", "calibrate", "verify"});
  const ProgramRun run = RunTelestrain({"report", results().string()});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_TRUE(Holds(run.out, "verdict    undecided")) << run.out;
}

TEST_F(Outcome, TooFewImagesAreAnEstimationThatFailed) {
  KeepLines("calibration.csv", 3);
  const ProgramRun run = Run("run");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_TRUE(Holds(run.err, "only 2 calibration images")) << run.err;
  EXPECT_TRUE(Holds(run.err, "at least 3")) << run.err;
  EXPECT_FALSE(fs::exists(results() / "calibration.json"));
}

TEST_F(Outcome, APipeThatCannotBeFollowedIsAnEstimationThatFailed) {
  MakeBlank("pipe/pipe_001.png");
  MustRun({"detect", "calibrate"});
  const ProgramRun run = Run("measure");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_TRUE(Holds(run.err, "pipe/pipe_001.png")) << run.err;
  // The reference before it stays, the results of all states are not made.
  EXPECT_TRUE(Holds(ReadAll(results() / "strain.csv"), "pipe/pipe_000.png"));
  EXPECT_FALSE(Holds(ReadAll(results() / "strain.csv"), "pipe/pipe_001.png"));
  EXPECT_FALSE(fs::exists(results() / "strain.json"));
}

TEST_F(Outcome, APipeThatIsNotThereIsAnEstimationThatFailed) {
  MakeBlank("pipe/pipe_000.png");
  MustRun({"detect", "calibrate"});
  const ProgramRun run = Run("measure");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_TRUE(Holds(run.err, "speckled")) << run.err;
  EXPECT_FALSE(fs::exists(results() / "strain.csv"));
}

TEST_F(Outcome, AFileInTheWayOfTheResultsIsAFailedOutput) {
  std::ofstream(results()) << "a file\n";
  for (const fs::path& out : {results(), results() / "below"}) {
    const ProgramRun run = RunTelestrain({"run", session().string(), "--out", out.string()});
    EXPECT_EQ(run.exit_code, 5) << run.err;
    EXPECT_TRUE(Holds(run.err, out.string() + ": cannot be made a folder")) << run.err;
  }
  EXPECT_EQ(ReadAll(results()), "a file\n");
}

TEST_F(Outcome, AFolderThatCannotBeWrittenIsAFailedOutput) {
  const ProgramRun run = RunTelestrain({"run", session().string(), "--out", "/proc/telestrain"});
  EXPECT_EQ(run.exit_code, 5) << run.err;
  EXPECT_TRUE(Holds(run.err, "/proc/telestrain")) << run.err;
}

TEST_F(Outcome, AReadOnlyResultsFolderIsAFailedOutput) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere";
  fs::create_directory(results());
  fs::permissions(results(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(Run("run").exit_code, 5);
  fs::permissions(results(), fs::perms::owner_all);
}

TEST_F(Outcome, AFolderInPlaceOfTheReportIsAFailedOutput) {
  Remove("pipe.csv");
  MustRun({"detect", "calibrate", "verify"});
  fs::create_directories(results() / "report.pdf/below");
  const ProgramRun run = RunTelestrain({"report", results().string()});
  EXPECT_EQ(run.exit_code, 5) << run.err;
  EXPECT_TRUE(Holds(run.err, "report.pdf")) << run.err;
}

TEST_F(Outcome, ResultsGoToStdoutAndNoProgressBarIsDrawnIntoAFile) {
  const ProgramRun run = Run("detect");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(run.out.starts_with("detect     40 of 40 board views used")) << run.out;
  EXPECT_FALSE(Holds(run.err, "not used")) << run.err;
  for (const char sign : {'\r', '\x1b', '#'}) {
    EXPECT_EQ(run.err.find(sign), std::string::npos);
    EXPECT_EQ(run.out.find(sign), std::string::npos);
  }
}

TEST_F(Outcome, AProgressBarIsDrawnOnATerminal) {
  const std::string script = TELESTRAIN_SCRIPT_PROGRAM;
  if (script.empty()) GTEST_SKIP() << "script (bsdutils) is not installed";
  const std::string command = "'" + TelestrainPath().string() + "' detect '" + session().string() +
                              "' --out '" + results().string() + "'";
  if (RunProgram({script, "-qec", "true", "/dev/null"}).exit_code != 0)
    GTEST_SKIP() << "this machine gives no pseudo-terminal (script -qec true fails)";
  const ProgramRun run = RunProgram({script, "-qec", command, "/dev/null"});
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_TRUE(Holds(run.out, "\rdetecting [") || Holds(run.out, "\x1b[Kdetecting [")) << run.out;
  EXPECT_TRUE(Holds(run.out, "] 13/13")) << run.out;
}

}  // namespace
}  // namespace telestrain::testing_support
