#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace telestrain {

// X.509 certificates as DER, so that no header needs OpenSSL.

std::string Sha256(std::string_view bytes);  // 32 bytes
std::string HexOf(std::string_view bytes);   // lower case
std::optional<std::string> BytesOfHex(std::string_view hex);

// IssuerAndSerialNumber of CMS, byte by byte as the certificate has them; empty when it is none.
std::string IssuerAndSerial(std::string_view certificate);
// The object identifier of the key's algorithm, encoded; empty when it is no certificate.
std::string KeyAlgorithm(std::string_view certificate);

// UTF-8; the last common name, else the whole subject.
std::string CommonName(std::string_view certificate);
std::string SubjectText(std::string_view certificate);

// Empty when documents may be signed with its key: it is of X.509 version 3, its key usage, if any
// is stated, has digitalSignature or nonRepudiation, its extended key usage, if any, one of
// emailProtection, documentSigning (RFC 9336), Adobe's and any. Else the reason.
std::string SigningUseFailure(std::string_view certificate);
// Whether `signature` is that of the certificate's key over these very bytes; `digest` as "SHA256".
bool KeySigned(std::string_view certificate, const std::string& digest, std::string_view bytes,
               std::string_view signature);
// Seconds since 1970 between which it is valid; nothing when it is no certificate.
struct Validity {
  long long from_s = 0, until_s = 0;
};
std::optional<Validity> ValidityOf(std::string_view certificate);

// All certificates of PEM or DER files. Fails (kBadInput) when one cannot be read or has none.
Result<std::vector<std::string>> ReadCertificates(const std::vector<std::filesystem::path>& files);

// What is to be verified about a signer.
struct ChainQuestion {
  std::string signer;
  std::vector<std::string> embedded;  // all that came with it, the signer among them
  std::vector<std::string> trusted;
  long long time_s = 0;        // since 1970
  bool time_stamping = false;  // the signer must be a time-stamping authority
};
// Empty when the signer's certificate was valid at that time under a trusted one, and every
// embedded certificate is a part of that chain; else the reason.
std::string ChainFailure(const ChainQuestion& question);

}  // namespace telestrain
