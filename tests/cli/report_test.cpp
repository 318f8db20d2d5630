// `report RESULTS` with its layouts and languages.
#include <gtest/gtest.h>

#include <fstream>

#include "cli/session_copy.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

class ReportVerb : public SessionCopy {
 protected:
  ProgramRun Report(std::vector<std::string> more) const {
    more.insert(more.begin(), {"report", results().string()});
    return RunTelestrain(more);
  }
  // Whatever the verdict: a limit of what was not measured stays undecided.
  ProgramRun MustWrite(const std::vector<std::string>& more) const {
    const ProgramRun run = Report(more);
    EXPECT_LE(run.exit_code, 1) << run.err;
    EXPECT_TRUE(fs::exists(results() / "report.pdf"));
    return run;
  }
  void ExpectUsageError(const ProgramRun& run, const std::string& part) const {
    EXPECT_EQ(run.exit_code, 2) << run.out;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
  }
};

TEST_F(ReportVerb, ListsLayoutsAndLanguagesBuiltInAndOwn) {
  const ProgramRun run = RunTelestrain({"report", "--list"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out,
            "layouts\n"
            "  acceptance      Acceptance report\n"
            "  calibration     Calibration report\n"
            "  reverification  Re-verification report\n"
            "  strain          Strain measurement report\n"
            "languages\n"
            "  de              Deutsch\n"
            "  en              English\n"
            "  zh              中文\n");
  const fs::path own = scratch() / "own";
  fs::create_directories(own);
  std::ofstream(own / "incoming.json") << R"({"title": "Incoming inspection"})";
  const ProgramRun both = RunTelestrain({"report", "--list", "--templates", own.string()});
  EXPECT_NE(both.out.find("  incoming        Incoming inspection\n"), std::string::npos);
  EXPECT_NE(both.out.find("  strain "), std::string::npos);
}

// What is asked wrongly must not cost the report that is there.
TEST_F(ReportVerb, UsageErrorsNameTheRemedyAndKeepTheOldReport) {
  TakeRun({"detect", "calibrate"});
  MustWrite({});
  const std::string before = ReadAll(results() / "report.pdf");
  ExpectUsageError(Report({"--template", "calibraton"}), "did you mean 'calibration'");
  ExpectUsageError(Report({"--language", "dee"}), "did you mean 'de'");
  ExpectUsageError(Report({"--template", "reverification"}), "--against EARLIER");
  ExpectUsageError(Report({"--against", results().string()}), "--template reverification");
  ExpectUsageError(Report({"--archive-level", "2b"}), "3a");
  ExpectUsageError(RunTelestrain({"report"}), "--list");
  EXPECT_EQ(Report({"--templates", (scratch() / "none").string()}).exit_code, 3);
  // Neither do results that cannot be compared with.
  for (const fs::path& itself : {results(), results() / "report.pdf"})
    EXPECT_EQ(Report({"--template", "reverification", "--against", itself.string()}).exit_code, 3);
  EXPECT_EQ(ReadAll(results() / "report.pdf"), before);
}

// The sentences are the program's own here, not those of a fixture.
TEST_F(ReportVerb, NothingOfARealReportIsLeftInEnglish) {
  TakeRun({"detect", "calibrate"});
  MustWrite({});
  const fs::path earlier = scratch() / "earlier";
  fs::copy(results(), earlier, fs::copy_options::recursive);
  ASSERT_EQ(RunTelestrain({"diagnose", results().string()}).exit_code, 0);
  MustRun({"verify", "measure"});
  MustWrite({});
  for (const char* language : {"de", "zh"})
    for (const char* layout : {"acceptance", "calibration", "strain", "reverification"}) {
      std::vector<std::string> words{"--language", language, "--template", layout};
      if (std::string(layout) == "reverification")
        words.insert(words.end(), {"--against", earlier.string()});
      const ProgramRun run = MustWrite(words);
      EXPECT_EQ(run.err.find("printed in English"), std::string::npos) << run.err;
    }
}

// A layout of one's own that does not draw the hashes gets them: the report can be verified.
TEST_F(ReportVerb, EveryLayoutPrintsWhatAuditVerifyCompares) {
  TakeRun({"detect", "calibrate"});
  const fs::path own = scratch() / "own";
  fs::create_directories(own);
  std::ofstream(own / "incoming.json")
      << R"({"schema": "telestrain.template/1", "title": "Incoming inspection",
             "blocks": [{"include": "opening"}, {"type": "end-mark", "text": "End"}]})";
  for (const char* language : {"en", "de"}) {
    MustWrite({"--templates", own.string(), "--template", "incoming", "--language", language});
    const ProgramRun run = RunTelestrain({"audit", "verify", (results() / "report.pdf").string()});
    EXPECT_EQ(run.exit_code, 0) << language;
    EXPECT_TRUE(run.out.starts_with("PASS: ") &&
                run.out.find("5 attachments as printed") != std::string::npos)
        << run.out;
  }
}

TEST_F(ReportVerb, WarnsOfAFileThatWasChangedSinceItsStep) {
  TakeRun({"detect", "calibrate"});
  EXPECT_EQ(MustWrite({}).err.find("was changed"), std::string::npos);
  std::ofstream(results() / "calibration.json", std::ios::app) << " ";
  EXPECT_NE(MustWrite({}).err.find("calibration.json: was changed since 'telestrain calibrate' "
                                   "wrote it; 'telestrain audit verify' will fail"),
            std::string::npos);
}

}  // namespace
}  // namespace telestrain::testing_support
