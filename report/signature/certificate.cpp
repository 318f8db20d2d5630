#include "report/signature/certificate.h"

#include <algorithm>
#include <ctime>

#include "base/files.h"
#include "report/signature/der.h"
#include "report/signature/openssl_objects.h"

namespace telestrain {
namespace {

// The fields of TBSCertificate from the serial number on: serial, algorithm, issuer, validity,
// subject, key.
std::vector<DerNode> FieldsOf(std::string_view certificate) {
  const auto outer = ReadDer(certificate);
  const auto parts = outer ? DerChildren(outer->content) : std::nullopt;
  if (!parts || parts->empty()) return {};
  auto fields = DerChildren(parts->front().content);
  if (!fields || fields->empty()) return {};
  if (fields->front().tag == kDerContext0) fields->erase(fields->begin());  // version 2 or 3
  return fields->size() < 6 ? std::vector<DerNode>() : *fields;
}

long long SecondsOf(const ASN1_TIME* time) {
  std::tm parts{};
  return ASN1_TIME_to_tm(time, &parts) == 1 ? static_cast<long long>(::timegm(&parts)) : 0;
}

// For persons' signatures: e-mail, documents (RFC 9336, Adobe's), any.
bool IsForDocuments(X509* certificate) {
  struct Free {
    void operator()(EXTENDED_KEY_USAGE* list) const { EXTENDED_KEY_USAGE_free(list); }
  };
  const std::unique_ptr<EXTENDED_KEY_USAGE, Free> uses(static_cast<EXTENDED_KEY_USAGE*>(
      X509_get_ext_d2i(certificate, NID_ext_key_usage, nullptr, nullptr)));
  if (!uses) return true;
  for (int i = 0; i < sk_ASN1_OBJECT_num(uses.get()); ++i) {
    char text[80] = "";
    OBJ_obj2txt(text, sizeof text, sk_ASN1_OBJECT_value(uses.get(), i), 1);
    for (const std::string_view accepted :
         {"1.3.6.1.5.5.7.3.4", "1.3.6.1.5.5.7.3.36", "1.2.840.113583.1.1.5", "2.5.29.37.0"})
      if (accepted == text) return true;
  }
  return false;
}

// A certificate is public: a locked one is refused, not asked about.
int NoPassword(char*, int, int, void*) { return -1; }

// What OpenSSL found, and in which certificate if not the signer's.
std::string Reason(X509_STORE_CTX* context, const std::string& signer) {
  std::string reason = X509_verify_cert_error_string(X509_STORE_CTX_get_error(context));
  X509* const where = X509_STORE_CTX_get_current_cert(context);
  const std::string certificate = where ? DerOf(where, i2d_X509) : signer;
  return certificate == signer ? reason : reason + ", that of " + CommonName(certificate);
}

// The chain from the signer to the first trusted certificate; empty with a reason in `failure`.
std::vector<std::string> VerifiedChain(const ChainQuestion& question, std::string* failure) {
  const TrustStorePtr store(X509_STORE_new());
  const CertificatePtr signer = CertificateOf(question.signer);
  const CertificatesPtr embedded = CertificatesOf(question.embedded);
  const CertificatesPtr trusted = CertificatesOf(question.trusted);
  const TrustContextPtr context(X509_STORE_CTX_new());
  if (!signer || !embedded || !trusted) {
    *failure = "a certificate is malformed";
    return {};
  }
  for (int i = 0; i < sk_X509_num(trusted.get()); ++i)
    X509_STORE_add_cert(store.get(), sk_X509_value(trusted.get(), i));
  // The signer's own certificate may be the trusted one.
  X509_STORE_set_flags(store.get(), X509_V_FLAG_PARTIAL_CHAIN);
  X509_VERIFY_PARAM_set_time(X509_STORE_get0_param(store.get()),
                             static_cast<std::time_t>(question.time_s));
  X509_STORE_set_purpose(store.get(),
                         question.time_stamping ? X509_PURPOSE_TIMESTAMP_SIGN : X509_PURPOSE_ANY);
  X509_STORE_CTX_init(context.get(), store.get(), signer.get(), embedded.get());
  if (X509_verify_cert(context.get()) != 1) {
    *failure = Reason(context.get(), question.signer);
    ERR_clear_error();
    return {};
  }
  std::vector<std::string> chain;
  const STACK_OF(X509)* found = X509_STORE_CTX_get0_chain(context.get());
  for (int i = 0; i < sk_X509_num(found); ++i) {
    chain.push_back(DerOf(sk_X509_value(found, i), i2d_X509));
    if (std::find(question.trusted.begin(), question.trusted.end(), chain.back()) !=
        question.trusted.end())
      return chain;
  }
  *failure = "no trusted certificate is in its chain";
  return {};
}

}  // namespace

std::string Sha256(std::string_view bytes) { return BytesOfHex(Sha256Hex(bytes)).value(); }

std::string HexOf(std::string_view bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  for (const char c : bytes) {
    hex += kDigits[static_cast<unsigned char>(c) >> 4];
    hex += kDigits[static_cast<unsigned char>(c) & 15];
  }
  return hex;
}

std::optional<std::string> BytesOfHex(std::string_view hex) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
  };
  if (hex.size() % 2 != 0) return std::nullopt;
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    const int high = digit(hex[i]), low = digit(hex[i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    bytes += static_cast<char>(high << 4 | low);
  }
  return bytes;
}

std::string IssuerAndSerial(std::string_view certificate) {
  const auto fields = FieldsOf(certificate);
  if (fields.empty()) return "";
  return Der(kDerSequence, std::string(fields[2].whole).append(fields[0].whole));
}

