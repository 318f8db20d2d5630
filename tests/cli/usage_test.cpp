#include <gtest/gtest.h>

#include "cli/session_copy.h"

namespace telestrain::testing_support {
namespace {

const std::vector<std::string> kVerbs = {"run",     "detect", "calibrate", "verify",
                                         "measure", "render", "report",    "simulate",
                                         "design",  "study",  "correlate", "review"};

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void ExpectUsageError(const std::vector<std::string>& arguments, const std::string& part) {
  const ProgramRun run = RunTelestrain(arguments);
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(Holds(run.err, part)) << "wanted: " << part << "\nis: " << run.err;
}

TEST(Usage, NoVerbIsAnErrorThatPointsToTheHelp) { ExpectUsageError({}, "--help"); }

TEST(Usage, AnUnknownVerbIsNamedWithTheNearestKnownOne) {
  ExpectUsageError({"calibrte", "session"}, "unknown verb 'calibrte'");
  ExpectUsageError({"calibrte", "session"}, "'calibrate'");
  ExpectUsageError({"--threads", "2", "calibrte"}, "unknown verb 'calibrte'");
  ExpectUsageError({"audit", "vrify", "results"}, "the nearest verb is 'verify'");
}

TEST(Usage, AnUnknownOptionIsNamed) {
  ExpectUsageError({"run", "session", "--out", "results", "--colour"}, "--colour");
  ExpectUsageError({"--colour"}, "unknown option '--colour'");
  ExpectUsageError({"run", "session", "--ot", "results"},
                   "telestrain run: unknown option '--ot'; the nearest option is '--out'");
  ExpectUsageError({"run", "--hepl"}, "'--help'");
  ExpectUsageError({"--verison"}, "'--version'");
}

TEST(Usage, AMissingArgumentIsNamed) {
  for (const std::string verb : {"run", "detect", "calibrate", "verify", "measure"}) {
    ExpectUsageError({verb, "--out", "results"}, "telestrain " + verb + ": SESSION is required");
    ExpectUsageError({verb, "session"}, "telestrain " + verb + ": --out is required");
    ExpectUsageError({verb, "session"}, "\nRun 'telestrain " + verb + " --help'");
  }
  for (const std::string verb : {"render", "report", "review"}) ExpectUsageError({verb}, "RESULTS");
  ExpectUsageError({"simulate"}, "--out");
}

TEST(Usage, AnOptionOutsideItsRangeIsAnErrorWithTheRange) {
  ExpectUsageError({"simulate", "--out", "session", "--noise-gray", "99"}, "0 to 20 gray");
  ExpectUsageError({"simulate", "--out", "session", "--binning", "two"}, "--binning");
  ExpectUsageError({"simulate", "--out", "session", "--document", "date"}, "KEY=TEXT");
  ExpectUsageError({"simulate", "--out", "session", "--document", "date=2026-02-30"}, "ISO 8601");
  EXPECT_FALSE(std::filesystem::exists("session"));
}

TEST(Usage, ThreadsAndVectorsOfTheProgramAreChecked) {
  ExpectUsageError({"--threads", "0", "simulate", "--out", "session"}, "--threads");
  ExpectUsageError({"--threads", "257", "simulate", "--out", "session"}, "--threads");
  ExpectUsageError({"--vector", "sse", "simulate", "--out", "session"}, "--vector");
  const ProgramRun run = RunTelestrain({"simulate", "--out", "session"},
                                       {.environment = {{"TELESTRAIN_THREADS", "many"}}});
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_FALSE(std::filesystem::exists("session"));
}

TEST(Usage, TheHelpNamesEveryVerbAndExitCode) {
  const ProgramRun run = RunTelestrain({"--help"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  for (const std::string& verb : kVerbs) EXPECT_TRUE(Holds(run.out, "\n  " + verb)) << verb;
  for (const std::string code : {"0 accepted", "1 measured", "2 wrong", "3 bad", "4 estimation",
                                 "5 rendering", "70 a defect"})
    EXPECT_TRUE(Holds(run.out, code)) << code;
}

TEST(Usage, EveryVerbHelpsWithAnExampleOfItself) {
  for (const std::string& verb : kVerbs) {
    const ProgramRun run = RunTelestrain({verb, "--help"});
    EXPECT_EQ(run.exit_code, 0) << verb;
    EXPECT_EQ(run.err, "") << verb;
    EXPECT_TRUE(Holds(run.out, "Example: telestrain " + verb + " ")) << run.out;
  }
}

using OutFolder = SessionCopy;

TEST_F(OutFolder, MustNotBeTheSessionItself) {
  const auto before = BytesBelow(session());
  for (const char* tail : {"", "/", "/../session"}) {
    const ProgramRun run =
        RunTelestrain({"run", session().string(), "--out", session().string() + tail});
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_TRUE(Holds(run.err, "another folder")) << run.err;
  }
  EXPECT_EQ(BytesBelow(session()), before);
}

TEST_F(OutFolder, OfASimulationMustHoldNoSession) {
  const auto before = BytesBelow(session());
  const ProgramRun run = RunTelestrain({"simulate", "--out", session().string()});
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_TRUE(Holds(run.err, "already holds a session")) << run.err;
  EXPECT_EQ(BytesBelow(session()), before);
}

}  // namespace
}  // namespace telestrain::testing_support
