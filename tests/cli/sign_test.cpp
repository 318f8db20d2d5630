#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/session_copy.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

// Keys come from the openssl program, as bootstrap's do; the library's tests make their own.
class SignVerb : public SessionCopy {
 protected:
  void SetUp() override {
    SessionCopy::SetUp();
    const std::string folder = scratch().string();
    const std::string command =
        "cd '" + folder +
        "' && openssl req -x509 -newkey rsa:2048 -keyout key.pem -out cert.pem -days 2 -passout "
        "pass:geheim -subj '/CN=Test operator' >/dev/null 2>&1 && "
        "openssl pkcs12 -export -inkey key.pem -in cert.pem -passin pass:geheim -passout "
        "pass:geheim -out both.p12 >/dev/null 2>&1";
    if (std::system(command.c_str()) != 0) GTEST_SKIP() << "openssl is not installed";
    std::ofstream(scratch() / "password") << "geheim\n";
  }
  std::string Report() const { return (results() / "report.pdf").string(); }
  std::string File(const std::string& name) const { return (scratch() / name).string(); }
  std::vector<std::string> Words(std::vector<std::string> more) const {
    std::vector<std::string> words = {"sign", Report()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(SignVerb, SignsReplacesTheFileAndRecordsItInTheTrail) {
  TakeRun({"run"});
  const std::string before = ReadAll(Report());
  std::ofstream(results() / "audit.jsonl", std::ios::app);  // `run` writes one, or it is empty
  const ProgramRun run =
      RunTelestrain(Words({"--role", "operator", "--p12", File("both.p12"), "--password-file",
                           File("password"), "--reason", "Checked"}));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(run.out.starts_with("signed     " + Report() + " as operator: Test operator, "))
      << run.out;
  const std::string after = ReadAll(Report());
  EXPECT_GT(after.size(), before.size());
  EXPECT_TRUE(after.starts_with(before));
  std::istringstream lines(ReadAll(results() / "audit.jsonl"));
  std::string line, last;
  while (std::getline(lines, line)) last = line;
  const auto entry = nlohmann::json::parse(last)["entry"];
  EXPECT_EQ(entry["type"], "sign");
  EXPECT_EQ(entry["body"]["role"], "operator");
  EXPECT_EQ(entry["body"]["signer"], "Test operator");

  // The second time it is refused and nothing changes.
  const ProgramRun again = RunTelestrain(
      Words({"--role", "operator", "--key", File("key.pem"), "--cert", File("cert.pem")}),
      {.environment = {{"TELESTRAIN_KEY_PASSWORD", "geheim"}}});
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_NE(again.err.find("the operator has already signed (Test operator, "), std::string::npos)
      << again.err;
  EXPECT_EQ(ReadAll(Report()), after);
}

TEST_F(SignVerb, SignsNothingBesideAFileThatWasEdited) {
  TakeRun({"run"});
  for (const std::string name : {"strain.json", "residuals.csv", "report.pdf", "audit.jsonl"}) {
    const std::string kept = ReadAll(results() / name);
    std::ofstream(results() / name, std::ios::app) << "% edited\n";
    const std::string before = ReadAll(Report());
    const ProgramRun run = RunTelestrain(Words(
        {"--role", "operator", "--p12", File("both.p12"), "--password-file", File("password")}));
    EXPECT_EQ(run.exit_code, 3) << name;
    EXPECT_NE(run.err.find(name), std::string::npos) << run.err;
    EXPECT_TRUE(ReadAll(Report()) == before) << name;
    std::ofstream(results() / name, std::ios::binary) << kept;
  }
  fs::remove(results() / "residuals.csv");
  const ProgramRun run = RunTelestrain(Words(
      {"--role", "operator", "--p12", File("both.p12"), "--password-file", File("password")}));
  EXPECT_NE(run.err.find("residuals.csv is missing, which line"), std::string::npos) << run.err;
}

TEST_F(SignVerb, KeepsPermissionsAndLinksAndTellsTheTrailBesideTheSignedFile) {
  TakeRun({"run"});
  const auto sign = [&](const std::string& report, const std::string& out = "") {
    std::vector<std::string> words = {
        "sign",  report,           "--role",          "operator",
        "--p12", File("both.p12"), "--password-file", File("password")};
    if (!out.empty()) words.insert(words.end(), {"--out", out});
    return RunTelestrain(words);
  };
  const fs::path elsewhere = scratch() / "elsewhere";
  fs::create_directories(elsewhere);
  const std::string trail = ReadAll(results() / "audit.jsonl"), before = ReadAll(Report());
  EXPECT_EQ(sign(Report(), (elsewhere / "report.pdf").string()).exit_code, 0);
  EXPECT_EQ(ReadAll(Report()), before);
  EXPECT_EQ(ReadAll(results() / "audit.jsonl"), trail);
  EXPECT_EQ(sign(Report(), (results() / "signed.pdf").string()).exit_code, 0);
  EXPECT_NE(ReadAll(results() / "audit.jsonl").find(R"("file":"signed.pdf")"), std::string::npos);

  fs::permissions(Report(), fs::perms::owner_read | fs::perms::owner_write);
  const fs::path link = elsewhere / "link.pdf";
  fs::create_symlink(fs::absolute(Report()), link);
  EXPECT_EQ(sign(link.string()).exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_TRUE(ReadAll(Report()).starts_with(before));
  EXPECT_GT(ReadAll(Report()).size(), before.size());
  EXPECT_EQ(fs::status(Report()).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(SignVerb, SignsNothingBesideADamagedTrail) {
  TakeRun({"run"});
  const std::string before = ReadAll(Report());
  std::ofstream(results() / "audit.jsonl", std::ios::app) << "no line of a trail\n";
  const ProgramRun run = RunTelestrain(Words(
      {"--role", "operator", "--p12", File("both.p12"), "--password-file", File("password")}));
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_EQ(ReadAll(Report()), before);
}

// Instrument and operator at once: whoever comes second signs what the first made, or is refused.
TEST_F(SignVerb, TwoAtOnceLoseNoSignature) {
  TakeRun({"run"});
  const auto words = [&](const char* role) {
    return Words({"--role", role, "--p12", File("both.p12"), "--password-file", File("password")});
  };
  RunningTelestrain instrument(words("instrument")), person(words("operator"));
  const int done = (instrument.Wait().exit_code == 0) + (person.Wait().exit_code == 0);
  EXPECT_GE(done, 1);
  const auto count = [](const std::string& text, const std::string& wanted) {
    int found = 0;
    for (std::size_t at = 0; (at = text.find(wanted, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  EXPECT_EQ(count(ReadAll(Report()), "/ByteRange ["), done);
  EXPECT_EQ(count(ReadAll(results() / "audit.jsonl"), R"("type":"sign")"), done);
  // A file of certificates that has none is bad input, no verdict.
  std::ofstream(scratch() / "empty.pem");
  EXPECT_EQ(RunTelestrain({"audit", "verify", Report(), "--trust", File("empty.pem")}).exit_code,
            3);
}

TEST_F(SignVerb, SaysWhatIsMissing) {
  fs::create_directories(results());
  std::ofstream(Report()) << "no PDF";
  const auto expect = [&](std::vector<std::string> more, int code, const std::string& wanted) {
    const ProgramRun run = RunTelestrain(Words(std::move(more)));
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_NE((run.err + run.out).find(wanted), std::string::npos) << run.err << run.out;
  };
  const std::string p12 = File("both.p12"), password = File("password");
  expect({"--role", "operator"}, 2, "give --p12 FILE, or --key FILE with --cert FILE");
  expect({"--role", "boss", "--p12", p12}, 2, "--role");
  expect({"--role", "operator", "--p12", p12, "--time", "yesterday"}, 2, "want ISO 8601");
  expect({"--role", "operator", "--p12", p12}, 3, "there is no terminal to ask");
  expect({"--role", "operator", "--p12", p12, "--password-file", password}, 3, "is not a PDF");
  std::ofstream(scratch() / "large") << std::string(5000, 'x');
  expect({"--role", "operator", "--p12", p12, "--password-file", File("large")}, 3,
         "is larger than 4096 bytes");
  EXPECT_EQ(ReadAll(Report()), "no PDF");
}

}  // namespace
}  // namespace telestrain::testing_support
