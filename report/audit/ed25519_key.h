#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "base/result.h"

struct evp_pkey_st;

namespace telestrain {

// An Ed25519 key (RFC 8032), with which an instrument signs the lines of its log. Copies share it.
class Ed25519Key {
 public:
  // Fails (kBadInput) when the file is no unencrypted private key in PEM of this kind.
  static Result<Ed25519Key> ReadPrivate(const std::filesystem::path& file);
  // `name` is for errors.
  static Result<Ed25519Key> ReadPublic(const std::string& name, const std::string& pem);

  // The signature of `text` in base64. Of a private key only.
  std::string Sign(const std::string& text) const;
  bool Verifies(const std::string& text, const std::string& signature_base64) const;

 private:
  explicit Ed25519Key(std::shared_ptr<evp_pkey_st> key) : key_(std::move(key)) {}
  static Result<Ed25519Key> Of(const std::string& name, std::shared_ptr<evp_pkey_st> key);

  std::shared_ptr<evp_pkey_st> key_;
};

}  // namespace telestrain
