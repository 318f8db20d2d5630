#include "report/audit/ed25519_key.h"

#include <openssl/evp.h>
#include <openssl/pem.h>

#include "base/check.h"
#include "base/files.h"

namespace telestrain {
namespace {

constexpr std::size_t kSignatureBytes = 64;
constexpr std::size_t kSignatureBase64 = 88;  // 64 bytes and their padding "=="

using Bio = std::unique_ptr<BIO, decltype(&BIO_free)>;
using Context = std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)>;

Bio BioOf(const std::string& text) {
  return {BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), &BIO_free};
}

// Nobody sits at the terminal of an instrument: an encrypted key is refused, not asked about.
int NoPassword(char*, int, int, void*) { return -1; }

const unsigned char* Bytes(const std::string& text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

// The 64 bytes, or an empty text when it is no canonical base64 of 64 bytes.
std::string FromBase64(const std::string& text) {
  if (text.size() != kSignatureBase64 || !text.ends_with("==")) return "";
  std::string bytes(kSignatureBytes + 2, '\0');
  auto* const out = reinterpret_cast<unsigned char*>(bytes.data());
  if (EVP_DecodeBlock(out, Bytes(text), static_cast<int>(text.size())) !=
      static_cast<int>(bytes.size()))
    return "";
  bytes.resize(kSignatureBytes);
  return bytes;
}

std::string ToBase64(const std::string& bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  auto* const out = reinterpret_cast<unsigned char*>(text.data());
  text.resize(
      static_cast<std::size_t>(EVP_EncodeBlock(out, Bytes(bytes), static_cast<int>(bytes.size()))));
  return text;
}

}  // namespace

Result<Ed25519Key> Ed25519Key::Of(const std::string& name, std::shared_ptr<evp_pkey_st> key) {
  if (key && EVP_PKEY_get_id(key.get()) == EVP_PKEY_ED25519) return Ed25519Key(std::move(key));
  return BadInput(name +
                  ": is no Ed25519 key in PEM without a password; make one with 'openssl genpkey "
                  "-algorithm ed25519'");
}

Result<Ed25519Key> Ed25519Key::ReadPrivate(const std::filesystem::path& file) {
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string pem, ReadFile(file, kMostTextBytes));
  const Bio bio = BioOf(pem);
  return Of(file.string(),
            {PEM_read_bio_PrivateKey(bio.get(), nullptr, &NoPassword, nullptr), &EVP_PKEY_free});
}

Result<Ed25519Key> Ed25519Key::ReadPublic(const std::string& name, const std::string& pem) {
  const Bio bio = BioOf(pem);
  return Of(name, {PEM_read_bio_PUBKEY(bio.get(), nullptr, &NoPassword, nullptr), &EVP_PKEY_free});
}

std::string Ed25519Key::Sign(const std::string& text) const {
  const Context context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  std::string signature(kSignatureBytes, '\0');
  std::size_t size = signature.size();
  const bool done =
      EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, key_.get()) == 1 &&
      EVP_DigestSign(context.get(), reinterpret_cast<unsigned char*>(signature.data()), &size,
                     Bytes(text), text.size()) == 1;
  TELESTRAIN_CHECK(done && size == kSignatureBytes, "OpenSSL cannot sign with this key");
  return ToBase64(signature);
}

bool Ed25519Key::Verifies(const std::string& text, const std::string& signature_base64) const {
  const std::string signature = FromBase64(signature_base64);
  if (signature.empty()) return false;
  const Context context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  return EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, key_.get()) == 1 &&
         EVP_DigestVerify(context.get(), Bytes(signature), signature.size(), Bytes(text),
                          text.size()) == 1;
}

}  // namespace telestrain
