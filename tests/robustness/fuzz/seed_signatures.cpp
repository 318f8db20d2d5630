#include <qpdf/Buffer.hh>
#include <qpdf/JSON.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFWriter.hh>

#include "base/files.h"
#include "report/audit/audit_trail.h"
#include "report/pdf_sample.h"
#include "report/signature/certificate.h"
#include "report/signature/der.h"
#include "report/signature/signed_data.h"
#include "report/signature/signed_layout.h"
#include "report/signature_pki.h"
#include "report/signature_reports.h"
#include "robustness/fuzz/seed_files.h"

namespace telestrain::fuzz {
namespace {

// The same PDF with nothing in its fonts and pictures and without compression, up to its
// cross-reference table, with the root as object 1: the target adds the table, so that changed
// bytes can still be read.
std::string PlainBody(const std::string& bytes) {
  QPDF pdf;
  pdf.processMemoryFile("seed", bytes.data(), bytes.size());
  constexpr std::size_t kLongestStream = 10000;  // fonts, pictures and profiles are longer
  for (QPDFObjectHandle object : pdf.getAllObjects())
    if (object.isStream() && object.getStreamData()->getSize() > kLongestStream)
      object.replaceStreamData("", QPDFObjectHandle::newNull(), QPDFObjectHandle::newNull());
  QPDFWriter writer(pdf);
  writer.setOutputMemory();
  writer.setStaticID(true);
  writer.setStreamDataMode(qpdf_s_uncompress);
  writer.setObjectStreamMode(qpdf_o_disable);
  writer.write();
  const auto buffer = writer.getBufferSharedPointer();
  const std::string text(reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize());
  return text.substr(0, text.rfind("xref\n0 "));
}

void WritePdfs(const Seeds& seeds) {
  seeds.Write("pdf", "sample", PlainBody(SamplePdf(ArchiveLevel::k3a)));
  seeds.Write("pdf", "fields", PlainBody(UnsignedReport()));
  seeds.Write("pdf", "unsigned", UnsignedReport());
  seeds.Write("pdf", "signed", SignedBy(1));
}

// The CMS in the file's first signature.
std::string ContentsOf(const std::string& report) {
  const RawSignature raw = ReadSignedLayout(report).signatures.at(0);
  const std::string hex = report.substr(raw.gap_begin + 1, raw.gap_end - raw.gap_begin - 2);
  const std::string bytes = BytesOfHex(hex).value();
  return bytes.substr(0, DerLength(bytes));
}

void WriteSignatures(const Seeds& seeds) {
  const std::string cms = ContentsOf(SignedBy(1));
  const TestPki& pki = Pki();
  seeds.Write("signature", "der", "d" + cms);
  seeds.Write("signature", "cms", "s" + cms);
  seeds.Write("signature", "token", "t" + cms);
  for (const auto& [name, identity] :
       {std::pair("operator", &pki.operator_), std::pair("root", &pki.root),
        std::pair("stamper", &pki.stamper)}) {
    seeds.Write("signature", std::string("certificate-") + name, "c" + identity->Der());
    seeds.Write("signature", std::string("pem-") + name,
                "k" + identity->Pem() + identity->KeyPem());
  }
  seeds.Write("signature", "locked", "k" + pki.operator_.KeyPem("x") + pki.operator_.Pem());
  seeds.Write("signature", "pkcs12", "k" + Pkcs12(pki.operator_, pki.root, "x"));
  const Identity instrument = Issue({.name = "log", .key = "ED25519"});
  seeds.Write("signature", "ed25519", "k" + instrument.KeyPem());
  seeds.Write("signature", "hex", "h00ffA0");
}

void WriteTrails(const Seeds& seeds) {
  const auto file = [](const char* of, const char* path, const std::string& bytes) {
    return nlohmann::ordered_json{
        {"of", of}, {"path", path}, {"bytes", bytes.size()}, {"sha256", Sha256Hex(bytes)}};
  };
  const auto line = [](const char* type, const nlohmann::ordered_json& body) {
    return nlohmann::ordered_json{{"type", type}, {"time", "2026-01-31"}, {"body", body}}.dump() +
           "\n";
  };
  const std::string toml = "toml\n", results = "{\"verdict\":\"pass\"}\n";
  const std::string bodies =
      line("open", {{"inputs", {file("session", "session.toml", toml)}},
                    {"outputs", {file("results", "session.toml", toml)}}}) +
      line("calibrate", {{"options", {{"outliers", "weigh"}, {"cull", {"0,0,1,1"}}}},
                         {"inputs", {file("results", "session.toml", toml)}},
                         {"outputs", {file("results", "results.json", results)}}}) +
      line("results", {{"inputs", {file("results", "session.toml", toml)}},
                       {"outputs", {file("results", "results.json", results)}}}) +
      line("sign", {{"role", "operator"}, {"signer", "Jane"}});
  const auto joined = [&](const std::string& name, const std::string& text) {
    return Joined({{name, text}, {"session.toml", toml}, {"results.json", results}});
  };
  seeds.Write("audit", "bodies", joined("bodies.jsonl", bodies));
  const std::filesystem::path file_path = WriteTestFile("fuzz.audit.jsonl", "");
  std::filesystem::remove(file_path);
  auto trail = AuditTrail::Open(file_path);
  for (const char* type : {"open", "detect", "results"})
    if (!trail->Append(type, {{"inputs", nlohmann::ordered_json::array()}}, "").ok())
      throw std::runtime_error("the seed's trail takes no line");
  if (!trail->Sync().ok()) throw std::runtime_error("the seed's trail is not written");
  seeds.Write("audit", "trail", joined("audit.jsonl", FileText(file_path)));
}

}  // namespace

void WriteSignatureSeeds(const Seeds& seeds) {
  WritePdfs(seeds);
  WriteSignatures(seeds);
  WriteTrails(seeds);
}

}  // namespace telestrain::fuzz
