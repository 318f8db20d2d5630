#pragma once

#include <string>
#include <vector>

#include "base/result.h"

namespace telestrain {

// RFC 3161 time stamps.

// Asks the responder (http only) for a token over `signature`; returns it in the one encoding that
// SignedData has. Checks status, imprint, nonce and the token's own signature; who the authority
// is, is for the verifier. Fails (kOutputFailed) with what the responder said.
Result<std::string> RequestTimeStamp(const std::string& url, const std::string& signature);

struct TimeStamp {
  long long time_s = 0;  // since 1970
  std::string failure;   // empty when it is valid
};
// Checks a token over `signature`, its authority's chain at its own time.
TimeStamp CheckTimeStamp(const std::string& token, const std::string& signature,
                         const std::vector<std::string>& trusted);

}  // namespace telestrain