std::string KeyAlgorithm(std::string_view certificate) {
  const auto fields = FieldsOf(certificate);
  const auto key = fields.empty() ? std::nullopt : DerChildren(fields[5].content);
  const auto algorithm = key && !key->empty() ? DerChildren((*key)[0].content) : std::nullopt;
  return algorithm && !algorithm->empty() ? std::string((*algorithm)[0].whole) : "";
}

std::string SubjectText(std::string_view certificate) {
  const CertificatePtr parsed = CertificateOf(certificate);
  const BioPtr text(BIO_new(BIO_s_mem()));
  if (!parsed) return "";
  X509_NAME_print_ex(text.get(), X509_get_subject_name(parsed.get()), 0,
                     XN_FLAG_RFC2253 & ~ASN1_STRFLGS_ESC_MSB);
  char* begin = nullptr;
  const long size = BIO_get_mem_data(text.get(), &begin);
  return {begin, static_cast<std::size_t>(std::max(0L, size))};
}

std::string CommonName(std::string_view certificate) {
  const CertificatePtr parsed = CertificateOf(certificate);
  if (!parsed) return "";
  X509_NAME* subject = X509_get_subject_name(parsed.get());
  int last = -1;
  for (int at = -1; (at = X509_NAME_get_index_by_NID(subject, NID_commonName, at)) >= 0;) last = at;
  if (last < 0) return SubjectText(certificate);
  unsigned char* utf8 = nullptr;
  const int size =
      ASN1_STRING_to_UTF8(&utf8, X509_NAME_ENTRY_get_data(X509_NAME_get_entry(subject, last)));
  if (size < 0) return SubjectText(certificate);
  const std::string name(reinterpret_cast<char*>(utf8), static_cast<std::size_t>(size));
  OPENSSL_free(utf8);
  return name;
}

std::string SigningUseFailure(std::string_view certificate) {
  const CertificatePtr parsed = CertificateOf(certificate);
  const std::string name = "the certificate of " + CommonName(certificate);
  if (!parsed) return name + " is malformed";
  if (X509_get_version(parsed.get()) != X509_VERSION_3)
    return name + " is of X.509 version " + std::to_string(X509_get_version(parsed.get()) + 1) +
           ", which cannot say what its key is for; have one of version 3 issued (openssl x509 "
           "-req makes it when it is given -extfile)";
  // All bits are set when the certificate does not restrict its use.
  if ((X509_get_key_usage(parsed.get()) & (KU_DIGITAL_SIGNATURE | KU_NON_REPUDIATION)) == 0)
    return name +
           " is not for signatures: its key usage has neither digitalSignature nor nonRepudiation";
  if (!IsForDocuments(parsed.get()))
    return name +
           " is not for signatures of documents: its extended key usage has none of "
           "emailProtection, documentSigning, Adobe's document signing and anyExtendedKeyUsage";
  ERR_clear_error();
  return "";
}

bool KeySigned(std::string_view certificate, const std::string& digest, std::string_view bytes,
               std::string_view signature) {
  const auto data = [](std::string_view text) {
    return reinterpret_cast<const unsigned char*>(text.data());
  };
  const CertificatePtr parsed = CertificateOf(certificate);
  EVP_PKEY* key = parsed ? X509_get0_pubkey(parsed.get()) : nullptr;
  const EVP_MD* hash = EVP_get_digestbyname(digest.c_str());
  const DigestContextPtr context(EVP_MD_CTX_new());
  const bool valid = key && hash &&
                     EVP_DigestVerifyInit(context.get(), nullptr, hash, nullptr, key) == 1 &&
                     EVP_DigestVerify(context.get(), data(signature), signature.size(), data(bytes),
                                      bytes.size()) == 1;
  ERR_clear_error();
  return valid;
}

std::optional<Validity> ValidityOf(std::string_view certificate) {
  const CertificatePtr parsed = CertificateOf(certificate);
  if (!parsed) return std::nullopt;
  return Validity{SecondsOf(X509_get0_notBefore(parsed.get())),
                  SecondsOf(X509_get0_notAfter(parsed.get()))};
}

Result<std::vector<std::string>> ReadCertificates(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> certificates;
  for (const std::filesystem::path& file : files) {
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string text, ReadFile(file, kMostTextBytes));
    const std::size_t before = certificates.size();
    if (const CertificatePtr one = CertificateOf(text)) certificates.push_back(text);
    const BioPtr pem = BioOf(text);
    ERR_clear_error();
    while (const CertificatePtr next{PEM_read_bio_X509(pem.get(), nullptr, &NoPassword, nullptr)})
      certificates.push_back(DerOf(next.get(), i2d_X509));
    const bool at_end = ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE;
    ERR_clear_error();
    if (certificates.size() == before)
      return BadInput(file.string() + ": has no certificate; want a PEM or DER file of X.509");
    if (!at_end)
      return BadInput(file.string() + ": its certificate " +
                      std::to_string(certificates.size() - before + 1) + " is malformed");
  }
  return certificates;
}

std::string ChainFailure(const ChainQuestion& question) {
  std::string failure;
  const auto chain = VerifiedChain(question, &failure);
  if (chain.empty())
    return "the certificate of " + CommonName(question.signer) + " is not trusted: " + failure;
  for (const std::string& certificate : question.embedded)
    if (std::find(chain.begin(), chain.end(), certificate) == chain.end())
      return "the certificate of " + CommonName(certificate) +
             " came with it but is no part of the trusted chain; trust the root instead";
  return question.time_stamping ? "" : SigningUseFailure(question.signer);
}

}  // namespace telestrain
