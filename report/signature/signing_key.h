#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"

struct evp_pkey_st;  // OpenSSL's EVP_PKEY

namespace telestrain {

// Where key and certificates are: files (PEM, DER, PKCS#12) or URIs that the user's OpenSSL opens,
// as pkcs11:…
struct KeySources {
  std::vector<std::string> sources;
  // Asked at most once, and only when something is locked; gets what is locked.
  std::function<Result<std::string>(const std::string&)> password;
};

struct SigningKey {
  std::shared_ptr<evp_pkey_st> key;
  std::string certificate;         // DER
  std::vector<std::string> chain;  // the others that came along, without self-signed ones
};

// Overwrites a password and empties it.
void WipePassword(std::string* text);

// Loads them with OpenSSL's store. Fails (kBadInput) when something cannot be opened, the password
// is wrong, there is not exactly one private key, no certificate belongs to it, or it is of
// another kind than RSA of 2048 bit and more or EC on P-256 or P-384.
Result<SigningKey> LoadSigningKey(const KeySources& sources);

// Fails (kBadInput) when the certificate is not valid at that time (seconds since 1970) or is not
// for signatures (SigningUseFailure).
Status CheckSigningKey(const SigningKey& key, long long time_s);

// The signature of `bytes` with SHA-256. Fails (kOutputFailed) when the key refuses.
Result<std::string> SignBytes(const SigningKey& key, const std::string& bytes);

}  // namespace telestrain
