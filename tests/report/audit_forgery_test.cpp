// What somebody tries who can write every file of a results folder, or only a report.
#include "audit_folder.h"
#include "report/audit/repeatable.h"
#include "report/audit/trail_files.h"
#include "report/signature/sign_report.h"
#include "signature_pki.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

class AuditForgeryTest : public AuditCheckTest {
 protected:
  std::string VerifiedWith(const fs::path& subject, bool trusted,
                           const std::vector<std::string>& required = {},
                           const fs::path& session = {}) const {
    AuditQuestion question;
    question.subject = subject;
    question.session = session;
    question.trust.required_roles = required;
    if (trusted) question.trust.certificates = {WriteTestFile("root.pem", Pki().root.Pem())};
    const auto answer = VerifyAudit(question);
    return answer ? answer->line : "error: " + answer.error().message;
  }
  static std::string Signed(const std::string& report, const std::string& role) {
    SignOptions options;
    options.role = role;
    options.time_s = kSigned_s;
    const auto result = SignReport("report.pdf", report, Pki().Of(role).ForSigning(), options);
    EXPECT_TRUE(result.ok()) << result.error().message;
    return result ? result->bytes : "";
  }
  fs::path WriteReport(const std::string& bytes) const {
    Write(Results() / "report.pdf", bytes);
    return Results() / "report.pdf";
  }
  fs::path Elsewhere(const std::string& bytes) const {
    Write(scratch_.path() / "copy.pdf", bytes);
    return scratch_.path() / "copy.pdf";
  }
  std::string Bare() const { return MakeReport(false); }
  static AuditEntry EntryOf(const Json& body) {
    AuditEntry entry;
    entry.type = "review";
    entry.body = body;
    return entry;
  }
};

constexpr const char* kFolder = "PASS: 3 steps chained, 3 files unchanged, 1 input unchanged; ";

TEST_F(AuditForgeryTest, NoLineOfTheTrailSwitchesTheChecksOff) {
  const std::string anything = "%PDF-1.4 anything, not even a PDF";
  WriteReport(anything);
  auto trail = AuditTrail::Open(Results() / "audit.jsonl");
  ASSERT_TRUE(trail
                  ->Append("report",
                           {{"options", {{"archive-level", "1b"}}},
                            {"outputs", {FileOf("results", "report.pdf", anything)}}},
                           "")
                  .ok());
  ASSERT_TRUE(trail->Sync().ok());
  EXPECT_TRUE(VerifiedFolder().starts_with("FAIL: report.pdf: is no undamaged PDF"));
}

TEST_F(AuditForgeryTest, AReportOfLevel1bIsKnownByItsBytesOrItsSignatures) {
  Append("report", {}, {FileOf("results", "report.pdf", Bare())});
  const std::string folder = "PASS: 4 steps chained, 3 files unchanged, 1 input unchanged; ";
  EXPECT_EQ(Verified(WriteReport(Bare())),
            folder + "report.pdf: no attachments (level 1b), not signed");
  EXPECT_EQ(VerifiedWith(WriteReport(Signed(Bare(), "operator")), true),
            folder + "report.pdf: no attachments (level 1b), signed by operator " +
                "Zhang Wei 张伟 (signed 2026-01-31T12:00:00Z by its own clock) (not told of in the "
                "audit trail)");
  EXPECT_TRUE(VerifiedFolder().starts_with("FAIL: whose signatures these are cannot be decided"));
  EXPECT_EQ(Verified(Elsewhere(Bare())),
            "FAIL: copy.pdf carries no audit trail and no signature: nothing in it can be checked; "
            "verify its results folder");
  EXPECT_EQ(VerifiedWith(Elsewhere(Signed(Bare(), "operator")), true),
            "PASS: no attachments (level 1b), signed by operator Zhang Wei 张伟 (signed "
            "2026-01-31T12:00:00Z by its own clock); inputs not checked: no --session");
}

TEST_F(AuditForgeryTest, OnlyUpdatesOfSignaturesMayFollowWhatWasMade) {
  WriteReport(report_ + "\n/ByteRange");
  EXPECT_EQ(VerifiedFolder(), "FAIL: the file has a signature that is not as telestrain writes it");
  const std::string added = report_ + "% more\n";
  WriteReport(added);
  EXPECT_EQ(VerifiedFolder(),
            "FAIL: report.pdf was changed after line 3 (report) of the audit trail made it");
}

TEST_F(AuditForgeryTest, SignaturesAreCountedFromWhatReportAndSignMade) {
  const std::string once = Signed(report_, "operator");
  const std::string twice = Signed(once, "reviewer");
  EXPECT_TRUE(VerifiedWith(WriteReport(twice), true)
                  .starts_with(std::string(kFolder) + "report.pdf: 3 attachments as printed, "));
  auto trail = AuditTrail::Open(Results() / "audit.jsonl");
  ASSERT_TRUE(
      trail
          ->Append(
              "sign",
              {{"role", "operator"}, {"file", "report.pdf"}, {"sha256_after", Sha256Hex(once)}}, "")
          .ok());
  ASSERT_TRUE(trail->Sync().ok());
  const std::string line = VerifiedWith(Results(), true);
  EXPECT_TRUE(line.starts_with("PASS: 4 steps")) << line;
  EXPECT_TRUE(line.ends_with(" by its own clock) (not told of in the audit trail)")) << line;
  EXPECT_TRUE(VerifiedWith(WriteReport(report_), true).starts_with("FAIL: report.pdf was changed"));
}

