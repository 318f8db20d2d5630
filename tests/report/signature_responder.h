#pragma once

#include <atomic>
#include <string>
#include <thread>

namespace telestrain {

// An RFC 3161 responder on this machine that answers one request after the other with the test
// PKI's time-stamping authority, at kSigned_s + 60 s; or badly.
class TimeStampResponder {
 public:
  enum class Manner {
    kGood,
    kRefuses,    // a status of rejection
    kRepeats,    // the token of a request of its own
    kBabbles,    // no time-stamp response
    kHangsUp,    // no answer
    kForeignKey  // a token of an authority that nobody trusts
  };
  explicit TimeStampResponder(Manner manner = Manner::kGood);
  ~TimeStampResponder();
  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/tsa"; }

 private:
  void Serve();
  std::string Answer(const std::string& request) const;

  Manner manner_;
  int socket_ = -1;
  int port_ = 0;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

}  // namespace telestrain
