#include "signature_responder.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>

#include "signature_pki.h"

namespace telestrain {
namespace {

using ContextPtr = OpenSslPtr<TS_RESP_CTX, TS_RESP_CTX_free>;
using ResponsePtr = OpenSslPtr<TS_RESP, TS_RESP_free>;

ASN1_INTEGER* NextSerial(TS_RESP_CTX*, void*) {
  static long serial = 0;
  ASN1_INTEGER* number = ASN1_INTEGER_new();
  ASN1_INTEGER_set(number, ++serial);
  return number;
}

int FixedTime(TS_RESP_CTX*, void*, long* seconds, long* microseconds) {
  *seconds = static_cast<long>(kSigned_s) + 60;
  *microseconds = 0;
  return 1;
}

std::string Respond(const Identity& authority, const std::string& request, bool refuse) {
  const ContextPtr context(TS_RESP_CTX_new());
  const OpenSslPtr<ASN1_OBJECT, ASN1_OBJECT_free> policy(OBJ_txt2obj("1.2.3.4.1", 1));
  TS_RESP_CTX_set_serial_cb(context.get(), NextSerial, nullptr);
  TS_RESP_CTX_set_time_cb(context.get(), FixedTime, nullptr);
  TS_RESP_CTX_set_signer_cert(context.get(), authority.certificate.get());
  TS_RESP_CTX_set_signer_key(context.get(), authority.key.get());
  TS_RESP_CTX_set_signer_digest(context.get(), EVP_sha256());
  TS_RESP_CTX_set_ess_cert_id_digest(context.get(), EVP_sha256());
  TS_RESP_CTX_set_def_policy(context.get(), policy.get());
  // One that does not accept SHA-256 refuses our query.
  TS_RESP_CTX_add_md(context.get(), refuse ? EVP_sha512() : EVP_sha256());
  const BioPtr query = BioOf(request);
  const ResponsePtr response(TS_RESP_create_response(context.get(), query.get()));
  return response ? DerOf(response.get(), i2d_TS_RESP) : "";
}

// A query for another hash.
std::string OtherQuery() {
  const OpenSslPtr<TS_REQ, TS_REQ_free> request(TS_REQ_new());
  const OpenSslPtr<TS_MSG_IMPRINT, TS_MSG_IMPRINT_free> imprint(TS_MSG_IMPRINT_new());
  const OpenSslPtr<X509_ALGOR, X509_ALGOR_free> algorithm(X509_ALGOR_new());
  std::string hash(32, 'h');
  X509_ALGOR_set0(algorithm.get(), OBJ_nid2obj(NID_sha256), V_ASN1_NULL, nullptr);
  TS_REQ_set_version(request.get(), 1);
  TS_MSG_IMPRINT_set_algo(imprint.get(), algorithm.get());
  TS_MSG_IMPRINT_set_msg(imprint.get(), reinterpret_cast<unsigned char*>(hash.data()), 32);
  TS_REQ_set_msg_imprint(request.get(), imprint.get());
  TS_REQ_set_cert_req(request.get(), 1);
  return DerOf(request.get(), i2d_TS_REQ);
}

// The body of an HTTP request.
std::string ReadBody(int connection) {
  std::string request;
  char block[4096];
  for (;;) {
    const std::size_t head = request.find("\r\n\r\n");
    const std::size_t length = request.find("Content-Length: ");
    if (head != std::string::npos && length != std::string::npos &&
        request.size() >= head + 4 + std::stoul(request.substr(length + 16)))
      return request.substr(head + 4);
    const ssize_t size = ::read(connection, block, sizeof block);
    if (size <= 0) return "";
    request.append(block, static_cast<std::size_t>(size));
  }
}

}  // namespace

TimeStampResponder::TimeStampResponder(Manner manner) : manner_(manner) {
  Pki();  // made before a thread uses it
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* raw = reinterpret_cast<sockaddr*>(&address);
  if (::bind(socket_, raw, size) != 0 || ::listen(socket_, 4) != 0 ||
      ::getsockname(socket_, raw, &size) != 0)
    throw std::runtime_error("the test's responder cannot listen");
  port_ = ntohs(address.sin_port);
  thread_ = std::thread([this] { Serve(); });
}

TimeStampResponder::~TimeStampResponder() {
  ends_ = true;
  ::shutdown(socket_, SHUT_RDWR);
  thread_.join();
  ::close(socket_);
}

void TimeStampResponder::Serve() {
  while (!ends_) {
    const int connection = ::accept(socket_, nullptr, nullptr);
    if (connection < 0) return;
    const std::string body = ReadBody(connection);
    if (manner_ != Manner::kHangsUp) {
      const std::string answer = Answer(body);
      const std::string text =
          "HTTP/1.0 200 OK\r\nContent-Type: application/timestamp-reply\r\nContent-Length: " +
          std::to_string(answer.size()) + "\r\n\r\n" + answer;
      ::send(connection, text.data(), text.size(), MSG_NOSIGNAL);
    }
    ::close(connection);
  }
}

std::string TimeStampResponder::Answer(const std::string& request) const {
  if (manner_ == Manner::kBabbles) return "good morning";
  if (manner_ == Manner::kRepeats) return Respond(Pki().stamper, OtherQuery(), false);
  if (manner_ == Manner::kForeignKey) {
    static const Identity kForeign = Issue({.name = "Unknown time stamps",
                                            .key = "RSA2048",
                                            .usage = "critical,digitalSignature",
                                            .extended_usage = "critical,timeStamping"});
    return Respond(kForeign, request, false);
  }
  return Respond(Pki().stamper, request, manner_ == Manner::kRefuses);
}

}  // namespace telestrain
