// Reports, keys, certificates, layouts and logos that are damaged or of another kind.
#include <gtest/gtest.h>

#include <fstream>

#include "integration/small_run.h"
#include "report/audit/ed25519_key.h"
#include "report/reading/pdf_contents.h"
#include "report/signature/certificate.h"
#include "report/signature/opened_pdf.h"
#include "report/signature_pki.h"
#include "report/template_folder.h"
#include "robustness/bad_input/damaged_folder.h"
#include "robustness/bad_input/verb_run.h"
#include "unit/base/scratch_folder.h"

namespace telestrain::testing_support {
namespace {

namespace fs = std::filesystem;

class DamagedReport : public SmallRun {};

TEST_F(DamagedReport, IsRefusedWithTheReason) {
  const std::string pdf = ReadAll(Results() / "report.pdf");
  ASSERT_TRUE(ReadPdfContents("dir/report.pdf", pdf).ok());
  ::testing::internal::CaptureStderr();
  for (const Damaged& damage : Truncations(pdf, 40)) {
    const auto contents = ReadPdfContents("dir/report.pdf", damage.bytes);
    ASSERT_FALSE(contents.ok()) << damage.what;
    EXPECT_EQ(FaultOfMessage(contents.error().message, "dir/report.pdf"), "")
        << contents.error().message;
    EXPECT_NE(OpenPdf(damage.bytes).failure, "") << damage.what;
  }
  for (const Damaged& damage : Flips(pdf, 15)) {
    const auto contents = ReadPdfContents("dir/report.pdf", damage.bytes);
    if (!contents) {
      EXPECT_EQ(FaultOfMessage(contents.error().message, "dir/report.pdf"), "")
          << contents.error().message;
    }
    OpenPdf(damage.bytes);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

class DamagedKey : public ::testing::Test {
 protected:
  static Result<SigningKey> Load(const std::vector<std::string>& sources, int* asked = nullptr) {
    return LoadSigningKey({sources, [asked](const std::string&) -> Result<std::string> {
                             if (asked) ++*asked;
                             return std::string("secret");
                           }});
  }
  static void ExpectRefused(const std::string& name, const std::string& bytes) {
    const std::string file = WriteTestFile(name, bytes).string();
    const auto key = Load({file});
    ASSERT_FALSE(key.ok()) << name;
    EXPECT_EQ(key.error().kind, ErrorKind::kBadInput);
    EXPECT_EQ(FaultOfMessage(key.error().message, ""), "") << key.error().message;
  }
};

TEST_F(DamagedKey, CutShortOrChanged) {
  const Identity& signer = Pki().operator_;
  const std::string p12 = Pkcs12(signer, Pki().root, "secret");
  ASSERT_TRUE(Load({WriteTestFile("whole.p12", p12).string()}).ok());
  for (const Damaged& damage : Truncations(p12, 12)) ExpectRefused("cut.p12", damage.bytes);
  for (const Damaged& damage : Flips(p12, 12)) {
    const auto key = Load({WriteTestFile("flipped.p12", damage.bytes).string()});
    if (!key) {
      EXPECT_EQ(FaultOfMessage(key.error().message, ""), "") << key.error().message;
    }
  }
  for (const Damaged& damage : Truncations(signer.KeyPem(), 12))
    ExpectRefused("cut.pem", damage.bytes);
  ExpectRefused("large.pem", std::string(3 << 20, 'x'));
}

TEST_F(DamagedKey, OfAnotherKind) {
  for (const std::string kind : {"P-521", "RSA1024", "ED25519"}) {
    IdentityRequest request;
    request.name = kind;
    request.key = kind;
    const Identity other = Issue(request);
    ExpectRefused("other.pem", other.KeyPem() + other.Pem());
  }
  ExpectRefused("certificate.pem", Pki().root.Pem());
  ExpectRefused("unfit.pem", Pki().operator_.KeyPem() + Pki().root.Pem());
  const fs::path key = WriteTestFile("locked.pem", Pki().operator_.KeyPem("secret"));
  const auto instrument = Ed25519Key::ReadPrivate(key);
  ASSERT_FALSE(instrument.ok());
  EXPECT_EQ(FaultOfMessage(instrument.error().message, "locked.pem"), "");
}

TEST_F(DamagedKey, CertificatesCutShort) {
  for (const Damaged& damage : Truncations(Pki().root.Pem(), 20)) {
    const auto read = ReadCertificates({WriteTestFile("cut.crt", damage.bytes)});
    if (!read) {
      EXPECT_EQ(FaultOfMessage(read.error().message, "cut.crt"), "") << read.error().message;
    }
  }
}

class DamagedLayout : public SmallRun {};

TEST_F(DamagedLayout, NamesItsFile) {
  const ScratchFolder scratch("telestrain_bad_layout_");
  const fs::path own = scratch.path() / "own";
  fs::create_directories(own / "texts");
  const std::string layout = TemplateFolder::BuiltIn("strain.json").text;
  const auto refused = [&](const std::string& bytes) {
    std::ofstream(own / "mine.json", std::ios::binary) << bytes;
    ::testing::internal::CaptureStderr();
    const VerbRun run =
        RunVerb({"report", Results().string(), "--templates", own.string(), "--template", "mine"});
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_TRUE(run.exit_code == 3 || run.exit_code == 2) << run.exit_code << run.err;
    EXPECT_EQ(FaultOfMessage(run.err, "mine"), "") << run.err;
  };
  const auto before = BytesBelow(Results());
  for (const Damaged& damage : Truncations(layout, 12)) refused(damage.bytes);
  refused(std::string(100000, '['));
  refused(R"({"schema": 1, "schema": 2})");
  refused(std::string(2 << 20, ' ') + layout);
  refused("{\"title\": \"\xff\"}");
  fs::remove(own / "mine.json");
  fs::create_directory(own / "mine.json");
  const VerbRun run =
      RunVerb({"report", Results().string(), "--templates", own.string(), "--template", "mine"});
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_EQ(BytesBelow(Results()), before);
}

}  // namespace
}  // namespace telestrain::testing_support
