// What somebody may try with a signed report, and what the check says.

#include <gtest/gtest.h>

#include <qpdf/QPDF.hh>

#include "report/signature/opened_pdf.h"
#include "report/signature/pdf_update.h"
#include "report/signature/signed_layout.h"
#include "signature_reports.h"

namespace telestrain {
namespace {

using Object = QPDFObjectHandle;

void ExpectFailure(const std::string& report, const std::string& wanted) {
  const SignatureCheck check = Check(report);
  EXPECT_NE(check.failure.find(wanted), std::string::npos) << "says: " << check.failure;
}

const SigningKey& Trusted() {
  static const SigningKey kKey = Pki().approver.ForSigning();
  return kKey;
}
const SigningKey& Stranger() {
  static const SigningKey kKey = Issue({.name = "Ana Approver"}).ForSigning();
  return kKey;
}

void BlankPageOne(QPDF& pdf, PdfUpdate& update) {
  Object page = pdf.getAllPages().at(0);
  Object content = page.getKey("/Contents");
  if (content.isArray()) content = content.getArrayItem(0);
  content.replaceStreamData("q Q", Object::newNull(), Object::newNull());
  update.Touch(content);
}
void Nothing(QPDF&, PdfUpdate&) {}

TEST(SignatureAttack, AByteOfThePageIsFlipped) {
  std::string report = FourTimesSigned();
  report[report.find("stream") + 30] ^= 1;
  ExpectFailure(report, "approver: the file or the certificate was changed after signing");
}

TEST(SignatureAttack, BytesAreAppended) {
  ExpectFailure(FourTimesSigned() + "% comment\n", "does not cover the last 10 bytes");
}

TEST(SignatureAttack, AnUpdateIsAppendedWithoutASignature) {
  ExpectFailure(FourTimesSigned() + UnsignedReport(),
                "approver: the last signature does not cover");
  const std::string unsigned_twice = UnsignedReport() + UnsignedReport();
  EXPECT_EQ(Check(unsigned_twice).failure, "the file has a revision that no signature made");
}

TEST(SignatureAttack, APageIsBlankedAndSignedByAStranger) {
  ExpectFailure(Forge(SignedBy(3), "approver", Stranger(), BlankPageOne),
                "approver: the certificate of Ana Approver is not trusted");
}

TEST(SignatureAttack, APageIsBlankedAndSignedBySomebodyTrusted) {
  ExpectFailure(Forge(SignedBy(3), "approver", Trusted(), BlankPageOne),
                "after the signature of the reviewer, page 1's content (object");
}

TEST(SignatureAttack, AnotherCertificateWithTheSameName) {
  ExpectFailure(Sign(SignedBy(3), "approver", Stranger()),
                "approver: the certificate of Ana Approver is not trusted");
}

TEST(SignatureAttack, AnAttachmentIsExchangedAndSigned) {
  const auto exchange = [](QPDF& pdf, PdfUpdate& update) {
    Object file = pdf.getRoot().getKey("/AF").getArrayItem(0).getKey("/EF").getKey("/F");
    file.replaceStreamData(R"({"verdict": "fail"})", Object::newNull(), Object::newNull());
    update.Touch(file);
  };
  ExpectFailure(Forge(SignedBy(3), "approver", Trusted(), exchange),
                "the attachment results.json (object");
}

TEST(SignatureAttack, APageIsAddedAndSigned) {
  const auto add = [](QPDF& pdf, PdfUpdate& update) {
    Object pages = pdf.getRoot().getKey("/Pages");
    Object page = pdf.makeIndirectObject(
        Object::parse("<< /Type /Page /MediaBox [0 0 595 842] /Resources << >> >>"));
    page.replaceKey("/Parent", pages);
    pages.getKey("/Kids").appendItem(page);
    pages.replaceKey("/Count", Object::newInteger(3));
    update.Touch(pages);
  };
  ExpectFailure(Forge(SignedBy(3), "approver", Trusted(), add), "the list of pages (object");
}

TEST(SignatureAttack, TheFieldIsMovedOverTheVerdictAndSigned) {
  const auto move = [](QPDF& pdf, PdfUpdate&) {
    for (SignatureField& field : SignatureFieldsOf(pdf))
      if (field.role == "approver")
        field.field.replaceKey("/Rect", Object::newFromRectangle({0, 0, 595, 842}));
  };
  ExpectFailure(Forge(SignedBy(3), "approver", Trusted(), move), "the field of the approver");
}

TEST(SignatureAttack, ACoveringAnnotationIsAddedAndSigned) {
  const auto cover = [](QPDF& pdf, PdfUpdate& update) {
    Object page = pdf.getAllPages().at(0);
    if (!page.getKey("/Annots").isArray()) page.replaceKey("/Annots", Object::newArray());
    page.getKey("/Annots").appendItem(pdf.makeIndirectObject(
        Object::parse("<< /Type /Annot /Subtype /Square /F 4 /Rect [0 0 595 842] /IC [1 1 1] >>")));
    update.Touch(page.getKey("/Annots").isIndirect() ? page.getKey("/Annots") : page);
  };
  ExpectFailure(Forge(SignedBy(3), "approver", Trusted(), cover), "page 1");
}

TEST(SignatureAttack, AnEarlierSignatureIsReplacedAndSigned) {
  const auto replace = [](QPDF& pdf, PdfUpdate& update) {
    SignatureField field = SignatureFieldsOf(pdf).at(1);
    Object value = field.field.getKey("/V");
    value.replaceKey("/Name", Object::newString("Somebody else"));
    update.Touch(value);
  };
  ExpectFailure(Forge(SignedBy(3), "approver", Trusted(), replace),
                "approver: its signature or the update it came with was changed");
}

TEST(SignatureAttack, ASignatureIsRemovedFromItsField) {
  const auto remove = [](QPDF& pdf, PdfUpdate& update) {
    SignatureField field = SignatureFieldsOf(pdf).at(1);
    field.field.removeKey("/V");
    update.Touch(field.field);
  };
  ExpectFailure(Forge(SignedBy(3), "approver", Trusted(), remove), "the field of the operator");
}

// The file cannot know of a signature that was cut off; who asks for the role does.
TEST(SignatureAttack, TheLastSignatureIsCutOff) {
  EXPECT_EQ(Check(SignedBy(3)).failure, "");
  EXPECT_EQ(Check(SignedBy(3), {"approver"}).failure, "approver: has not signed");
  EXPECT_EQ(Check(UnsignedReport(), {"operator"}).failure, "operator: has not signed");
}

TEST(SignatureAttack, ASignatureIsCutOutOfTheMiddle) {
  const SignedLayout layout = ReadSignedLayout(FourTimesSigned());
  ASSERT_EQ(layout.signatures.size(), 4U) << layout.failure;
  std::string report = FourTimesSigned();
  report.erase(layout.signatures[1].begin, layout.signatures[1].end - layout.signatures[1].begin);
  EXPECT_NE(Check(report).failure, "");
}

TEST(SignatureAttack, HexDigitsOfContentsChangeCase) {
  const SignedLayout layout = ReadSignedLayout(FourTimesSigned());
  ASSERT_EQ(layout.signatures.size(), 4U) << layout.failure;
  for (const RawSignature& signature : layout.signatures) {
    std::string report = FourTimesSigned();
    char& digit = report[report.find_first_of("abcdef", signature.gap_begin)];
    digit = static_cast<char>(digit - 'a' + 'A');
    ExpectFailure(report, signature.role + ": its signature or the update");
  }
}

TEST(SignatureAttack, TheSealIsTakenOffOrMadeLoose) {
  const auto loosen = [](QPDF& pdf, PdfUpdate& update) {
    pdf.getRoot().removeKey("/Perms");
    update.Touch(pdf.getRoot());
  };
  ExpectFailure(Forge(SignedBy(3), "approver", Trusted(), loosen), "the catalog (object");
  // A seal that is no seal: the instrument signs without DocMDP.
  ExpectFailure(Forge(UnsignedReport(), "instrument", Pki().instrument.ForSigning(), Nothing),
                "does not forbid changes (DocMDP, P 2)");
}

TEST(SignatureAttack, ARoleSignsTwice) {
  const auto twin = [](QPDF& pdf, PdfUpdate& update) {
    Object form = pdf.getRoot().getKey("/AcroForm");
    SignatureField first = SignatureFieldsOf(pdf).at(1);
    Object field = pdf.makeIndirectObject(first.field.shallowCopy());
    form.getKey("/Fields").appendItem(field);
    update.Touch(form.getKey("/Fields").isIndirect() ? form.getKey("/Fields") : form);
  };
  EXPECT_NE(Check(Forge(SignedBy(3), "approver", Trusted(), twin)).failure, "");
  ExpectFailure(Forge(SignedBy(2), "operator", Trusted(), Nothing), "the field of the operator");
}

TEST(SignatureAttack, InformationAndMetadataAreChangedAndSigned) {
  const auto inform = [](QPDF& pdf, PdfUpdate& update) {
    Object info = pdf.getTrailer().getKey("/Info");
    info.replaceKey("/Title", Object::newString("Another report"));
    update.Touch(info);
  };
  ExpectFailure(Forge(SignedBy(3), "approver", Trusted(), inform), "the document's information");
  const auto exchange = [](QPDF& pdf, PdfUpdate&) {
    pdf.getTrailer().replaceKey(
        "/Info", pdf.makeIndirectObject(Object::parse("<< /Creator (telestrain) >>")));
  };
  ExpectFailure(Forge(SignedBy(3), "approver", Trusted(), exchange), "the trailer's /Info");
}

TEST(SignatureAttack, NobodyIsTrustedWithoutACertificate) {
  const auto check = CheckSignatures(FourTimesSigned(), {});
  ASSERT_TRUE(check);
  EXPECT_NE(check->failure.find("whose signatures these are cannot be decided"), std::string::npos);
  EXPECT_EQ(CheckSignatures(UnsignedReport(), {})->failure, "");
  EXPECT_FALSE(CheckSignatures(FourTimesSigned(), {{"/nonexistent.pem"}, {}}));
}

}  // namespace
}  // namespace telestrain
