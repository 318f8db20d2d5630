#pragma once

#include <openssl/bio.h>
#include <openssl/cms.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/store.h>
#include <openssl/ts.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace telestrain {

// OpenSSL's objects that free themselves.
template <auto Free>
struct OpenSslFree {
  template <typename T>
  void operator()(T* object) const {
    Free(object);
  }
};
template <typename T, auto Free>
using OpenSslPtr = std::unique_ptr<T, OpenSslFree<Free>>;

inline void FreeCertificates(STACK_OF(X509) * certificates) {
  sk_X509_pop_free(certificates, X509_free);
}

using BioPtr = OpenSslPtr<BIO, BIO_free_all>;
using CertificatePtr = OpenSslPtr<X509, X509_free>;
using CertificatesPtr = OpenSslPtr<STACK_OF(X509), FreeCertificates>;
using CmsPtr = OpenSslPtr<CMS_ContentInfo, CMS_ContentInfo_free>;
using DigestContextPtr = OpenSslPtr<EVP_MD_CTX, EVP_MD_CTX_free>;
using KeyPtr = OpenSslPtr<EVP_PKEY, EVP_PKEY_free>;
using Pkcs7Ptr = OpenSslPtr<PKCS7, PKCS7_free>;
using StoreInfoPtr = OpenSslPtr<OSSL_STORE_INFO, OSSL_STORE_INFO_free>;
using StoreReaderPtr = OpenSslPtr<OSSL_STORE_CTX, OSSL_STORE_close>;
using TimeStampInfoPtr = OpenSslPtr<TS_TST_INFO, TS_TST_INFO_free>;
using TrustStorePtr = OpenSslPtr<X509_STORE, X509_STORE_free>;
using TrustContextPtr = OpenSslPtr<X509_STORE_CTX, X509_STORE_CTX_free>;

// The DER of an object: `DerOf(certificate, i2d_X509)`.
template <typename T, typename Encode>
std::string DerOf(T* object, Encode encode) {
  const int size = encode(object, nullptr);
  if (size <= 0) return "";
  std::string der(static_cast<std::size_t>(size), '\0');
  auto* end = reinterpret_cast<unsigned char*>(der.data());
  encode(object, &end);
  return der;
}

// The object of a DER that has nothing behind it; null if it is none.
template <typename Ptr, typename Decode>
Ptr FromDer(std::string_view der, Decode decode) {
  const auto* begin = reinterpret_cast<const unsigned char*>(der.data());
  const auto* end = begin;
  Ptr object(decode(nullptr, &end, static_cast<long>(der.size())));
  if (object && end != begin + der.size()) object.reset();
  return object;
}

inline CertificatePtr CertificateOf(std::string_view der) {
  return FromDer<CertificatePtr>(der, d2i_X509);
}

// The certificates of these DERs; null when one is none.
inline CertificatesPtr CertificatesOf(const std::vector<std::string>& ders) {
  CertificatesPtr certificates(sk_X509_new_null());
  for (const std::string& der : ders) {
    CertificatePtr certificate = CertificateOf(der);
    if (!certificate || sk_X509_push(certificates.get(), certificate.get()) <= 0) return nullptr;
    static_cast<void>(certificate.release());
  }
  return certificates;
}

inline BioPtr BioOf(std::string_view bytes) {
  return BioPtr(BIO_new_mem_buf(bytes.data(), static_cast<int>(bytes.size())));
}

// What OpenSSL says of its latest failure; its list of errors is empty afterwards.
inline std::string OpenSslReason() {
  const unsigned long code = ERR_peek_last_error();
  const char* reason = code ? ERR_reason_error_string(code) : nullptr;
  ERR_clear_error();
  return reason ? reason : "no reason given";
}

}  // namespace telestrain
