// `telestrain audit` on a run of the small session, and what runs record.
#include <gtest/gtest.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#include "integration/small_run.h"
#include "report/edited_pdf.h"
#include "unit/base/scratch_folder.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

void WriteAll(const fs::path& to, const std::string& text) { std::ofstream(to) << text; }

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class AuditTest : public SmallRun {
 protected:
  // A copy of the results that may be changed.
  AuditTest() : copy_(scratch_.path() / "results") {
    fs::copy(Results(), copy_, fs::copy_options::recursive);
  }
  const fs::path& copy() const { return copy_; }
  const fs::path& scratch() const { return scratch_.path(); }

  void Edit(const std::string& name, const std::function<void(std::string&)>& edit) const {
    std::string bytes = ReadAll(copy_ / name);
    edit(bytes);
    WriteAll(copy_ / name, bytes);
  }
  ProgramRun Audit(const std::string& what, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"audit", what, copy_.string()};
    words.insert(words.end(), more.begin(), more.end());
    return RunTelestrain(words);
  }
  // `audit verify` must end with 1 and say exactly one line that begins so.
  void ExpectFailure(const std::string& begin, const std::vector<std::string>& more = {}) const {
    const ProgramRun run = Audit("verify", more);
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_TRUE(run.out.starts_with("FAIL: " + begin)) << run.out;
    EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1);
  }
  std::string TrailName() const { return (copy_ / "audit.jsonl").string(); }

 private:
  ScratchFolder scratch_{"telestrain_audit_cli_"};
  fs::path copy_;
};

TEST_F(AuditTest, AnUntouchedRunPasses) {
  const ProgramRun run = Audit("verify");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(run.out.starts_with("PASS: 9 steps chained, ")) << run.out;
  EXPECT_TRUE(run.out.ends_with(" attachments as printed, not signed\n")) << run.out;
  EXPECT_NE(run.out.find("20 inputs unchanged"), std::string::npos) << run.out;
  EXPECT_EQ(RunTelestrain({"audit", "verify", (copy() / "report.pdf").string()}).out, run.out);
}

TEST_F(AuditTest, AChangedInputImageFails) {
  const fs::path session = scratch() / "session";
  fs::copy(SmallSession(), session, fs::copy_options::recursive);
  const fs::path image = session / "ruler/ruler_002.png";
  std::string bytes = ReadAll(image);
  bytes[bytes.size() / 2] ^= 1;
  WriteAll(image, bytes);
  ExpectFailure("input ruler/ruler_002.png was changed after line 1 (open) of the audit trail",
                {"--session", session.string()});
}

TEST_F(AuditTest, ASessionThatIsGoneIsSaidAndOneThatIsNamedMustBeThere) {
  WriteAll(copy() / "session.path", "/nowhere/session\n");
  const ProgramRun run = Audit("verify");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.out.find("inputs not checked: /nowhere/session is not there"), std::string::npos);
  EXPECT_EQ(Audit("verify", {"--session", "/nowhere"}).exit_code, 3);
  EXPECT_EQ(Audit("replay").exit_code, 3);
}

TEST_F(AuditTest, AChangedResultFails) {
  Edit("ruler.csv", [](std::string& bytes) { bytes[bytes.size() - 3] ^= 1; });
  ExpectFailure("ruler.csv was changed after line 5 (verify) of the audit trail made it\n");
}

TEST_F(AuditTest, ADeletedLineFails) {
  Edit("audit.jsonl", [](std::string& text) {
    const std::size_t begin = text.find('\n') + 1;
    text.erase(begin, text.find('\n', begin) + 1 - begin);
  });
  ExpectFailure(TrailName() + ": line 2 has number 2 where 1 follows");
}

TEST_F(AuditTest, ATruncatedTrailFails) {
  Edit("audit.jsonl",
       [](std::string& text) { text.resize(text.rfind('\n', text.size() - 2) + 1); });
  ExpectFailure("report.pdf is there, but no line of the audit trail made it");
}

TEST_F(AuditTest, AnExtraLineFails) {
  Edit("audit.jsonl",
       [](std::string& text) { text += text.substr(text.rfind('\n', text.size() - 2) + 1); });
  ExpectFailure(TrailName() + ": line 10 has number 8 where 9 follows");
}

TEST_F(AuditTest, AnExchangedAttachmentFails) {
  Edit("report.pdf", [](std::string& bytes) {
    bytes = EditedPdf(bytes, [](QPDF& pdf) { AttachToPdf(pdf, "results.json", "{}"); });
  });
  ExpectFailure("report.pdf was changed after line 9 (report) of the audit trail made it");
  fs::rename(copy() / "report.pdf", copy() / "other.pdf");
  const ProgramRun alone = RunTelestrain({"audit", "verify", (copy() / "other.pdf").string()});
  EXPECT_EQ(alone.out,
            "FAIL: attachment results.json of other.pdf is not the one whose SHA-256 is printed on "
            "its pages\n");
}

