// What somebody may try with a signed report, and what the check says.

#include <gtest/gtest.h>

#include <qpdf/QPDF.hh>

#include "report/signature/opened_pdf.h"
#include "report/signature/pdf_update.h"
#include "report/signature/signature_boxes.h"
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

// The picture of the approver's signature, scaled up or larger than its box.
TEST(SignatureAttack, APictureLargerThanItsBoxIsDrawnAndSigned) {
  const auto draw = [](const std::string& facts) {
    return [facts](QPDF& pdf, PdfUpdate&) {
      for (SignatureField& field : SignatureFieldsOf(pdf)) {
        if (field.role != "approver") continue;
        Object picture = pdf.newStream("1 1 1 rg 0 0 595 842 re f");
        picture.replaceDict(Object::parse("<< /Type /XObject /Subtype /Form " + facts + " >>"));
        Object appearance = Object::newDictionary();
        appearance.replaceKey("/N", picture);
        field.field.replaceKey("/AP", appearance);
      }
    };
  };
  EXPECT_EQ(Check(Forge(SignedBy(3), "approver", Trusted(), draw("/BBox [0 0 190 46]"))).failure,
            "");
  for (const char* facts :
       {"/BBox [0 0 595 842]", "/BBox [0 0 0 0]", "/BBox [0 0 190 46] /Matrix [9 0 0 9 0 0]"})
    ExpectFailure(Forge(SignedBy(3), "approver", Trusted(), draw(facts)),
                  "the field of the approver");
}

TEST(SignatureAttack, ABoxThatCouldCoverThePageIsNotSigned) {
  const auto expect = [](const std::string& report, const std::string& wanted) {
    const auto made = SignReport("report.pdf", report, Trusted(), OptionsOf("operator"));
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find(wanted), std::string::npos) << made.error().message;
    ExpectFailure(Forge(report, "operator", Trusted(), Nothing), wanted);
  };
  expect(ReportWithBox(0, 0, 595, 842), "the box of the operator's signature has 595 × 842 pt");
  expect(ReportWithBox(500, 20, 190, 46), "the box of the operator's signature is not inside");
  EXPECT_EQ(Check(Sign(ReportWithBox(70, 20, 190, 46), "operator")).failure, "");
  const auto move = [](QPDF& pdf, PdfUpdate&) {
    for (SignatureField& field : SignatureFieldsOf(pdf))
      field.field.replaceKey("/Rect", Object::newFromRectangle({70, 70, 260, 116}));
  };
  const OpenedPdf opened = OpenPdf(UnsignedReport());
  QPDF& pdf = *opened.pdf;
  PdfUpdate unused(pdf, UnsignedReport());
  move(pdf, unused);
  EXPECT_EQ(BoxesFailure(pdf),
            "the box of the operator's signature overlaps that of the instrument");
}

TEST(SignatureAttack, AnObjectHasASecondGeneration) {
  std::string report = UnsignedReport();
  const auto exchange = [&](const std::string& was, const std::string& is) {
    for (std::size_t at = 0; (at = report.find(was, at)) != std::string::npos; at += is.size())
      report.replace(at, was.size(), is);
  };
  exchange("\n5 0 obj", "\n5 1 obj");
  exchange(" 5 0 R", " 5 1 R");
  const std::size_t table = report.find('\n', report.rfind("\nxref\n") + 6) + 1;
  report.replace(table + 5 * 20 + 11, 5, "00001");
  ExpectFailure(report, "an object of another generation than 0, number 5");
  const auto made = SignReport("report.pdf", report, Trusted(), OptionsOf("operator"));
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("another generation"), std::string::npos);
}

TEST(SignatureAttack, WhatNoSignatureNeedsIsAddedToTheCatalog) {
  const auto add = [](QPDF& pdf, PdfUpdate& update) {
    pdf.getRoot().replaceKey("/DSS", Object::newDictionary());
    update.Touch(pdf.getRoot());
  };
  ExpectFailure(Forge(SignedBy(3), "approver", Trusted(), add), "the catalog (object");
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
