#pragma once

#include <filesystem>
#include <string>

#include "report/signature/openssl_objects.h"
#include "report/signature/signing_key.h"

namespace telestrain {

// When the tests' signatures are made: 2026-01-31T12:00:00Z, and a year around it.
inline constexpr long long kSigned_s = 1769860800;
inline constexpr long long kYear_s = 365 * 86400LL;

// A certificate and its private key.
struct Identity {
  std::shared_ptr<EVP_PKEY> key;
  std::shared_ptr<X509> certificate;
  std::string Der() const { return DerOf(certificate.get(), i2d_X509); }
  std::string Pem() const;
  std::string KeyPem(const std::string& password = "") const;
  SigningKey ForSigning() const { return {key, Der(), {}}; }
};

// What to issue. Without an issuer it is self-signed.
struct IdentityRequest {
  std::string name = "";
  const Identity* issuer = nullptr;
  std::string key = "P-256";  // or "P-384", "P-521", "RSA1024", "RSA2048", "ED25519"
  std::string usage = "critical,digitalSignature,nonRepudiation";
  std::string extended_usage = "";  // empty: none
  bool authority = false;
  bool old_version = false;  // X.509 version 1, without extensions
  long long from_s = kSigned_s - kYear_s, until_s = kSigned_s + 70 * kYear_s;
};
Identity Issue(const IdentityRequest& request);

// A root, one signer per role with it as the issuer, and a time-stamping authority; made once.
struct TestPki {
  Identity root, instrument, operator_, reviewer, approver, stamper;
  const Identity& Of(const std::string& role) const;
};
const TestPki& Pki();

// PKCS#12 with key, certificate and the issuer's.
std::string Pkcs12(const Identity& identity, const Identity& issuer, const std::string& password);

std::filesystem::path WriteTestFile(const std::string& name, const std::string& bytes);

}  // namespace telestrain
