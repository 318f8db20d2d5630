// Who may sign when, and that the signer's words change nothing.

#include <gtest/gtest.h>

#include "report/signature/opened_pdf.h"
#include "signature_reports.h"

namespace telestrain {
namespace {

Result<SignedReport> SignAt(const std::string& report, const std::string& role, long long time_s) {
  SignOptions options = OptionsOf(role);
  options.time_s = time_s;
  return SignReport("report.pdf", report, Pki().Of(role).ForSigning(), options);
}
void Nothing(QPDF&, PdfUpdate&) {}

// Signing refuses it, and the check fails when it was signed all the same.
void ExpectRefused(const std::string& report, const std::string& role, const SigningKey& key,
                   const std::string& wanted) {
  const auto made = SignReport("report.pdf", report, key, OptionsOf(role));
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::kBadInput);
  EXPECT_NE(made.error().message.find(wanted), std::string::npos) << made.error().message;
  const std::string failure = Check(Forge(report, role, key, Nothing)).failure;
  EXPECT_NE(failure.find(wanted), std::string::npos) << failure;
}

TEST(SignRules, WordsOfTheSignerAreOnlyWords) {
  for (const char* words :
       {"/ByteRange [0 1 2 3]", "/M (D:19990101000000Z)", "/T (instrument)", "\nendobj\n",
        "a) /Contents <00> /X (", "ETSI.CAdES startxref\n0\n%%EOF\n", "Geprüft 已检查"}) {
    SignOptions options = OptionsOf("operator");
    options.name = options.reason = options.place = words;
    const auto made =
        SignReport("report.pdf", UnsignedReport(), Pki().operator_.ForSigning(), options);
    ASSERT_TRUE(made) << words << made.error().message;
    const SignatureCheck check = Check(made->bytes);
    EXPECT_EQ(check.failure, "") << words;
    ASSERT_EQ(check.signatures.size(), 1U);
    EXPECT_EQ(check.signatures[0].claimed_time, "2026-01-31T12:00:00Z");
    EXPECT_EQ(check.signatures[0].role, "operator");
    EXPECT_EQ(Check(Sign(made->bytes, "reviewer")).failure, "");
  }
}

TEST(SignRules, TheSignerIsWhoTheCertificateNames) {
  SignOptions options = OptionsOf("operator");
  options.name = "Somebody else";
  const auto made =
      SignReport("report.pdf", UnsignedReport(), Pki().operator_.ForSigning(), options);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->signer, "Zhang Wei 张伟");
  EXPECT_EQ(Check(made->bytes).signatures.at(0).signer, "Zhang Wei 张伟");
  const OpenedPdf opened = OpenPdf(made->bytes);
  for (SignatureField& field : SignatureFieldsOf(*opened.pdf))
    if (field.IsSigned()) {
      EXPECT_EQ(field.field.getKey("/V").getKey("/Name").getUTF8Value(),
                "Zhang Wei 张伟 (Somebody else)");
    }
}

TEST(SignRules, NoEarlierRoleSignsAfterALaterOne) {
  ExpectRefused(Sign(UnsignedReport(), "approver"), "operator", Pki().operator_.ForSigning(),
                "operator: signs after the approver; the order is instrument, operator");
}

TEST(SignRules, APersonSignsInOneRole) {
  ExpectRefused(SignedBy(3), "approver", Pki().reviewer.ForSigning(),
                "approver: has the certificate that signed as reviewer (Jürgen Prüfer)");
}

TEST(SignRules, TimeDoesNotGoBack) {
  const auto later = SignAt(UnsignedReport(), "operator", kSigned_s + 60);
  ASSERT_TRUE(later) << later.error().message;
  ExpectRefused(later->bytes, "reviewer", Pki().reviewer.ForSigning(),
                "reviewer: its time, 2026-01-31T12:00:00Z, is before that of the operator");
  EXPECT_EQ(TimeText(Check(later->bytes).signatures.at(0)),
            "signed 2026-01-31T12:01:00Z by its own clock");
}

TEST(SignRules, CertificatesForServersSignNoDocuments) {
  const auto issue = [](const std::string& use) {
    return Issue({.name = "Somebody", .issuer = &Pki().root, .extended_usage = use}).ForSigning();
  };
  for (const char* use : {"serverAuth", "clientAuth,codeSigning", "timeStamping"})
    ExpectRefused(UnsignedReport(), "operator", issue(use), "not for signatures of documents");
  for (const char* use : {"emailProtection", "1.3.6.1.5.5.7.3.36", "1.2.840.113583.1.1.5",
                          "anyExtendedKeyUsage", "serverAuth,emailProtection"})
    EXPECT_EQ(Check(Sign(UnsignedReport(), "operator", issue(use))).failure, "") << use;
}

TEST(SignRules, CertificatesOfVersion1SayNotWhatTheyAreFor) {
  const Identity old = Issue({.name = "Old", .issuer = &Pki().root, .old_version = true});
  ExpectRefused(UnsignedReport(), "operator", old.ForSigning(),
                "the certificate of Old is of X.509 version 1");
}

TEST(SignRules, TheCertificateThatIsNotYetValidIsNamed) {
  const Identity young = Issue({.name = "Young division",
                                .issuer = &Pki().root,
                                .usage = "critical,keyCertSign",
                                .authority = true,
                                .from_s = kSigned_s + 60});
  SigningKey key = Issue({.name = "Below", .issuer = &young}).ForSigning();
  key.chain = {young.Der()};
  const std::string failure = Check(Sign(UnsignedReport(), "operator", key)).failure;
  EXPECT_NE(failure.find("certificate is not yet valid, that of Young division"), std::string::npos)
      << failure;
}

TEST(SignRules, TrustFilesMustHoldWholeCertificates) {
  const std::string pem = Pki().root.Pem();
  for (const std::string& text : {std::string(), std::string("text\n"), pem + pem.substr(0, 300)}) {
    const auto check = CheckSignatures(UnsignedReport(), {{WriteTestFile("trust.pem", text)}, {}});
    ASSERT_FALSE(check) << text;
    EXPECT_EQ(check.error().kind, ErrorKind::kBadInput);
  }
}

}  // namespace
}  // namespace telestrain
