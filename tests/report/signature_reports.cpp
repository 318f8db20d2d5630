#include "signature_reports.h"

#include <gtest/gtest.h>

#include <qpdf/QPDF.hh>

#include "base/files.h"
#include "report/pdf_document.h"
#include "report/signature/certificate.h"
#include "report/signature/opened_pdf.h"
#include "report/signature/pdf_update.h"
#include "report/signature/roles.h"
#include "report/signature/signed_data.h"
#include "report/signature/utc_time.h"

namespace telestrain {
namespace {

struct NamedBox {
  std::string role;
  PageBox box;
};

std::vector<NamedBox> FourBoxes() {
  std::vector<NamedBox> boxes;
  double bottom_pt = 560;
  for (const std::string_view role : kSigningRoles) {
    boxes.push_back({std::string(role), {70, bottom_pt, 190, 46}});
    bottom_pt -= 60;
  }
  return boxes;
}

std::string MakeReport(const std::vector<NamedBox>& boxes) {
  auto created = PdfDocument::Create();
  if (!created) throw std::runtime_error(created.error().message);
  PdfDocument& pdf = **created;
  for (const char* text : {"Page one: the verdict is PASS", "Page two: signatures"}) {
    const ScopedTag heading(pdf, PdfTag{pdf.AddPage() == 0 ? "H1" : "P", ""});
    pdf.DrawText({}, {70, 700}, text);
  }
  pdf.Attach({.name = "results.json",
              .media_type = "application/json",
              .description = "results",
              .bytes = R"({"verdict": "pass", "measured": [1, 2, 3]})"});
  for (const auto& [role, box] : boxes) pdf.AddSignatureField(role, "Signature: " + role, box);
  PdfInfo info;
  info.title = "Report";
  info.creator = "telestrain 0.1.0";
  info.created = "D:20260131000000Z";
  auto bytes = pdf.Save(info, "seed");
  if (!bytes) throw std::runtime_error(bytes.error().message);
  return *bytes;
}

}  // namespace

const std::string& UnsignedReport() {
  static const std::string kReport = MakeReport(FourBoxes());
  return kReport;
}
const std::string& ReportWithoutFields() {
  static const std::string kReport = MakeReport({});
  return kReport;
}
std::string ReportWithBox(double left_pt, double bottom_pt, double width_pt, double height_pt) {
  return MakeReport({{"operator", {left_pt, bottom_pt, width_pt, height_pt}}});
}

SignOptions OptionsOf(const std::string& role) {
  SignOptions options;
  options.role = role;
  options.reason = "Results checked";
  options.place = "Laboratory 2";
  options.time_s = kSigned_s;
  return options;
}

std::string Sign(const std::string& report, const std::string& role, const SigningKey& key) {
  const auto made = SignReport("report.pdf", report, key, OptionsOf(role));
  EXPECT_TRUE(made) << made.error().message;
  return made ? made->bytes : "";
}
std::string Sign(const std::string& report, const std::string& role) {
  return Sign(report, role, Pki().Of(role).ForSigning());
}

std::string SignedBy(int count) {
  std::string report = UnsignedReport();
  for (int i = 0; i < count; ++i) report = Sign(report, std::string(kSigningRoles[i]));
  return report;
}
const std::string& FourTimesSigned() {
  static const std::string kReport = SignedBy(4);
  return kReport;
}

SignatureCheck Check(const std::string& report, std::vector<std::string> required_roles) {
  static const auto kRoot = WriteTestFile("root.pem", Pki().root.Pem());
  const auto check = CheckSignatures(report, {{kRoot}, std::move(required_roles)});
  EXPECT_TRUE(check) << check.error().message;
  return check ? *check : SignatureCheck{{}, "not checked"};
}

std::string Forge(const std::string& report, const std::string& role, const SigningKey& key,
                  const std::function<void(QPDF&, PdfUpdate&)>& change) {
  const OpenedPdf opened = OpenPdf(report);
  QPDF& pdf = *opened.pdf;
  PdfUpdate update(pdf, report);
  QPDFObjectHandle value = pdf.makeIndirectObject(QPDFObjectHandle::newDictionary());
  for (SignatureField& field : SignatureFieldsOf(pdf)) {
    if (field.role != role) continue;
    field.field.replaceKey("/V", value);
    update.Touch(field.field);
  }
  change(pdf, update);
  auto prepared = update.Write(value,
                               "/Type /Sig /Filter /Adobe.PPKLite /SubFilter "
                               "/ETSI.CAdES.detached\n/M (" +
                                   PdfTime(kSigned_s) + ")",
                               4096);
  SignedData data;
  data.certificates = {key.certificate};
  data.digest = "SHA256";
  data.attributes = SignatureAttributes(Sha256(prepared.SignedBytes()), key.certificate);
  data.signature = SignBytes(key, AttributesToSign(data)).value();
  const std::string hex = HexOf(EncodeSignedData(data));
  prepared.bytes.replace(prepared.gap_begin + 1, hex.size(), hex);
  return prepared.bytes;
}

}  // namespace telestrain
