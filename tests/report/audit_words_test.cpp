// Small parts of the audit: the order of steps, where files differ, the story in words.
#include <gtest/gtest.h>

#include "base/files.h"
#include "report/audit/file_difference.h"
#include "report/audit/step_order.h"
#include "report/audit/tell_audit.h"

namespace telestrain {
namespace {

Json FileOf(const char* where, const std::string& path, const std::string& bytes) {
  return {{"of", where}, {"path", path}, {"bytes", bytes.size()}, {"sha256", Sha256Hex(bytes)}};
}

TEST(StepOrderTest, AStepTakesAwayWhatIsMadeFromIt) {
  EXPECT_TRUE(Supersedes("calibrate", "measure"));
  EXPECT_TRUE(Supersedes("measure", "report"));
  EXPECT_TRUE(Supersedes("report", "sign"));
  EXPECT_FALSE(Supersedes("measure", "calibrate"));
  EXPECT_FALSE(Supersedes("calibrate", "calibrate"));
  EXPECT_FALSE(Supersedes("verify", "measure"));
  EXPECT_FALSE(Supersedes("diagnose", "render"));
  EXPECT_FALSE(Supersedes("detect", "export"));
}

TEST(StepOrderTest, AStepIsRecordedOnceUntilOneBeforeItIsDoneAnew) {
  auto trail = AuditTrail::Open("never_written.jsonl");
  const Json a{{"x", 1}}, b{{"x", 2}};
  ASSERT_TRUE(trail->Append("calibrate", a, "").ok());
  ASSERT_TRUE(trail->Append("verify", a, "").ok());
  EXPECT_TRUE(IsRecorded(*trail, "calibrate", a));
  EXPECT_TRUE(IsRecorded(*trail, "verify", a));
  EXPECT_FALSE(IsRecorded(*trail, "verify", b));
  ASSERT_TRUE(trail->Append("calibrate", b, "").ok());
  EXPECT_FALSE(IsRecorded(*trail, "verify", a));
}

TEST(FileDifferenceTest, SaysWhereTwoFilesDiffer) {
  EXPECT_EQ(FirstDifference("a.json", "{}", "{}"), "");
  EXPECT_EQ(FirstDifference("a.json", R"({"b":[1,2]})", R"({"b":[1,3]})"),
            "/b/1 is 2, made again 3");
  EXPECT_EQ(FirstDifference("a.json", R"({"b":1,"c":2})", R"({"b":1})"), "/c is new: 2");
  EXPECT_EQ(FirstDifference("a.json", R"({"b":1})", R"({"b":1,"c":2})"),
            "/c is missing, made again 2");
  EXPECT_EQ(FirstDifference("a.json", R"({"b": 1})", R"({"b":1})"),
            "the same values are written otherwise");
  EXPECT_EQ(FirstDifference("a.csv", "h\n1,2\n", "h\n1,3\n"), "line 2 is '1,2', made again '1,3'");
  EXPECT_EQ(FirstDifference("a.csv", "h\n", "h\n1\n"), "line 2 is '', made again '1'");
  EXPECT_EQ(FirstDifference("a.png", std::string("\0a", 2), std::string("\0bc", 3)),
            "byte 1 is another; it has 2 bytes, made again 3");
}

TEST(TellAuditTest, TellsStepsSignaturesAndRuns) {
  AuditEntry step;
  step.type = "calibrate";
  step.body = {{"program", {{"version", "1.2.3"}}},
               {"options", {{"outliers", "mrcal"}, {"board-warp", true}, {"compare", ""}}},
               {"inputs", std::vector{FileOf("results", "corners.vnl", "x")}},
               {"outputs", std::vector{FileOf("results", "calibration.json", "y")}}};
  AuditEntry sign;
  sign.seq = 1;
  sign.time = "2026-01-02T03:04:05Z";
  sign.type = "sign";
  sign.body = {{"role", "operator"}, {"signer", "Zhang Wei"}, {"file", "report.pdf"}};
  AuditEntry run;
  run.seq = 2;
  run.type = "run";
  run.body = {{"user", "anna"},
              {"host", {{"name", "bench"}}},
              {"arguments", {"detect", "s", "--out", "r"}},
              {"exit_code", 0}};
  EXPECT_EQ(TellAudit({step, sign, run}),
            (std::vector<std::string>{
                "  1  Lens and views were calibrated, from corners.vnl; made calibration.json "
                "(telestrain 1.2.3).",
                "     with outliers mrcal, board-warp",
                "  2  2026-01-02T03:04:05Z  Zhang Wei signed report.pdf as operator.",
                "  3  anna on bench ran 'telestrain detect s --out r', which ended with 0 "
                "(accepted)."}));
}

TEST(TellAuditTest, NamesCannotWriteLinesOfTheirOwn) {
  AuditEntry sign;
  sign.type = "sign";
  sign.body = {{"role", "operator"}, {"signer", "A\n  2  B\x1b[2J"}, {"file", "report.pdf"}};
  EXPECT_EQ(TellAudit({sign}),
            std::vector<std::string>{"  1  A\\x0a  2  B\\x1b[2J signed report.pdf as operator."});
}

TEST(FileDifferenceTest, LongTextIsCutBetweenCharacters) {
  const std::string kept(59, 'a');  // of 60 bytes, the last of which would begin an ä
  EXPECT_EQ(FirstDifference("a.csv", kept + "äb", "c"),
            "line 1 is '" + kept + "…', made again 'c'");
}

TEST(FileDifferenceTest, DeepJsonIsComparedAsText) {
  const std::string deep(1000000, '[');
  EXPECT_TRUE(FirstDifference("a.json", deep + std::string(1000000, ']'), deep + "1")
                  .starts_with("line 1 is '[["));
}

}  // namespace
}  // namespace telestrain
