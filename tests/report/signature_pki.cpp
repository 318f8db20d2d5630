#include "signature_pki.h"

#include <openssl/pkcs12.h>
#include <openssl/rsa.h>
#include <unistd.h>

#include <stdexcept>

#include "base/files.h"

namespace telestrain {
namespace {

void Require(bool done, const char* what) {
  if (!done) throw std::runtime_error(std::string("test PKI: ") + what);
}

EVP_PKEY* MakeKey(const std::string& kind) {
  if (kind.starts_with("RSA"))
    return EVP_PKEY_Q_keygen(nullptr, nullptr, "RSA",
                             static_cast<std::size_t>(std::stoi(kind.substr(3))));
  if (kind == "ED25519") return EVP_PKEY_Q_keygen(nullptr, nullptr, "ED25519");
  return EVP_PKEY_Q_keygen(nullptr, nullptr, "EC", kind.c_str());
}

void AddExtension(X509* certificate, X509* issuer, int nid, const std::string& value) {
  if (value.empty()) return;
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, &context, nid, value.c_str());
  Require(extension && X509_add_ext(certificate, extension, -1) == 1, value.c_str());
  X509_EXTENSION_free(extension);
}

std::string TextOf(const BioPtr& bio) {
  char* begin = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &begin);
  return {begin, static_cast<std::size_t>(size)};
}

TestPki MakePki() {
  TestPki pki;
  pki.root = Issue({.name = "Test root",
                    .key = "RSA2048",
                    .usage = "critical,keyCertSign,cRLSign",
                    .authority = true});
  const auto issue = [&](const std::string& name, const std::string& key) {
    return Issue({.name = name, .issuer = &pki.root, .key = key});
  };
  pki.instrument = issue("telestrain demonstration instrument", "RSA2048");
  pki.operator_ = issue("Zhang Wei 张伟", "P-256");
  pki.reviewer = issue("Jürgen Prüfer", "P-384");
  pki.approver = issue("Ana Approver", "RSA2048");
  pki.stamper = Issue({.name = "Test time stamps",
                       .issuer = &pki.root,
                       .key = "RSA2048",
                       .usage = "critical,digitalSignature",
                       .extended_usage = "critical,timeStamping"});
  return pki;
}

}  // namespace

std::string Identity::Pem() const {
  const BioPtr bio(BIO_new(BIO_s_mem()));
  PEM_write_bio_X509(bio.get(), certificate.get());
  return TextOf(bio);
}

std::string Identity::KeyPem(const std::string& password) const {
  const BioPtr bio(BIO_new(BIO_s_mem()));
  const EVP_CIPHER* cipher = password.empty() ? nullptr : EVP_aes_256_cbc();
  PEM_write_bio_PKCS8PrivateKey(bio.get(), key.get(), cipher, password.data(),
                                static_cast<int>(password.size()), nullptr, nullptr);
  return TextOf(bio);
}

Identity Issue(const IdentityRequest& request) {
  static long serial = 1000;
  Identity made;
  made.key = KeyPtr(MakeKey(request.key));
  CertificatePtr certificate(X509_new());
  X509* raw = certificate.get();
  X509* issuer = request.issuer ? request.issuer->certificate.get() : raw;
  Require(made.key && raw, "no key");
  X509_set_version(raw, request.old_version ? X509_VERSION_1 : X509_VERSION_3);
  ASN1_INTEGER_set(X509_get_serialNumber(raw), ++serial);
  ASN1_TIME_set(X509_getm_notBefore(raw), request.from_s);
  ASN1_TIME_set(X509_getm_notAfter(raw), request.until_s);
  X509_set_pubkey(raw, made.key.get());
  X509_NAME* name = X509_get_subject_name(raw);
  const auto* text = reinterpret_cast<const unsigned char*>(request.name.c_str());
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8, text, -1, -1, 0);
  X509_set_issuer_name(raw, X509_get_subject_name(issuer));
  if (!request.old_version) {
    AddExtension(raw, issuer, NID_basic_constraints,
                 request.authority ? "critical,CA:TRUE" : "critical,CA:FALSE");
    AddExtension(raw, issuer, NID_key_usage, request.usage);
    AddExtension(raw, issuer, NID_ext_key_usage, request.extended_usage);
  }
  EVP_PKEY* signer = request.issuer ? request.issuer->key.get() : made.key.get();
  const EVP_MD* digest = EVP_PKEY_is_a(signer, "ED25519") ? nullptr : EVP_sha256();
  Require(X509_sign(raw, signer, digest) > 0, "not signed");
  made.certificate = std::move(certificate);
  return made;
}

const Identity& TestPki::Of(const std::string& role) const {
  if (role == "instrument") return instrument;
  if (role == "operator") return operator_;
  return role == "reviewer" ? reviewer : approver;
}

const TestPki& Pki() {
  static const TestPki kPki = MakePki();
  return kPki;
}

std::string Pkcs12(const Identity& identity, const Identity& issuer, const std::string& password) {
  STACK_OF(X509)* chain = sk_X509_new_null();
  sk_X509_push(chain, issuer.certificate.get());
  const OpenSslPtr<PKCS12, PKCS12_free> file(
      PKCS12_create(password.c_str(), "signer", identity.key.get(), identity.certificate.get(),
                    chain, 0, 0, 0, 0, 0));
  sk_X509_free(chain);
  Require(file != nullptr, "no PKCS#12");
  return DerOf(file.get(), i2d_PKCS12);
}

std::filesystem::path WriteTestFile(const std::string& name, const std::string& bytes) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("telestrain_signature_test." + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const Status written = WriteFileAtomically(folder / name, bytes);
  Require(written.ok(), "file not written");
  return folder / name;
}

}  // namespace telestrain
