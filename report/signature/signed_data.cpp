#include "report/signature/signed_data.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "report/signature/certificate.h"
#include "report/signature/der.h"

namespace telestrain {
namespace {

using namespace std::string_view_literals;

// Object identifiers, encoded (RFC 5652, 3161, 5035, 3279, 5754, 5758).
constexpr auto kSignedData = "\x06\x09\x2A\x86\x48\x86\xF7\x0D\x01\x07\x02"sv;
constexpr auto kData = "\x06\x09\x2A\x86\x48\x86\xF7\x0D\x01\x07\x01"sv;
constexpr auto kTstInfo = "\x06\x0B\x2A\x86\x48\x86\xF7\x0D\x01\x09\x10\x01\x04"sv;
constexpr auto kTokenAttribute = "\x06\x0B\x2A\x86\x48\x86\xF7\x0D\x01\x09\x10\x02\x0E"sv;
constexpr auto kContentType = "\x06\x09\x2A\x86\x48\x86\xF7\x0D\x01\x09\x03"sv;
constexpr auto kMessageDigest = "\x06\x09\x2A\x86\x48\x86\xF7\x0D\x01\x09\x04"sv;
constexpr auto kSigningCertificate2 = "\x06\x0B\x2A\x86\x48\x86\xF7\x0D\x01\x09\x10\x02\x2F"sv;
constexpr auto kRsa = "\x06\x09\x2A\x86\x48\x86\xF7\x0D\x01\x01\x01"sv;
constexpr auto kEc = "\x06\x07\x2A\x86\x48\xCE\x3D\x02\x01"sv;

struct Digest {
  const char* name;
  std::string_view oid;
  std::string_view ecdsa;  // the signature algorithm with it
};
constexpr std::array kDigests = {Digest{"SHA256", "\x06\x09\x60\x86\x48\x01\x65\x03\x04\x02\x01"sv,
                                        "\x06\x08\x2A\x86\x48\xCE\x3D\x04\x03\x02"sv},
                                 Digest{"SHA384", "\x06\x09\x60\x86\x48\x01\x65\x03\x04\x02\x02"sv,
                                        "\x06\x08\x2A\x86\x48\xCE\x3D\x04\x03\x03"sv},
                                 Digest{"SHA512", "\x06\x09\x60\x86\x48\x01\x65\x03\x04\x02\x03"sv,
                                        "\x06\x08\x2A\x86\x48\xCE\x3D\x04\x03\x04"sv}};

std::string Joined(std::initializer_list<std::string_view> parts) {
  std::string whole;
  for (const std::string_view part : parts) whole.append(part);
  return whole;
}
std::string Sequence(std::initializer_list<std::string_view> parts) {
  return Der(kDerSequence, Joined(parts));
}
std::string SmallInteger(char value) { return Der(kDerInteger, {&value, 1}); }
std::string Attribute(std::string_view oid, const std::string& value) {
  return Sequence({oid, Der(kDerSet, value)});
}

// Walks down: the children of a node, if it has this tag and that many of them.
std::vector<DerNode> Children(const DerNode& node, unsigned char tag, std::size_t at_least) {
  if (node.tag != tag) return {};
  auto children = DerChildren(node.content);
  return children && children->size() >= at_least ? *children : std::vector<DerNode>();
}

std::string DigestName(const DerNode& algorithm) {
  const auto parts = Children(algorithm, kDerSequence, 1);
  for (const Digest& digest : kDigests)
    if (!parts.empty() && parts[0].whole == digest.oid) return digest.name;
  return "";
}

const Digest* DigestOf(const std::string& name) {
  for (const Digest& digest : kDigests)
    if (name == digest.name) return &digest;
  return nullptr;
}

// The token in the one unsigned attribute.
bool ReadTimeStamp(const DerNode& unsigned_attributes, SignedData* data) {
  const auto attributes = Children(unsigned_attributes, kDerContext1, 1);
  if (attributes.size() != 1) return false;
  const auto parts = Children(attributes[0], kDerSequence, 2);
  if (parts.size() != 2 || parts[0].whole != kTokenAttribute) return false;
  data->time_stamp = parts[1].content;
  return true;
}

// SignerInfo ::= {version, issuerAndSerial, digest, [0] attributes, algorithm, signature, [1]}.
bool ReadSigner(const DerNode& node, SignedData* data) {
  const auto parts = Children(node, kDerSequence, 6);
  if (parts.empty() || parts[3].tag != kDerContext0 || parts[5].tag != kDerOctets) return false;
  const auto& certificates = data->certificates;
  const auto signer =
      std::find_if(certificates.begin(), certificates.end(),
                   [&](const std::string& der) { return IssuerAndSerial(der) == parts[1].whole; });
  const auto attributes = DerChildren(parts[3].content);
  if (signer == certificates.end() || !attributes) return false;
  data->signer = static_cast<std::size_t>(signer - certificates.begin());
  data->digest = DigestName(parts[2]);
  for (const DerNode& attribute : *attributes) data->attributes.emplace_back(attribute.whole);
  data->signature = parts[5].content;
  // A token's own unsigned attributes are left out.
  if (parts.size() > 6 && data->kind == SignedData::Kind::kSignature)
    return ReadTimeStamp(parts[6], data);
  return !data->digest.empty();
}

// [0] EXPLICIT OCTET STRING; a signature of a PDF has none.
bool ReadContent(const DerNode& node, SignedData* data) {
  const auto parts = Children(node, kDerSequence, 1);
  if (data->kind == SignedData::Kind::kSignature) return parts.size() == 1;
  if (parts.size() != 2 || parts[0].whole != kTstInfo) return false;
  const auto octets = Children(parts[1], kDerContext0, 1);
  if (octets.size() != 1 || octets[0].tag != kDerOctets) return false;
  data->content = octets[0].content;
  return true;
}

// AlgorithmIdentifier of the signature.
std::string SignatureAlgorithm(const SignedData& data) {
  const std::string key = KeyAlgorithm(data.certificates[data.signer]);
  if (key == kRsa) return Sequence({kRsa, Der(kDerNull, "")});
  const Digest* digest = DigestOf(data.digest);
  return key == kEc && digest ? Sequence({digest->ecdsa}) : "";
}

std::string EncodeSigner(const SignedData& data, const std::string& digest) {
  const std::string token =
      data.time_stamp.empty() ? "" : Der(kDerContext1, Attribute(kTokenAttribute, data.time_stamp));
  return Sequence({SmallInteger(1), IssuerAndSerial(data.certificates[data.signer]), digest,
                   DerSetOf(kDerContext0, data.attributes), SignatureAlgorithm(data),
                   Der(kDerOctets, data.signature), token});
}

}  // namespace

std::optional<SignedData> ReadSignedData(std::string_view der, SignedData::Kind kind) {
  const auto outer = ReadDer(der);
  const auto info = outer ? Children(*outer, kDerSequence, 2) : std::vector<DerNode>();
  if (info.size() != 2 || info[0].whole != kSignedData) return std::nullopt;
  const auto wrapped = Children(info[1], kDerContext0, 1);
  const auto parts =
      wrapped.size() == 1 ? Children(wrapped[0], kDerSequence, 5) : std::vector<DerNode>();
  // Version, digests, content, certificates; lists of revoked ones may stand before the signer.
  if (parts.empty() || parts[3].tag != kDerContext0) return std::nullopt;
  SignedData data;
  data.kind = kind;
  const auto certificates = DerChildren(parts[3].content);
  if (!certificates || !ReadContent(parts[2], &data)) return std::nullopt;
  for (const DerNode& certificate : *certificates)
    data.certificates.emplace_back(certificate.whole);
  const auto signers = Children(parts.back(), kDerSet, 1);
  if (signers.size() != 1 || !ReadSigner(signers[0], &data)) return std::nullopt;
  return data;
}

std::string EncodeSignedData(const SignedData& data) {
  const Digest* known = DigestOf(data.digest);
  if (!known || data.signer >= data.certificates.size() || SignatureAlgorithm(data).empty())
    return "";
  const bool token = data.kind == SignedData::Kind::kTimeStamp;
  const std::string digest = Sequence({known->oid});
  const std::string content =
      token ? Sequence({kTstInfo, Der(kDerContext0, Der(kDerOctets, data.content))})
            : Sequence({kData});
  const std::string body = Sequence({SmallInteger(token ? 3 : 1), Der(kDerSet, digest), content,
                                     DerSetOf(kDerContext0, data.certificates),
                                     Der(kDerSet, EncodeSigner(data, digest))});
  return Sequence({kSignedData, Der(kDerContext0, body)});
}

std::string AttributesToSign(const SignedData& data) { return DerSetOf(kDerSet, data.attributes); }

std::vector<std::string> SignatureAttributes(std::string_view document_sha256,
                                             std::string_view certificate) {
  // SigningCertificateV2 ::= {certs {ESSCertIDv2 {certHash}}}; SHA-256 is its default.
  const std::string hash = Der(kDerOctets, Sha256(certificate));
  return {Attribute(kContentType, std::string(kData)),
          Attribute(kMessageDigest, Der(kDerOctets, document_sha256)),
          Attribute(kSigningCertificate2, Sequence({Sequence({Sequence({hash})})}))};
}

}  // namespace telestrain
