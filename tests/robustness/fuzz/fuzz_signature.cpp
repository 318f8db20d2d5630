// What signatures are made of; the first character of an input chooses.
#include "report/audit/ed25519_key.h"
#include "report/signature/certificate.h"
#include "report/signature/der.h"
#include "report/signature/signed_data.h"
#include "report/signature/signing_key.h"
#include "report/signature/time_stamp.h"
#include "robustness/fuzz/fuzz_target.h"

namespace telestrain::fuzz {
namespace {

void TryDer(std::string_view bytes, int depth) {
  Require(DerLength(bytes) <= bytes.size(), "a node is no longer than its bytes");
  if (const auto node = ReadDer(bytes)) {
    Require(node->whole == bytes, "the one node is all bytes");
    Require(Der(node->tag, node->content) == node->whole, "a node is encoded in one way");
  }
  const auto children = DerChildren(bytes);
  if (!children || depth > 50) return;
  std::string joined;
  for (const DerNode& child : *children) {
    joined += child.whole;
    TryDer(child.content, depth + 1);
  }
  Require(joined == bytes, "the nodes are all bytes");
}

void TrySignedData(std::string_view der, SignedData::Kind kind) {
  const auto data = ReadSignedData(der, kind);
  if (!data) return;
  Require(data->certificates.empty() || data->signer < data->certificates.size(),
          "the signer is one of the certificates");
  static_cast<void>(AttributesToSign(*data));
  const std::string encoded = EncodeSignedData(*data);
  if (encoded.empty()) return;
  const auto again = ReadSignedData(encoded, kind);
  Require(again.has_value(), "encoded signed data can be read");
  Require(EncodeSignedData(*again) == encoded, "signed data are encoded in one way");
}

void TryTimeStamp(const std::string& token) {
  TrySignedData(token, SignedData::Kind::kTimeStamp);
  const TimeStamp stamp = CheckTimeStamp(token, "signature", {});
  Require(!stamp.failure.empty(), "a time stamp that nobody vouches for does not hold");
}

void TryCertificate(const std::string& der) {
  static_cast<void>(IssuerAndSerial(der) + KeyAlgorithm(der) + CommonName(der) + SubjectText(der));
  static_cast<void>(SigningUseFailure(der) + (ValidityOf(der) ? "valid" : ""));
  Require(!KeySigned(der, "SHA256", "bytes", "signature"), "no signature is no signature");
  for (const bool is_stamper : {false, true})
    static_cast<void>(ChainFailure({der, {der}, {der}, 1769860800, is_stamper}));
}

void TryKeyFiles(const MemoryFolder& folder) {
  const auto file = folder.path() / "key";
  const auto certificates = ReadCertificates({file});
  if (Succeeds(certificates))
    for (const std::string& certificate : *certificates) TryCertificate(certificate);
  Succeeds(Ed25519Key::ReadPrivate(file));
  const auto key = LoadSigningKey({{file.string()}, [](const std::string&) -> Result<std::string> {
                                     return std::string("x");
                                   }});
  if (Succeeds(key)) Succeeds(CheckSigningKey(*key, 1769860800));
}

void TryPublicKey(const std::string& pem) {
  const auto key = Ed25519Key::ReadPublic("key", pem);
  if (!Succeeds(key)) return;
  Require(!key->Verifies("text", pem.substr(0, 100)), "a key's beginning is no signature");
}

void TryHex(const std::string& text) {
  if (const auto bytes = BytesOfHex(text))
    Require(HexOf(*bytes).size() == text.size(), "two digits are a byte");
  Require(BytesOfHex(HexOf(text)) == text, "hexadecimal text reads back");
}

}  // namespace

void FuzzSignature(std::string_view input) {
  static MemoryFolder folder("signature_");
  if (input.empty()) return;
  const std::string bytes(input.substr(1));
  switch (input.front()) {
    case 'd':
      return TryDer(bytes, 0);
    case 's':
      return TrySignedData(bytes, SignedData::Kind::kSignature);
    case 't':
      return TryTimeStamp(bytes);
    case 'c':
      return TryCertificate(bytes);
    case 'k':
      folder.Hold({{"key", bytes}}, {"key"});
      return TryKeyFiles(folder);
    case 'p':
      return TryPublicKey(bytes);
    case 'h':
      return TryHex(bytes);
    default:
      return;
  }
}

}  // namespace telestrain::fuzz
