// What is checked of a results folder and of a report by its audit trail.
#include "audit_folder.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

TEST_F(AuditCheckTest, AnUntouchedFolderPasses) {
  EXPECT_EQ(VerifiedFolder(),
            "PASS: 3 steps chained, 3 files unchanged, 1 input unchanged; report.pdf: 3 "
            "attachments as printed, not signed");
}

TEST_F(AuditCheckTest, AReportAlonePassesForWhatItHolds) {
  EXPECT_EQ(VerifiedReport([](QPDF&) {}),
            "PASS: 3 attachments as printed, not signed; inputs not checked: no --session");
}

TEST_F(AuditCheckTest, AChangedFileIsNamedWithTheStepThatMadeIt) {
  Write(Results() / "results.json", "{\"verdict\": \"fail\"}");
  EXPECT_EQ(VerifiedFolder(),
            "FAIL: results.json was changed after line 2 (results) of the audit trail made it");
}

TEST_F(AuditCheckTest, AMissingFileIsNamed) {
  fs::remove(Results() / "session.toml");
  EXPECT_EQ(VerifiedFolder(),
            "FAIL: session.toml is missing, which line 1 (open) of the audit trail made");
}

TEST_F(AuditCheckTest, AChangedInputIsNamed) {
  Write(Session() / "a.png", "another");
  EXPECT_EQ(VerifiedFolder(),
            "FAIL: input a.png was changed after line 1 (open) of the audit trail read it");
  fs::remove(Session() / "a.png");
  EXPECT_EQ(VerifiedFolder(), "FAIL: input a.png is missing in " + Session().string());
}

TEST_F(AuditCheckTest, ASessionThatIsGoneIsSaid) {
  fs::remove_all(Session());
  EXPECT_EQ(VerifiedFolder(),
            "PASS: 3 steps chained, 3 files unchanged, inputs not checked: " + Session().string() +
                " is not there; report.pdf: 3 attachments as printed, not "
                "signed");
}

TEST_F(AuditCheckTest, AFileExchangedBetweenTwoStepsIsSeen) {
  Append("review", {FileOf("results", "results.json", "other")}, {});
  EXPECT_EQ(VerifiedFolder(),
            "FAIL: line 4 (review) of the audit trail read another results.json than line 2 "
            "(results) made");
  EditTrail([](std::string& text) { text.resize(text.rfind('\n', text.size() - 2) + 1); });
  Append("review", {FileOf("results", "strain.json", "x")}, {});
  EXPECT_EQ(VerifiedFolder(),
            "FAIL: line 4 (review) of the audit trail read strain.json, which no line before it "
            "made");
}

TEST_F(AuditCheckTest, FilesThatALaterStepTookAwayMayBeMissing) {
  Append("open", {}, {FileOf("results", "session.toml", "toml")});
  fs::remove(Results() / "results.json");
  fs::remove(Results() / "report.pdf");
  EXPECT_EQ(VerifiedFolder(),
            "PASS: 4 steps chained, 1 file unchanged, 0 inputs unchanged; no report.pdf; no "
            "signature holds the trail's last 4 lines (--log anchors them)");
}

TEST_F(AuditCheckTest, OnlyAWholeSetThatWasDrawnLaterExcusesAMissingPicture) {
  Append("render", {}, {FileOf("results", "pictures/a.png", "x")}, {{"view", ""}, {"out", ""}});
  const std::vector<Json> others{{{"turntable", "RESULTS/film.gif"}},
                                 {{"view", "side"}, {"out", ""}},
                                 {{"view", ""}, {"out", "elsewhere"}}};
  for (const Json& options : others) {
    Append("render", {}, {}, options);
    EXPECT_EQ(VerifiedFolder(),
              "FAIL: pictures/a.png is missing, which line 4 (render) of the audit trail made")
        << options;
  }
  Append("render", {}, {}, {{"view", ""}, {"out", "RESULTS/pictures"}});
  EXPECT_TRUE(VerifiedFolder().starts_with("PASS: ")) << VerifiedFolder();
}

TEST_F(AuditCheckTest, TheTrailMustBeThereAndWhole) {
  EditTrail([](std::string& text) { text.erase(0, text.find('\n') + 1); });
  EXPECT_EQ(VerifiedFolder(), "FAIL: " + (Results() / "audit.jsonl").string() +
                                  ": line 1 has number 1 where 0 follows: a line was taken out, "
                                  "put in or moved");
  fs::remove(Results() / "audit.jsonl");
  EXPECT_EQ(VerifiedFolder(), "FAIL: " + (Results() / "audit.jsonl").string() +
                                  " is missing: nothing tells what was done");
}

