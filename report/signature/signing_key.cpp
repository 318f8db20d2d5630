#include "report/signature/signing_key.h"

#include <openssl/ui.h>

#include <cstring>
#include <exception>
#include <filesystem>
#include <system_error>

#include "base/files.h"
#include "report/signature/certificate.h"
#include "report/signature/openssl_objects.h"
#include "report/signature/utc_time.h"

namespace telestrain {
namespace {

constexpr int kLeastRsaBits = 2048;

// What the sources hold.
struct Loaded {
  std::vector<KeyPtr> keys;
  std::vector<std::string> certificates;
};

// The password, kept for the next locked object of the same sources.
struct Password {
  const KeySources& sources;
  std::string source;  // being opened
  bool asked = false;
  std::string text;
  std::optional<Error> error;
  ~Password() { WipePassword(&text); }
};

void Ask(Password* password) {
  password->asked = true;
  if (!password->sources.password) {
    password->error = BadInput(password->source + ": needs a password");
    return;
  }
  auto given = password->sources.password(password->source);
  if (!given) {
    password->error = given.error();
    return;
  }
  password->text = *given;
  WipePassword(&*given);
}

// OpenSSL's pem_password_cb.
int GivePassword(char* buffer, int size, int, void* user) {
  auto& password = *static_cast<Password*>(user);
  try {
    if (!password.asked) Ask(&password);
  } catch (const std::exception& error) {  // it must not pass through OpenSSL's C functions
    password.error = BadInput(password.source + ": no password: " + error.what());
  }
  if (password.error || password.text.size() > static_cast<std::size_t>(size)) return -1;
  std::memcpy(buffer, password.text.data(), password.text.size());
  return static_cast<int>(password.text.size());
}

using UiMethodPtr = OpenSslPtr<UI_METHOD, UI_destroy_method>;

void Take(const OSSL_STORE_INFO* info, Loaded* loaded) {
  const int type = OSSL_STORE_INFO_get_type(info);
  if (type == OSSL_STORE_INFO_PKEY) loaded->keys.emplace_back(OSSL_STORE_INFO_get1_PKEY(info));
  if (type == OSSL_STORE_INFO_CERT)
    loaded->certificates.push_back(DerOf(OSSL_STORE_INFO_get0_CERT(info), i2d_X509));
}

// Whether it is for a provider of OpenSSL ("pkcs11:…") and not a file.
bool IsUri(const std::string& source) {
  const std::size_t colon = source.find(':');
  std::error_code code;
  return colon != std::string::npos && source.find('/') > colon &&
         !std::filesystem::exists(source, code);
}

Status LoadSource(const std::string& source, Password& password, Loaded* loaded) {
  const UiMethodPtr ui(UI_UTIL_wrap_read_pem_callback(&GivePassword, 0));
  password.source = source;
  // OpenSSL would wait for a pipe and read a device to its end.
  if (!IsUri(source))
    if (const auto file = ReadFile(source, kMostTextBytes); !file) return file.error();
  const StoreReaderPtr store(
      OSSL_STORE_open(source.c_str(), ui.get(), &password, nullptr, nullptr));
  if (!store) return BadInput(source + ": cannot be opened: " + OpenSslReason());
  const std::size_t before = loaded->keys.size() + loaded->certificates.size();
  bool failed = false;
  ERR_clear_error();
  while (OSSL_STORE_eof(store.get()) == 0) {
    const StoreInfoPtr info(OSSL_STORE_load(store.get()));
    // The end of a file is an error too, but one without a reason.
    failed = failed || (!info && ERR_peek_last_error() != 0);
    if (info) Take(info.get(), loaded);
  }
  if (password.error) return *password.error;
  const std::string reason = OpenSslReason();
  if (failed && password.asked)
    return BadInput(source +
                    ": cannot be unlocked: the password is wrong or the file is damaged; try "
                    "again, or copy the file anew");
  if (failed || loaded->keys.size() + loaded->certificates.size() == before)
    return BadInput(source + ": has no key and no certificate (" + reason +
                    "); want PEM, DER or PKCS#12");
  return {};
}

Status CheckAlgorithm(EVP_PKEY* key) {
  if (EVP_PKEY_is_a(key, "RSA")) {
    const int bits = EVP_PKEY_get_bits(key);
    if (bits >= kLeastRsaBits) return {};
    return BadInput("the RSA key has " + std::to_string(bits) + " bit; want " +
                    std::to_string(kLeastRsaBits) + " or more");
  }
  char curve[64] = "";
  if (EVP_PKEY_is_a(key, "EC")) EVP_PKEY_get_group_name(key, curve, sizeof curve, nullptr);
  if (std::strcmp(curve, "prime256v1") == 0 || std::strcmp(curve, "secp384r1") == 0) return {};
  const char* type = EVP_PKEY_get0_type_name(key);
  return BadInput("the key is of the kind " + std::string(type ? type : "unknown") +
                  (*curve ? std::string(" on ") + curve : "") +
                  "; PDF readers verify RSA from 2048 bit and EC on P-256 or P-384");
}

bool BelongsTo(EVP_PKEY* key, const std::string& der) {
  const CertificatePtr certificate = CertificateOf(der);
  const bool same = certificate && X509_check_private_key(certificate.get(), key) == 1;
  ERR_clear_error();
  return same;
}

bool IsSelfSigned(const std::string& der) {
  const CertificatePtr certificate = CertificateOf(der);
  return certificate && X509_self_signed(certificate.get(), 0) == 1;
}

}  // namespace

void WipePassword(std::string* text) {
  OPENSSL_cleanse(text->data(), text->size());
  text->clear();
}

Result<SigningKey> LoadSigningKey(const KeySources& sources) {
  Loaded loaded;
  Password password{sources, "", false, "", std::nullopt};
  for (const std::string& source : sources.sources)
    TELESTRAIN_RETURN_IF_ERROR(LoadSource(source, password, &loaded));
  if (loaded.keys.size() != 1)
    return BadInput("one private key is needed to sign, " + std::to_string(loaded.keys.size()) +
                    " found in " + sources.sources.front() + "; name the file of the key");
  TELESTRAIN_RETURN_IF_ERROR(CheckAlgorithm(loaded.keys[0].get()));
  SigningKey key;
  key.key = std::move(loaded.keys[0]);
  for (const std::string& certificate : loaded.certificates)
    if (key.certificate.empty() && BelongsTo(key.key.get(), certificate))
      key.certificate = certificate;
    else if (!IsSelfSigned(certificate))
      key.chain.push_back(certificate);
  if (!key.certificate.empty()) return key;
  return BadInput("none of the " + std::to_string(loaded.certificates.size()) +
                  " certificates belongs to the private key; give the one that was issued for it");
}

Status CheckSigningKey(const SigningKey& key, long long time_s) {
  const auto validity = ValidityOf(key.certificate);
  const std::string name = "the certificate of " + CommonName(key.certificate);
  if (const auto use = SigningUseFailure(key.certificate); !use.empty()) return BadInput(use);
  if (!validity) return BadInput(name + " is malformed");
  if (time_s < validity->from_s)
    return BadInput(name + " is valid only from " + IsoTime(validity->from_s) +
                    " on, the signature is of " + IsoTime(time_s));
  if (time_s > validity->until_s)
    return BadInput(name + " expired at " + IsoTime(validity->until_s) + ", the signature is of " +
                    IsoTime(time_s) + "; sign with a new certificate");
  return {};
}

Result<std::string> SignBytes(const SigningKey& key, const std::string& bytes) {
  const DigestContextPtr context(EVP_MD_CTX_new());
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  std::size_t size = 0;
  if (EVP_DigestSignInit(context.get(), nullptr, EVP_sha256(), nullptr, key.key.get()) != 1 ||
      EVP_DigestSign(context.get(), nullptr, &size, data, bytes.size()) != 1)
    return OutputFailed("the key does not sign: " + OpenSslReason());
  std::string signature(size, '\0');
  if (EVP_DigestSign(context.get(), reinterpret_cast<unsigned char*>(signature.data()), &size, data,
                     bytes.size()) != 1)
    return OutputFailed("the key does not sign: " + OpenSslReason());
  signature.resize(size);
  return signature;
}

}  // namespace telestrain
