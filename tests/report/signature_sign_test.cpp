// Signing a report, and what is refused.

#include <gtest/gtest.h>

#include <qpdf/Buffer.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFWriter.hh>

#include "base/files.h"
#include "pdf_structure_check.h"
#include "pdf_tools.h"
#include "report/signature/opened_pdf.h"
#include "report/signature/roles.h"
#include "signature_reports.h"

namespace telestrain {
namespace {

void ExpectRefused(const Result<SignedReport>& made, const std::string& wanted,
                   ErrorKind kind = ErrorKind::kBadInput) {
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, kind);
  EXPECT_NE(made.error().message.find(wanted), std::string::npos) << made.error().message;
}
Result<SignedReport> TrySign(const std::string& report, const std::string& role,
                             const SigningKey& key) {
  return SignReport("report.pdf", report, key, OptionsOf(role));
}

TEST(SignReport, FourRolesSignOneAfterTheOther) {
  const std::string& report = FourTimesSigned();
  EXPECT_TRUE(report.starts_with(UnsignedReport()));
  const SignatureCheck check = Check(report, {"instrument", "operator", "reviewer", "approver"});
  EXPECT_EQ(check.failure, "");
  ASSERT_EQ(check.signatures.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(check.signatures[i].role, kSigningRoles[i]);
    EXPECT_EQ(check.signatures[i].claimed_time, "2026-01-31T12:00:00Z");
    EXPECT_EQ(check.signatures[i].timestamp_time, "");
  }
  EXPECT_EQ(check.signatures[1].signer, "Zhang Wei 张伟");
  EXPECT_EQ(check.signatures[1].fingerprint, Sha256Hex(Pki().operator_.Der()));
  EXPECT_EQ(check.signatures[3].signed_bytes, report.size());
}

TEST(SignReport, OtherProgramsFindAllFourValid) {
  const std::string file = WriteTestFile("signed.pdf", FourTimesSigned()).string();
  NEEDS_TOOL(TELESTRAIN_TOOL_QPDF, "qpdf");
  const ToolRun check = RunTool(std::string(TELESTRAIN_TOOL_QPDF) + " --check '" + file + "'");
  EXPECT_TRUE(check.ok) << check.output;
  NEEDS_TOOL(TELESTRAIN_TOOL_PDFSIG, "pdfsig");
  const std::string output =
      RunTool("HOME=/nonexistent " + std::string(TELESTRAIN_TOOL_PDFSIG) + " '" + file + "'")
          .output;
  std::size_t valid = 0;
  for (std::size_t at = 0; (at = output.find("Signature is Valid", at)) != std::string::npos; ++at)
    ++valid;
  EXPECT_EQ(valid, 4U) << output;
  EXPECT_NE(output.find("Total document signed"), std::string::npos) << output;
}

TEST(SignReport, TheSameKeyTimeAndReportGiveTheSameBytes) {
  EXPECT_EQ(Sign(UnsignedReport(), "instrument"), Sign(UnsignedReport(), "instrument"));
}

TEST(SignReport, DrawsInTheFieldWithEmbeddedFontsAndNoTransparency) {
  const std::string report = SignedBy(1);
  const OpenedPdf opened = OpenPdf(report);
  ASSERT_TRUE(opened.pdf) << opened.failure;
  SignatureField field = SignatureFieldsOf(*opened.pdf).at(0);
  QPDFObjectHandle drawn = field.field.getKey("/AP").getKey("/N").getDict();
  EXPECT_FALSE(drawn.hasKey("/Group"));
  const auto box = field.field.getKey("/Rect").getArrayAsRectangle();
  const auto inner = drawn.getKey("/BBox").getArrayAsRectangle();
  EXPECT_NEAR(inner.urx - inner.llx, box.urx - box.llx, 1e-3);  // PDF numbers have 5 decimals
  EXPECT_NEAR(inner.ury - inner.lly, box.ury - box.lly, 1e-3);
  const auto fonts = drawn.getKey("/Resources").getKey("/Font").getDictAsMap();
  EXPECT_GE(fonts.size(), 2U);
  for (auto [name, font] : fonts) {
    QPDFObjectHandle descriptor =
        font.getKey("/DescendantFonts").getArrayItem(0).getKey("/FontDescriptor");
    EXPECT_TRUE(descriptor.getKey("/FontFile2").isStream()) << name;
  }
}

TEST(SignReport, KeepsTheTagsOfThePagesWhole) {
  std::string faults;
  for (const std::string& fault : StructureFaults(FourTimesSigned())) faults += fault + "\n";
  EXPECT_EQ(faults, "");
}

TEST(SignReport, AddsAnInvisibleFieldWhereTheReportHasNone) {
  std::string report = ReportWithoutFields();
  for (const std::string_view role : kSigningRoles) report = Sign(report, std::string(role));
  const SignatureCheck check = Check(report);
  EXPECT_EQ(check.failure, "");
  EXPECT_EQ(check.signatures.size(), 4U);
}

TEST(SignReport, PeopleMaySignWithoutTheInstrumentAndLeaveARoleOut) {
  EXPECT_EQ(Check(Sign(Sign(UnsignedReport(), "operator"), "approver")).failure, "");
}

TEST(SignReport, ARoleSignsOnceAndTheInstrumentFirst) {
  const std::string report = SignedBy(2);
  const SigningKey key = Pki().operator_.ForSigning();
  ExpectRefused(TrySign(report, "operator", key), "the operator has already signed");
  ExpectRefused(TrySign(Sign(UnsignedReport(), "operator"), "instrument", key),
                "the instrument seals first, but the operator has signed");
  ExpectRefused(TrySign(report, "director", key), "none of instrument, operator",
                ErrorKind::kUsage);
}

TEST(SignReport, RefusesFilesThatAreNotOursOrDamaged) {
  const SigningKey key = Pki().operator_.ForSigning();
  ExpectRefused(TrySign("no PDF at all", "operator", key), "report.pdf: is not a PDF");
  std::string cut = UnsignedReport();
  cut.resize(cut.size() / 2);
  ExpectRefused(TrySign(cut, "operator", key), "the PDF is damaged");
  std::string foreign = UnsignedReport();
  for (std::size_t at = 0; (at = foreign.find("telestrain 0.1.0", at)) != std::string::npos;)
    foreign.replace(at, 16, "another program ");
  ExpectRefused(TrySign(foreign, "operator", key), "is no report that telestrain wrote");
}

TEST(SignReport, RefusesEncryptedFiles) {
  QPDF pdf;
  pdf.processMemoryFile("report", UnsignedReport().data(), UnsignedReport().size());
  QPDFWriter writer(pdf);
  writer.setOutputMemory();
  writer.setR6EncryptionParameters("", "owner", true, true, true, true, true, true, qpdf_r3p_full,
                                   true);
  writer.write();
  const auto buffer = writer.getBufferSharedPointer();
  const std::string locked(reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize());
  ExpectRefused(TrySign(locked, "operator", Pki().operator_.ForSigning()), "the PDF is encrypted");
}

TEST(SignReport, RefusesAReportThatWasChangedAfterASignature) {
  std::string report = SignedBy(1);
  report[report.find("stream") + 20] ^= 1;
  const auto made = TrySign(report, "operator", Pki().operator_.ForSigning());
  ASSERT_FALSE(made);
  ExpectRefused(TrySign(SignedBy(1) + "% more\n", "operator", Pki().operator_.ForSigning()),
                "report.pdf: ");
}

TEST(SignReport, RefusesCertificatesThatAreNotValidOrNotForSignatures) {
  const auto refuse = [](IdentityRequest request, const std::string& wanted) {
    request.name = "Somebody";
    request.issuer = &Pki().root;
    ExpectRefused(TrySign(UnsignedReport(), "operator", Issue(request).ForSigning()), wanted);
  };
  refuse({.until_s = kSigned_s - 1}, "expired at 2026-01-31T11:59:59Z");
  refuse({.from_s = kSigned_s + 1}, "is valid only from 2026-01-31T12:00:01Z");
  refuse({.usage = "critical,keyEncipherment"}, "is not for signatures");
}

}  // namespace
}  // namespace telestrain