TEST_F(AuditCheckTest, ATruncatedTrailOfTheFolderDoesNotFitTheReport) {
  EditTrail([](std::string& text) { text.resize(text.rfind('\n', text.size() - 2) + 1); });
  EXPECT_EQ(VerifiedFolder(),
            "FAIL: report.pdf is there, but no line of the audit trail made it: lines were cut "
            "off");
  EditTrail([](std::string& text) { text.resize(text.find('\n') + 1); });
  Append("report", {}, {FileOf("results", "report.pdf", report_)});
  EXPECT_EQ(VerifiedFolder(),
            "FAIL: the audit trail in report.pdf is not the beginning of the one in the results "
            "folder: lines of one of them were taken out or exchanged");
}

TEST_F(AuditCheckTest, AnExchangedAttachmentIsNamed) {
  EXPECT_EQ(VerifiedReport([](QPDF& pdf) { AttachToPdf(pdf, "results.json", "{}"); }),
            "FAIL: attachment results.json of copy.pdf is not the one whose SHA-256 is printed on "
            "its pages");
}

TEST_F(AuditCheckTest, AnAttachmentTakenOutIsNamed) {
  EXPECT_EQ(VerifiedReport([](QPDF& pdf) { DetachFromPdf(pdf, "results.json"); }),
            "FAIL: attachment results.json of copy.pdf is missing, which line 2 (results) of its "
            "audit trail made");
  EXPECT_EQ(VerifiedReport([](QPDF& pdf) { DetachFromPdf(pdf, "audit.jsonl"); }),
            "FAIL: copy.pdf carries no audit trail");
}

TEST_F(AuditCheckTest, ATruncatedTrailInTheReportDoesNotEndAsPrinted) {
  const std::string trail = Trail();
  EXPECT_EQ(VerifiedReport([&](QPDF& pdf) {
              AttachToPdf(pdf, "audit.jsonl", trail.substr(0, trail.find('\n') + 1));
            }),
            "FAIL: the audit trail in copy.pdf does not end with the line whose hash is printed on "
            "its pages: it was cut short or continued");
  EXPECT_EQ(VerifiedReport([&](QPDF& pdf) { AttachToPdf(pdf, "audit.jsonl", trail); }),
            "FAIL: the audit trail in copy.pdf does not end with the line whose hash is printed on "
            "its pages: it was cut short or continued");
}

TEST_F(AuditCheckTest, AReportThatWasExchangedAsAWholeIsSeen) {
  Write(Results() / "report.pdf", EditedPdf(report_, [](QPDF&) {}) + "\n");
  EXPECT_EQ(VerifiedFolder(),
            "FAIL: report.pdf was changed after line 3 (report) of the audit trail made it");
  EXPECT_EQ(Verified(Results() / "report.pdf"), VerifiedFolder());
}

TEST_F(AuditCheckTest, ARecordedSignatureMustBeThere) {
  auto trail = AuditTrail::Open(Results() / "audit.jsonl");
  ASSERT_TRUE(
      trail
          ->Append(
              "sign",
              {{"role", "operator"}, {"file", "report.pdf"}, {"sha256_after", Sha256Hex(report_)}},
              "")
          .ok());
  ASSERT_TRUE(trail->Sync().ok());
  EXPECT_EQ(VerifiedFolder(),
            "FAIL: the signature of the operator is missing in report.pdf, which line 4 (sign) of "
            "the audit trail tells of");
}

TEST_F(AuditCheckTest, ARequiredSignatureMustBeThere) {
  AuditQuestion question;
  question.subject = Results();
  question.trust.required_roles = {"reviewer"};
  const auto answer = VerifyAudit(question);
  ASSERT_TRUE(answer.ok());
  EXPECT_FALSE(answer->passed);
  EXPECT_NE(answer->line.find("reviewer"), std::string::npos) << answer->line;
}

TEST_F(AuditCheckTest, TheInstrumentsLogMustTellOfTheLatestLine) {
  const fs::path file = scratch_.path() / "log.jsonl";
  auto log = AuditTrail::Open(file);
  ASSERT_TRUE(log->Append("run", {{"trail_head", std::string(64, 'a')}}, "").ok());
  ASSERT_TRUE(log->Sync().ok());
  AuditQuestion question;
  question.subject = Results();
  question.log = file;
  EXPECT_EQ(VerifyAudit(question)->line,
            "FAIL: " + file.string() +
                " does not tell of the latest line of the audit trail: it was written or cut off "
                "without the instrument's log");
  const std::string head = AuditTrail::Open(Results() / "audit.jsonl")->head();
  ASSERT_TRUE(log->Append("run", {{"trail_head", head}}, "").ok());
  ASSERT_TRUE(log->Sync().ok());
  EXPECT_TRUE(VerifyAudit(question)->line.ends_with("; 2 lines of the instrument's log chained"));
  EXPECT_EQ(Verified(file), "PASS: 2 lines of the instrument's log chained");
}

TEST_F(AuditCheckTest, WhatCannotBeReadIsNoAnswer) {
  EXPECT_EQ(Verified(scratch_.path() / "none"),
            "error: " + (scratch_.path() / "none").string() + ": does not exist");
  AuditQuestion question;
  question.subject = Results();
  question.public_key = Results() / "audit.jsonl";
  EXPECT_EQ(VerifyAudit(question).error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace telestrain