TEST_F(AuditForgeryTest, WhoIsTrustedOrRequiredMustHaveSigned) {
  // The signatures were cut off, and no line tells of them.
  EXPECT_EQ(VerifiedWith(Results(), true),
            "FAIL: report.pdf is not signed although --trust names who may sign");
  EXPECT_EQ(VerifiedWith(Elsewhere(report_), true),
            "FAIL: copy.pdf is not signed although --trust names who may sign");
  EXPECT_EQ(VerifiedWith(Elsewhere(Bare()), false, {"operator"}),
            "FAIL: copy.pdf carries no audit trail and no signature: nothing in it can be checked; "
            "verify its results folder");
  Append("open", {}, {FileOf("results", "session.toml", "toml")});
  fs::remove(Results() / "results.json");
  fs::remove(Results() / "report.pdf");
  EXPECT_EQ(VerifiedWith(Results(), false, {"operator"}),
            "FAIL: report.pdf is missing, which the operator must have signed (--require)");
  EXPECT_EQ(VerifiedWith(Results(), true),
            "FAIL: report.pdf is missing although --trust names who may sign");
  EXPECT_TRUE(VerifiedWith(Results() / "audit.jsonl", false, {"operator"}).starts_with("error: "));
}

TEST_F(AuditForgeryTest, ATrustedFileWithoutACertificateIsBadInput) {
  AuditQuestion question;
  question.subject = Results();
  question.trust.certificates = {Results() / "session.toml"};
  const auto answer = VerifyAudit(question);
  ASSERT_FALSE(answer.ok());
  EXPECT_EQ(answer.error().kind, ErrorKind::kBadInput);
}

TEST_F(AuditForgeryTest, ASessionThatIsNamedIsChecked) {
  EXPECT_EQ(VerifiedWith(Elsewhere(report_), false, {}, Session()),
            "PASS: 3 attachments as printed, not signed; 1 input unchanged");
  Write(Session() / "a.png", "another");
  const std::string changed =
      "FAIL: input a.png was changed after line 1 (open) of the audit trail read it";
  EXPECT_EQ(VerifiedWith(Elsewhere(report_), false, {}, Session()), changed);
  EXPECT_EQ(Verified(Results() / "report.pdf"), changed);
  EXPECT_TRUE(VerifiedWith(Results() / "audit.jsonl", false, {}, Session()).starts_with("error: "));
}

TEST_F(AuditForgeryTest, AReportThatPrintsNoHashesIsSaidToPrintNone) {
  auto pdf = PdfDocument::Create();
  (*pdf)->AddPage();
  const std::string trail = Trail();
  const std::string report = EditedPdf(*(*pdf)->Save({}, "seed"), [&](QPDF& document) {
    AttachToPdf(document, "audit.jsonl", trail);
  });
  EXPECT_TRUE(Verified(Elsewhere(report))
                  .starts_with("FAIL: copy.pdf prints no SHA-256 of its attachments, "));
}

TEST_F(AuditForgeryTest, LinesThatNoSignatureHoldsAreSaid) {
  Append("review", {}, {});
  EXPECT_EQ(VerifiedFolder(),
            "PASS: 4 steps chained, 3 files unchanged, 1 input unchanged; report.pdf: 3 "
            "attachments as printed, not signed; no signature holds the trail's last line (--log "
            "anchors it)");
}

TEST_F(AuditForgeryTest, NoPathLeadsOutOfTheFolder) {
  for (const char* path : {"/dev/zero", "../a", "b/../../a", ""})
    EXPECT_FALSE(LiesInside(path)) << path;
  EXPECT_TRUE(LiesInside("pictures/array..png"));
  Append("review", {}, {FileOf("results", "/dev/zero\n", "x")});
  EXPECT_EQ(VerifiedFolder(),
            "FAIL: line 4 (review) of the audit trail names the file '/dev/zero\\x0a', which is no "
            "path inside the folder: it was not written by telestrain");
}

TEST_F(AuditForgeryTest, OnlyRegularFilesAreRead) {
  fs::remove(Session() / "a.png");
  fs::create_symlink("/dev/zero", Session() / "a.png");
  EXPECT_EQ(VerifiedFolder(), "FAIL: input a.png is no regular file");
  fs::remove(Results() / "results.json");
  fs::create_symlink("/dev/zero", Results() / "results.json");
  EXPECT_EQ(VerifiedFolder(), "FAIL: results.json is no regular file");
}

TEST_F(AuditForgeryTest, ASizeThatNoFileHasIsNone) {
  Json file = FileOf("results", "b", "x");
  file["bytes"] = 1e300;
  EXPECT_EQ(LatestOutputs({EntryOf({{"outputs", {file}}})}).at("b").bytes, 0u);
}

TEST_F(AuditForgeryTest, WhatIsRepeatedStaysInItsFolder) {
  const auto allows = [](const Json& options) {
    return CheckRepeatable({EntryOf({{"options", options}})}).ok();
  };
  EXPECT_TRUE(allows({{"out", "RESULTS/pictures"}, {"subset-px", 31}, {"range", {-1.5, 2.0}}}));
  EXPECT_TRUE(allows({{"out", ""}, {"view", nullptr}}));
  for (const char* place : {"out", "turntable", "states", "dcc"}) {
    EXPECT_FALSE(allows({{place, "/x"}})) << place;
    EXPECT_FALSE(allows({{place, "RESULTS/../../x"}})) << place;
    EXPECT_FALSE(allows({{place, std::vector<std::string>{"/x"}}})) << place;
  }
  EXPECT_FALSE(allows({{"out=/x", true}}));
  EXPECT_FALSE(allows({{"format", std::vector<std::string>{"glb", "--out=/x"}}}));
  EXPECT_FALSE(CheckRepeatable({EntryOf({{"inputs", {FileOf("session", "../x", "")}}})}).ok());
}

}  // namespace
}  // namespace telestrain
