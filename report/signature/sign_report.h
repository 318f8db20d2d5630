#pragma once

#include <string>

#include "base/result.h"
#include "report/signature/signing_key.h"

namespace telestrain {

// How to sign.
struct SignOptions {
  std::string role;            // one of kSigningRoles
  std::string name;            // shown beside the certificate's common name; may be empty
  std::string reason, place;   // shown and signed; may be empty
  long long time_s = 0;        // since 1970, the signer's own clock
  std::string time_stamp_url;  // of an RFC 3161 responder; empty: none
};

struct SignedReport {
  std::string bytes;        // begin with the bytes of before
  std::string signer;       // common name of the certificate
  std::string fingerprint;  // SHA-256 of the certificate, hex
};

// Adds a PAdES signature (ETSI EN 319 142-1, level B-B, or B-T with a time stamp) to a report in an
// incremental update, in the field of its role or, when the report has none, in an invisible one.
// The instrument's is a DocMDP seal (P 2) and comes first. `file` is for errors.
// Fails (kBadInput) when the file is no report of telestrain, is damaged, was changed after an
// earlier signature, is encrypted, has boxes that could cover the page (BoxesFailure) or signatures
// that this one may not follow (OrderFailure); when the certificate is not valid at the time or not
// for documents; (kOutputFailed) when key or responder refuse, or when the result does not pass
// CheckIntegrity. Nothing is written.
Result<SignedReport> SignReport(const std::string& file, const std::string& bytes,
                                const SigningKey& key, const SignOptions& options);

}  // namespace telestrain