TEST_F(AuditTest, ReplayMakesEveryByteAgain) {
  const ProgramRun run = Audit("replay");
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_TRUE(run.out.starts_with("PASS: 7 steps repeated, ")) << run.out;
}

TEST_F(AuditTest, ReplayRepeatsTheOptionsOfEveryVerb) {
  const std::string out = copy().string(), session = SmallSession().string();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"calibrate", session, "--out", out, "--outliers", "mrcal",
                                 "--board-warp", "--cull", "0,0,20,20", "--cull", "5,5,9,9",
                                 "--compare", (Results() / "calibration.json").string()},
        {"measure", session, "--out", out, "--subset-px", "31"},
        {"render", out, "--view", "pipe_strain", "--state", "1", "--range", "0", "500", "--size",
         "800x600", "--out", (scratch() / "a.png").string()},
        {"export", out, "--out", (scratch() / "e").string(), "--format", "glb,calibration"}})
    ASSERT_EQ(RunTelestrain(words).exit_code, 0) << words.front();
  const ProgramRun run = Audit("replay");
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_TRUE(run.out.starts_with("PASS: 11 steps repeated, ")) << run.out;
}

TEST_F(AuditTest, ReplayNamesWhatDiffers) {
  Edit("ruler.csv", [](std::string& text) { text.replace(text.find("27."), 3, "28."); });
  const ProgramRun csv = Audit("replay");
  EXPECT_EQ(csv.exit_code, 1);
  EXPECT_TRUE(csv.out.starts_with("FAIL: ruler.csv: line 2 is 'ruler/ruler_001.png,28."))
      << csv.out;
  fs::copy_file(Results() / "ruler.csv", copy() / "ruler.csv",
                fs::copy_options::overwrite_existing);
  Edit("results.json", [](std::string& text) {
    text.replace(text.find("\"verdict\": \"pass\""), 17, "\"verdict\": \"fail\"");
  });
  const ProgramRun json = Audit("replay");
  EXPECT_EQ(json.exit_code, 1);
  EXPECT_EQ(json.out, "FAIL: results.json: /verdict is \"fail\", made again \"pass\"\n");
}

TEST_F(AuditTest, ReplayKeepsWhatItMadeWhereAsked) {
  const fs::path keep = scratch() / "kept";
  EXPECT_EQ(Audit("replay", {"--keep", keep.string()}).exit_code, 0);
  EXPECT_EQ(ReadAll(keep / "results/results.json"), ReadAll(Results() / "results.json"));
  EXPECT_EQ(Audit("replay", {"--keep", keep.string()}).exit_code, 2);
}

TEST_F(AuditTest, ShowTellsEveryStepOfAFolderAndOfAReport) {
  const ProgramRun run = Audit("show");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* deed : {"session was opened", "Corners and crosses were found", "calibrated",
                           "checked by other means", "ruler was measured", "strain of the pipe",
                           "Pictures were drawn", "limits were decided", "report was written"})
    EXPECT_NE(run.out.find(deed), std::string::npos) << deed;
  const ProgramRun report = RunTelestrain({"audit", "show", (copy() / "report.pdf").string()});
  const std::string own =
      "     The report was written with these results.\n     It is not signed.\n";
  ASSERT_TRUE(report.out.ends_with(own)) << report.out;
  EXPECT_TRUE(run.out.starts_with(report.out.substr(0, report.out.size() - own.size())));
  EXPECT_NE(report.out.find("limits were decided"), std::string::npos);
}

TEST_F(AuditTest, StepsThatRepeatThemselvesAddNothing) {
  const std::string before = ReadAll(copy() / "audit.jsonl");
  for (const char* verb : {"diagnose", "report"})
    ASSERT_EQ(RunTelestrain({verb, copy().string()}).exit_code, 0);
  EXPECT_EQ(ReadAll(copy() / "audit.jsonl"), before);
}

