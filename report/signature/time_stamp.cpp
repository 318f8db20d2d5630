#include "report/signature/time_stamp.h"

#include <openssl/http.h>
#include <openssl/rand.h>

#include <ctime>
#include <optional>

#include "report/signature/certificate.h"
#include "report/signature/openssl_objects.h"
#include "report/signature/signed_data.h"

namespace telestrain {
namespace {

constexpr int kTimeout_s = 30;
constexpr std::size_t kMostResponseBytes = 1 << 20;

using RequestPtr = OpenSslPtr<TS_REQ, TS_REQ_free>;
using ResponsePtr = OpenSslPtr<TS_RESP, TS_RESP_free>;
using ImprintPtr = OpenSslPtr<TS_MSG_IMPRINT, TS_MSG_IMPRINT_free>;
using AlgorithmPtr = OpenSslPtr<X509_ALGOR, X509_ALGOR_free>;
using IntegerPtr = OpenSslPtr<ASN1_INTEGER, ASN1_INTEGER_free>;
using NumberPtr = OpenSslPtr<BIGNUM, BN_free>;
using VerifierPtr = OpenSslPtr<TS_VERIFY_CTX, TS_VERIFY_CTX_free>;

// A query with a nonce that asks for the authority's certificates.
RequestPtr MakeRequest(const std::string& signature) {
  RequestPtr request(TS_REQ_new());
  const ImprintPtr imprint(TS_MSG_IMPRINT_new());
  const AlgorithmPtr algorithm(X509_ALGOR_new());
  std::string hash = Sha256(signature);
  X509_ALGOR_set0(algorithm.get(), OBJ_nid2obj(NID_sha256), V_ASN1_NULL, nullptr);
  const NumberPtr number(BN_new());
  const bool done =
      TS_REQ_set_version(request.get(), 1) == 1 &&
      TS_MSG_IMPRINT_set_algo(imprint.get(), algorithm.get()) == 1 &&
      TS_MSG_IMPRINT_set_msg(imprint.get(), reinterpret_cast<unsigned char*>(hash.data()),
                             static_cast<int>(hash.size())) == 1 &&
      TS_REQ_set_msg_imprint(request.get(), imprint.get()) == 1 &&
      BN_rand(number.get(), 64, BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY) == 1;
  const IntegerPtr nonce(done ? BN_to_ASN1_INTEGER(number.get(), nullptr) : nullptr);
  if (!nonce || TS_REQ_set_nonce(request.get(), nonce.get()) != 1 ||
      TS_REQ_set_cert_req(request.get(), 1) != 1)
    request.reset();
  return request;
}

// The parts of an http URL.
struct Url {
  std::string host, port, path;
};
std::optional<Url> ParseUrl(const std::string& text) {
  char *host = nullptr, *port = nullptr, *path = nullptr;
  int tls = 0;
  if (OSSL_HTTP_parse_url(text.c_str(), &tls, nullptr, &host, &port, nullptr, &path, nullptr,
                          nullptr) != 1)
    return std::nullopt;
  const Url url{host, port, path};
  OPENSSL_free(host);
  OPENSSL_free(port);
  OPENSSL_free(path);
  return tls ? std::nullopt : std::optional<Url>(url);
}

Result<ResponsePtr> Send(const std::string& text, TS_REQ* request) {
  const auto url = ParseUrl(text);
  if (!url || url->host.empty() || !text.starts_with("http://"))
    return BadInput("--timestamp " + text +
                    ": want http://host/path of an RFC 3161 responder "
                    "(its answer is signed, so https adds nothing)");
  const std::string query = DerOf(request, i2d_TS_REQ);
  const BioPtr body = BioOf(query);
  const BioPtr answer(OSSL_HTTP_transfer(
      nullptr, url->host.c_str(), url->port.c_str(), url->path.c_str(), 0, nullptr, nullptr,
      nullptr, nullptr, nullptr, nullptr, 0, nullptr, "application/timestamp-query", body.get(),
      "application/timestamp-reply", 1, kMostResponseBytes, kTimeout_s, 0));
  if (!answer)
    return OutputFailed("the time-stamp responder " + text + " gave no answer: " + OpenSslReason());
  ResponsePtr response(d2i_TS_RESP_bio(answer.get(), nullptr));
  if (!response)
    return OutputFailed("the answer of " + text + " is no time-stamp response: " + OpenSslReason());
  return response;
}

std::string StatusText(TS_RESP* response) {
  const BioPtr text(BIO_new(BIO_s_mem()));
  TS_STATUS_INFO_print_bio(text.get(), TS_RESP_get_status_info(response));
  char* begin = nullptr;
  const long size = BIO_get_mem_data(text.get(), &begin);
  std::string line(begin, static_cast<std::size_t>(size > 0 ? size : 0));
  while (!line.empty() && line.back() == '\n') line.pop_back();
  for (char& c : line)
    if (c == '\n') c = ' ';
  return line;
}

// Whether the token's signature is that of the certificate in it.
bool SignatureHolds(PKCS7* token) {
  const BioPtr content(BIO_new(BIO_s_mem()));
  return PKCS7_verify(token, nullptr, nullptr, nullptr, content.get(), PKCS7_NOVERIFY) == 1;
}

std::optional<long long> TimeOf(PKCS7* token) {
  const TimeStampInfoPtr info(PKCS7_to_TS_TST_INFO(token));
  std::tm parts{};
  if (!info || ASN1_TIME_to_tm(TS_TST_INFO_get_time(info.get()), &parts) != 1) return std::nullopt;
  return static_cast<long long>(::timegm(&parts));
}

// The imprint and the token's signature; the chain is checked beside.
bool Matches(PKCS7* token, const std::string& signature) {
  const VerifierPtr verifier(TS_VERIFY_CTX_new());
  TS_VERIFY_CTX_set_flags(verifier.get(), TS_VFY_VERSION | TS_VFY_DATA);
  TS_VERIFY_CTX_set_data(verifier.get(), BioOf(signature).release());  // the verifier frees it
  return TS_RESP_verify_token(verifier.get(), token) == 1 && SignatureHolds(token);
}

// OpenSSL's PKCS #7 verifies the attributes as it would write them, this as they are.
bool AttributesHold(const SignedData& data) {
  return KeySigned(data.certificates[data.signer], data.digest, AttributesToSign(data),
                   data.signature);
}

}  // namespace

Result<std::string> RequestTimeStamp(const std::string& url, const std::string& signature) {
  const RequestPtr request = MakeRequest(signature);
  if (!request) return OutputFailed("a time-stamp query cannot be made: " + OpenSslReason());
  TELESTRAIN_ASSIGN_OR_RETURN(const ResponsePtr response, Send(url, request.get()));
  const VerifierPtr verifier(TS_REQ_to_TS_VERIFY_CTX(request.get(), nullptr));
  if (!TS_RESP_get_token(response.get()))
    return OutputFailed("the time-stamp responder " + url +
                        " refused: " + StatusText(response.get()));
  if (!verifier || TS_RESP_verify_response(verifier.get(), response.get()) != 1)
    return OutputFailed("the time stamp of " + url +
                        " does not belong to this signature: " + OpenSslReason());
  const std::string token = DerOf(TS_RESP_get_token(response.get()), i2d_PKCS7);
  const auto data = ReadSignedData(token, SignedData::Kind::kTimeStamp);
  const std::string canonical = data ? EncodeSignedData(*data) : "";
  const Pkcs7Ptr parsed = FromDer<Pkcs7Ptr>(canonical, d2i_PKCS7);
  if (!parsed || !Matches(parsed.get(), signature) || !AttributesHold(*data))
    return OutputFailed("the time stamp of " + url +
                        " is not validly signed with RSA or EC and SHA-2: " + OpenSslReason());
  return canonical;
}

TimeStamp CheckTimeStamp(const std::string& token, const std::string& signature,
                         const std::vector<std::string>& trusted) {
  const auto data = ReadSignedData(token, SignedData::Kind::kTimeStamp);
  if (!data || EncodeSignedData(*data) != token) return {0, "its time stamp was changed"};
  if (!AttributesHold(*data)) return {0, "its time stamp is not validly signed"};
  const Pkcs7Ptr parsed = FromDer<Pkcs7Ptr>(token, d2i_PKCS7);
  const auto time_s = parsed ? TimeOf(parsed.get()) : std::nullopt;
  if (!time_s || !Matches(parsed.get(), signature)) {
    ERR_clear_error();
    return {0, "its time stamp is not valid"};
  }
  const std::string failure = ChainFailure({.signer = data->certificates[data->signer],
                                            .embedded = data->certificates,
                                            .trusted = trusted,
                                            .time_s = *time_s,
                                            .time_stamping = true});
  return {*time_s, failure.empty() ? "" : "time stamp: " + failure};
}

}  // namespace telestrain