TEST_F(AuditTest, AnotherRunAndAnInterruptedOneTellTheSame) {
  const fs::path out = scratch() / "again";
  const std::vector<std::string> words{"run", SmallSession().string(), "--out", out.string()};
  {
    RunningTelestrain interrupted(words);
    const auto lines = [&] {
      return fs::exists(out / "audit.jsonl") ? LinesOf(ReadAll(out / "audit.jsonl")).size() : 0;
    };
    for (int i = 0; i < 6000 && lines() < 3 && !interrupted.HasEnded(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    interrupted.Signal(SIGKILL);
    ASSERT_EQ(interrupted.Wait().exit_code, 128 + SIGKILL);
  }
  std::ofstream(out / "audit.jsonl", std::ios::app) << "{\"entry\":";
  ASSERT_EQ(RunTelestrain(words).exit_code, 0);
  EXPECT_EQ(ReadAll(out / "audit.jsonl"), ReadAll(Results() / "audit.jsonl"));
  EXPECT_EQ(DifferingFiles(Results(), out), std::vector<std::string>());
}

TEST_F(AuditTest, ABrokenTrailIsNotContinued) {
  Edit("audit.jsonl", [](std::string& text) { text.erase(0, text.find('\n') + 1); });
  const ProgramRun run =
      RunTelestrain({"detect", SmallSession().string(), "--out", copy().string()});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("keep it and use another --out folder"), std::string::npos) << run.err;
  EXPECT_TRUE(fs::exists(copy() / "report.pdf"));
}

TEST_F(AuditTest, ASignedReportIsSetAsideNotRemoved) {
  Edit("report.pdf", [](std::string& bytes) { bytes += "/ByteRange [0 1 2 3]\n"; });
  const std::string signed_report = ReadAll(copy() / "report.pdf");
  const std::string said = RunTelestrain({"report", copy().string()}).err;
  EXPECT_NE(said.find("the signed report.pdf is now report_superseded_"), std::string::npos);
  int set_aside = 0;
  for (const auto& entry : fs::directory_iterator(copy()))
    if (entry.path().filename().string().starts_with("report_superseded_")) {
      ++set_aside;
      EXPECT_EQ(ReadAll(entry.path()), signed_report);
    }
  EXPECT_EQ(set_aside, 1);
  EXPECT_EQ(ReadAll(copy() / "report.pdf"), ReadAll(Results() / "report.pdf"));
}

// A new Ed25519 key: private and public half as PEM files.
std::pair<fs::path, fs::path> NewKey(const fs::path& folder) {
  const std::pair<fs::path, fs::path> files{folder / "key.pem", folder / "open.pem"};
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key(
      EVP_PKEY_Q_keygen(nullptr, nullptr, "ED25519"), &EVP_PKEY_free);
  const std::unique_ptr<BIO, decltype(&BIO_free)> secret(BIO_new_file(files.first.c_str(), "w"),
                                                         &BIO_free);
  const std::unique_ptr<BIO, decltype(&BIO_free)> open(BIO_new_file(files.second.c_str(), "w"),
                                                       &BIO_free);
  PEM_write_bio_PrivateKey(secret.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr);
  PEM_write_bio_PUBKEY(open.get(), key.get());
  return files;
}

TEST_F(AuditTest, TheInstrumentsLogTellsOfEveryRunAndIsSigned) {
  const auto [key, open] = NewKey(scratch());
  const fs::path log = scratch() / "instrument.jsonl";
  const Surroundings where{
      ".",
      {{"TELESTRAIN_INSTRUMENT_LOG", log.string()}, {"TELESTRAIN_INSTRUMENT_KEY", key.string()}}};
  ASSERT_EQ(RunTelestrain({"report", copy().string()}, where).exit_code, 0);
  EXPECT_EQ(RunTelestrain({"diagnose", "nowhere"}, where).exit_code, 3);
  const auto lines = LinesOf(ReadAll(log));
  ASSERT_EQ(lines.size(), 2u);
  const auto entry = nlohmann::json::parse(lines[0]).at("entry");
  EXPECT_EQ(entry.at("body").at("verb"), "report");
  EXPECT_EQ(entry.at("body").at("exit_code"), 0);
  EXPECT_EQ(entry.at("body").at("results"), copy().string());
  EXPECT_EQ(entry.at("body").at("trail_head"),
            nlohmann::json::parse(LinesOf(ReadAll(copy() / "audit.jsonl")).back()).at("hash"));
  EXPECT_EQ(nlohmann::json::parse(lines[1]).at("entry").at("body").at("exit_code"), 3);
  EXPECT_EQ(Audit("verify", {"--log", log.string(), "--public-key", open.string()}).exit_code, 0);
  const auto [other_key, other_open] = NewKey(scratch());
  ExpectFailure(log.string() + ": line 1 is not signed by this key",
                {"--log", log.string(), "--public-key", other_open.string()});
  const ProgramRun show = RunTelestrain({"audit", "show", log.string()});
  EXPECT_NE(show.out.find("ran 'telestrain report "), std::string::npos) << show.out;
}

TEST_F(AuditTest, NothingIsDoneWithABrokenLog) {
  const fs::path log = scratch() / "instrument.jsonl";
  WriteAll(log, "nonsense\n");
  fs::remove(copy() / "report.pdf");
  const ProgramRun run =
      RunTelestrain({"--instrument-log", log.string(), "report", copy().string()});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("line 1 is not JSON"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(copy() / "report.pdf"));
}

TEST_F(AuditTest, WrongUseIsSaid) {
  EXPECT_EQ(RunTelestrain({"audit"}).exit_code, 2);
  EXPECT_EQ(RunTelestrain({"audit", "verify", "nowhere"}).exit_code, 3);
  EXPECT_EQ(RunTelestrain({"audit", "show", "nowhere"}).exit_code, 3);
  EXPECT_EQ(Audit("verify", {"--require", "nobody"}).exit_code, 2);
  EXPECT_EQ(Audit("verify", {"--public-key", "nowhere"}).exit_code, 3);
  EXPECT_EQ(RunTelestrain({"audit", "verify", TrailName(), "--require", "operator"}).exit_code, 2);
}

}  // namespace
}  // namespace telestrain::testing_support
